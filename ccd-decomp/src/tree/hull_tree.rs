//! Builds hull trees over pieces by top-down splits and bottom-up hulls `[SWIFT01]`.

mod split;

use crate::hull::{HullError, hull};
use crate::tolerance::MIN_PARALLEL_PIECES;
use crate::tree::slot::SubtreeSlot;
use ccd_core::glam::DVec3;
use ccd_core::{HullNode, HullTree, HullTreeError, InputError, Pieces};
use split::Splitter;

/// Builds a binary tree of convex hulls over pieces.
///
/// Pieces are split across the longest direction of the hull of their centers: at the middle or, if that leaves too few
/// on one side, at the median. The hull of a node is that of its children's corners.
///
/// # Guarantee
/// Every hull is exact. The depth is at most logarithmic in the number of pieces. The same pieces give
/// the same tree, on any number of threads; no input panics.
///
/// # Errors
/// [`HullTreeBuildError`]: a coordinate is out of range for exact predicates, or there are too many pieces.
///
/// # Complexity
/// O(n log² n) for n corners where few of them stay corners from level to level; at worst O(h n log n)
/// for hulls of up to h facets.
pub fn build_hull_tree(pieces: &Pieces) -> Result<HullTree, HullTreeBuildError> {
    if pieces.len() >= u32::MAX as usize / 2 {
        let pieces = pieces.len();
        return Err(HullTreeError::from(InputError::TooManyPieces { pieces }).into());
    }
    let mut order: Vec<u32> = (0..pieces.len() as u32).collect();
    let mut nodes = vec![HullNode::Leaf(0); (2 * order.len()).saturating_sub(1)];
    let grower = TreeBuilder {
        pieces,
        splitter: Splitter::new(pieces),
    };
    if let Some(slot) = SubtreeSlot::of_whole_tree(&mut nodes) {
        grower.build_subtree(&mut order, slot)?;
    }
    Ok(HullTree::new(pieces, &nodes)?)
}

struct TreeBuilder<'a> {
    pieces: &'a Pieces,
    splitter: Splitter,
}

impl TreeBuilder<'_> {
    /// Builds the subtree over some pieces, parents before children. Each child gets at least a fixed fraction of the
    /// pieces, so that the depth is logarithmic.
    fn build_subtree(
        &self,
        pieces: &mut [u32],
        mut slot: SubtreeSlot<'_, HullNode>,
    ) -> Result<(), HullTreeBuildError> {
        if let [piece] = *pieces {
            *slot.node = HullNode::Leaf(piece);
            return Ok(());
        }
        let count = pieces.len();
        let middle = self.splitter.split(pieces);
        let (of_left, of_right) = pieces.split_at_mut(middle);
        let Some([left, right]) = slot.children(of_right.len()) else {
            return Ok(());
        };
        let build_left = || self.build_subtree(of_left, left);
        let build_right = || self.build_subtree(of_right, right);
        let (grown_left, grown_right) = if count >= MIN_PARALLEL_PIECES {
            rayon::join(build_left, build_right)
        } else {
            (build_left(), build_right())
        };
        grown_left.and(grown_right)?;
        let children = &slot.descendants[..2];
        let points: Vec<DVec3> = children
            .iter()
            .flat_map(|child| corners(child, self.pieces))
            .copied()
            .collect();
        let out_of_range = |error: HullError| {
            HullTreeBuildError::CoordinateOutOfRange(points[error.point_index as usize])
        };
        let hull = hull(&points).map_err(out_of_range)?;
        *slot.node = HullNode::Inner(
            [slot.first_descendant_index, slot.first_descendant_index + 1],
            hull,
        );
        Ok(())
    }
}

/// The reason why no hull tree can be built over pieces.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HullTreeBuildError {
    /// A coordinate of a point is out of range for exact predicates.
    #[error("the point {0} has a coordinate that is out of range for exact predicates")]
    CoordinateOutOfRange(DVec3),
    /// The checks of `ccd_core` reject the tree.
    #[error(transparent)]
    InvalidTree(#[from] HullTreeError),
}

fn corners<'a>(node: &'a HullNode, pieces: &'a Pieces) -> &'a [DVec3] {
    match node {
        HullNode::Leaf(piece) => pieces.get(*piece as usize).points,
        HullNode::Inner(_, hull) => &hull.points,
    }
}

#[cfg(test)]
mod tests;
