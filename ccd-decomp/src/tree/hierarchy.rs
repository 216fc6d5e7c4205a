//! Builds binary hierarchies over pieces by agglomeration.

mod agglomerate;

use crate::bounds::BoundingBox;
use agglomerate::{Cluster, agglomerate};
use ccd_core::glam::DVec3;
use ccd_core::{Hierarchy, HierarchyNode, InputError, Pieces};
use rayon::prelude::*;

/// The number of pieces in a parallel task. Smaller tasks cost more than they gain.
const PIECES_PER_TASK: usize = 4096;

/// Builds a binary hierarchy over pieces: sets of pieces whose centers are near each other become siblings.
///
/// # Guarantee
/// The same pieces give the same hierarchy, on any number of threads. Every piece appears once; no input panics.
///
/// # Errors
/// [`InputError::TooManyPieces`] if an index cannot address them.
///
/// # Complexity
/// O(n log n) in the number of pieces.
pub fn build_hierarchy(pieces: &Pieces) -> Result<Hierarchy, InputError> {
    if pieces.len() >= u32::MAX as usize / 2 {
        return Err(InputError::TooManyPieces {
            pieces: pieces.len(),
        });
    }
    Hierarchy::new(agglomerate(clusters_in_unit_cube(pieces)), pieces.len())
}

/// Creates a cluster for each piece, at the center of its box. The centers are scaled to the unit cube, so that pieces that are
/// tiny or far from the origin do not coincide in f32.
fn clusters_in_unit_cube(pieces: &Pieces) -> Vec<Cluster> {
    let all = (0..pieces.len()).into_par_iter();
    let center = |piece: usize| {
        let points = pieces.get(piece).points.iter().copied();
        let BoundingBox { lo, hi } = BoundingBox::enclosing(points);
        0.5 * lo + 0.5 * hi
    };
    let centers: Vec<DVec3> = all.with_min_len(PIECES_PER_TASK).map(center).collect();
    // Shares of fixed size do not depend on the number of threads.
    let shares = centers.par_chunks(PIECES_PER_TASK);
    let shares: Vec<BoundingBox> = shares
        .map(|share| BoundingBox::enclosing(share.iter().copied()))
        .collect();
    let corners = shares.iter().flat_map(|share| [share.lo, share.hi]);
    let BoundingBox { lo, hi } = BoundingBox::enclosing(corners);
    // A tiny length has no finite reciprocal.
    let scale = Some((hi - lo).max_element().recip()).filter(|scale| scale.is_finite());
    let cluster = |(piece, &center): (usize, &DVec3)| Cluster {
        center: ((center - lo) * scale.unwrap_or(1.0)).as_vec3a(),
        weight: 1.0,
        node: HierarchyNode::Leaf(piece as u32),
    };
    let centers = centers.par_iter().with_min_len(PIECES_PER_TASK).enumerate();
    centers.map(cluster).collect()
}

#[cfg(test)]
mod tests;
