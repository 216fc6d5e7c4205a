//! Builds binary hierarchies over pieces: median splits into clusters, agglomeration, reinsertion of subtrees.

mod agglomerate;
mod nodes;
mod reinsert;

use crate::bounds::BoundingBox;
use crate::tolerance::MAX_CLUSTER_PIECES;
use crate::tree::slot::SubtreeSlot;
use agglomerate::agglomerate;
use ccd_core::glam::{DVec3, Vec3A};
use ccd_core::{Hierarchy, HierarchyNode, InputError, Pieces};
use nodes::{AabbF32, Node, NodeContent};
use rayon::prelude::*;
use reinsert::reinsert_subtrees;

/// Builds a binary hierarchy over pieces. It splits them at medians into clusters, agglomerates each cluster, and
/// reinserts the worst subtrees.
///
/// Agglomeration alone (`[PLOC18]`) makes the best trees. On pieces that all have one centre, such as nested or equal
/// ones, it merges a single pair per pass, which takes quadratic time and makes a chain. Clusters bound both. The
/// builder of `parry3d` is sequential and bounds neither.
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
    let mut nodes = split_and_agglomerate(&leaves_in_unit_cube(pieces));
    reinsert_subtrees(&mut nodes);
    let node = |node: &Node| match node.content {
        NodeContent::Piece(piece) => HierarchyNode::Leaf(piece),
        NodeContent::Children(first) => HierarchyNode::Inner(first, first + 1),
    };
    let nodes = nodes.par_iter().with_min_len(PIECES_PER_TASK).map(node);
    Hierarchy::new(nodes.collect(), pieces.len())
}

/// Creates a leaf for each piece, with a box in f32. The boxes are scaled to the unit cube, so that pieces that are
/// tiny or far from the origin do not coincide.
fn leaves_in_unit_cube(pieces: &Pieces) -> Vec<Node> {
    let bounds = |piece: usize| {
        let piece = pieces.get(piece);
        let BoundingBox { lo, hi } = BoundingBox::enclosing(piece.points.iter().copied());
        BoundingBox {
            lo: lo - piece.radius,
            hi: hi + piece.radius,
        }
    };
    let all = (0..pieces.len()).into_par_iter();
    let boxes: Vec<BoundingBox> = all.with_min_len(PIECES_PER_TASK).map(bounds).collect();
    // Shares of fixed size do not depend on the number of threads.
    let corners =
        |share: &[BoundingBox]| BoundingBox::enclosing(share.iter().flat_map(|b| [b.lo, b.hi]));
    let shares: Vec<BoundingBox> = boxes.par_chunks(PIECES_PER_TASK).map(corners).collect();
    let BoundingBox { lo, hi } = corners(&shares);
    // A tiny length has no finite reciprocal.
    let scale = Some((hi - lo).max_element().recip()).filter(|s| s.is_finite());
    let unit = |p: DVec3| -> Vec3A { ((p - lo) * scale.unwrap_or(1.0)).as_vec3a() };
    let leaf = |(piece, bounds): (usize, &BoundingBox)| {
        let cuboid = AabbF32 {
            lo: unit(bounds.lo),
            hi: unit(bounds.hi),
        };
        Node::leaf(piece as u32, cuboid)
    };
    let leaves = boxes.par_iter().with_min_len(PIECES_PER_TASK).enumerate();
    leaves.map(leaf).collect()
}

/// The number of pieces in a parallel task. Smaller tasks cost more than they gain.
const PIECES_PER_TASK: usize = 4096;

/// Splits leaves at the medians of their centres into clusters, and agglomerates each cluster. Returns the nodes, the
/// root first.
fn split_and_agglomerate(leaves: &[Node]) -> Vec<Node> {
    let centres = (0..).zip(leaves).map(|(piece, leaf)| PieceCentre {
        coordinates: leaf.cuboid.centre().to_array(),
        piece,
    });
    let mut nodes = vec![leaves[0]; 2 * leaves.len() - 1];
    if let Some(slot) = SubtreeSlot::of_whole_tree(&mut nodes) {
        build_subtree(leaves, &mut centres.collect::<Vec<_>>(), slot);
    }
    nodes
}

/// The centre of a piece's bounding box.
#[derive(Clone, Copy)]
struct PieceCentre {
    coordinates: [f32; 3],
    piece: u32,
}

/// Builds the subtree over some pieces, in parallel if they are many.
fn build_subtree(leaves: &[Node], centres: &mut [PieceCentre], mut slot: SubtreeSlot<'_, Node>) {
    if centres.len() <= MAX_CLUSTER_PIECES {
        return build_cluster(leaves, centres, slot);
    }
    let is_shared = centres.len() > PIECES_PER_TASK;
    let (low, high) = split_at_median(centres);
    if let Some([left, right]) = slot.children(high.len()) {
        let build_left = || build_subtree(leaves, low, left);
        let build_right = || build_subtree(leaves, high, right);
        if is_shared {
            rayon::join(build_left, build_right);
        } else {
            build_left();
            build_right();
        }
    }
    *slot.node = Node {
        cuboid: slot.descendants[0].cuboid.union(slot.descendants[1].cuboid),
        content: NodeContent::Children(slot.first_descendant_index),
    };
}

/// Builds the subtree over a few pieces by agglomeration.
fn build_cluster(leaves: &[Node], centres: &[PieceCentre], slot: SubtreeSlot<'_, Node>) {
    let of_cluster = centres.iter().map(|centre| leaves[centre.piece as usize]);
    let tree = agglomerate(&of_cluster.collect::<Vec<_>>());
    let nodes = std::iter::once(slot.node).chain(slot.descendants);
    for (to, &from) in nodes.zip(&tree) {
        *to = from;
        // Node k > 0 of the small tree becomes node k + offset of the large one.
        if let NodeContent::Children(child) = &mut to.content {
            *child = *child - 1 + slot.first_descendant_index;
        }
    }
}

/// Splits pieces at the median of their centres along the longest axis.
fn split_at_median(centres: &mut [PieceCentre]) -> (&mut [PieceCentre], &mut [PieceCentre]) {
    let spread = centres.iter().fold(AabbF32::EMPTY, |all, centre| {
        all.union(AabbF32::from_point(centre.coordinates.into()))
    });
    let axis = spread.extent().max_position();
    let half = centres.len() / 2;
    centres.select_nth_unstable_by(half, |a, b| {
        let order = a.coordinates[axis].total_cmp(&b.coordinates[axis]);
        order.then(a.piece.cmp(&b.piece))
    });
    centres.split_at_mut(half)
}

#[cfg(test)]
mod tests;
