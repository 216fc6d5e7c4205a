//! Builds hull trees over pieces: top-down splits, bottom-up hulls `[SWIFT01]`.

mod split;

use crate::hull::{HullError, unproven_hull};
use crate::tolerance::SIDE_BY_SIDE;
use ccd_core::glam::DVec3;
use ccd_core::{Hull, HullNode, HullTree, HullTreeError, InputError, Loops, Pieces};
use split::Splitter;

/// Builds the convex hull tree of pieces.
///
/// Pieces are split across the longest direction of the hull of their centres: at the middle or, if that leaves too few
/// on one side, at the median. The hull of a node is that of its children's corners.
///
/// # Guarantee
/// Every hull is exact. The depth is at most logarithmic in the number of pieces. The same pieces give
/// the same tree, on any number of threads; no input panics.
///
/// # Errors
/// [`BuildError`]: a coordinate is out of range for exact predicates, or there are too many pieces.
///
/// # Complexity
/// O(n log² n) for n corners where few of them stay corners from level to level; at worst O(h n log n)
/// for hulls of up to h facets.
pub fn build_hull_tree(pieces: &Pieces) -> Result<HullTree, BuildError> {
    if pieces.len() >= u32::MAX as usize / 2 {
        let pieces = pieces.len();
        return Err(HullTreeError::from(InputError::TooManyPieces { pieces }).into());
    }
    let mut order: Vec<u32> = (0..pieces.len() as u32).collect();
    let mut nodes = vec![HullNode::Leaf(0); (2 * order.len()).saturating_sub(1)];
    let grower = Grower {
        pieces,
        splitter: Splitter::new(pieces),
    };
    if let Some((root, below)) = nodes.split_first_mut() {
        let slot = Slot {
            node: root,
            below,
            first: 1,
        };
        grower.grow(&mut order, slot)?;
    }
    Ok(HullTree::new(pieces, &nodes)?)
}

struct Grower<'a> {
    pieces: &'a Pieces,
    splitter: Splitter,
}

/// The slot of a subtree: root, descendants, and the index of the first descendant.
struct Slot<'a> {
    node: &'a mut HullNode,
    below: &'a mut [HullNode],
    first: u32,
}

impl Grower<'_> {
    /// Builds the subtree over some pieces, every node before its children. Each side gets at least a fixed share of
    /// the pieces, so that the depth is logarithmic.
    fn grow(&self, pieces: &mut [u32], slot: Slot<'_>) -> Result<(), BuildError> {
        let Slot { node, below, first } = slot;
        if let [piece] = *pieces {
            *node = HullNode::Leaf(piece);
            return Ok(());
        }
        let count = pieces.len();
        let middle = self.splitter.split(pieces);
        let (of_left, of_right) = pieces.split_at_mut(middle);
        let [left, right, below @ ..] = below else {
            return Err(BuildError::Unproven { points: 0 });
        };
        let (below_right, below_left) = below.split_at_mut(2 * (of_right.len() - 1));
        let start = first + 2;
        let left_start = start + below_right.len() as u32;
        let to_left = Slot {
            node: left,
            below: below_left,
            first: left_start,
        };
        let to_right = Slot {
            node: right,
            below: below_right,
            first: start,
        };
        let (grown_left, grown_right) = if count >= SIDE_BY_SIDE {
            rayon::join(
                || self.grow(of_left, to_left),
                || self.grow(of_right, to_right),
            )
        } else {
            (self.grow(of_left, to_left), self.grow(of_right, to_right))
        };
        grown_left.and(grown_right)?;
        let corners = [&*left, &*right].map(|child| corners(child, self.pieces));
        let hull = joint_hull(&corners.concat())?;
        *node = HullNode::Inner([first, first + 1], hull);
        Ok(())
    }
}

/// The reason why pieces have no hull tree.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// A coordinate of a point is out of range for exact predicates.
    #[error("the point {0} has a coordinate that is out of range for exact predicates")]
    OutOfRange(DVec3),
    /// A hull could not be proven.
    #[error("the hull of {points} points could not be proven")]
    Unproven {
        /// The number of points.
        points: usize,
    },
    /// The core rejects the tree.
    #[error(transparent)]
    Tree(#[from] HullTreeError),
}

fn corners<'a>(node: &'a HullNode, pieces: &'a Pieces) -> &'a [DVec3] {
    match node {
        HullNode::Leaf(piece) => pieces.get(*piece as usize).points,
        HullNode::Inner(_, hull) => &hull.points,
    }
}

/// Computes the hull of some points. The core proves it when the tree is created.
fn joint_hull(points: &[DVec3]) -> Result<Hull, BuildError> {
    let point = |k: u32| points[k as usize];
    let lower = |points| Hull {
        points,
        facets: Loops::default(),
    };
    match unproven_hull(points) {
        Ok(found) => {
            let (points, facets) = found.corners_and_facets(points);
            Ok(Hull { points, facets })
        }
        Err(HullError::Single(a)) => Ok(lower(vec![point(a)])),
        Err(HullError::Collinear(a, b)) => Ok(lower(vec![point(a), point(b)])),
        Err(HullError::OutOfRange(a)) => Err(BuildError::OutOfRange(point(a))),
        Err(HullError::Empty | HullError::Unproven(_)) => Err(BuildError::Unproven {
            points: points.len(),
        }),
    }
}

#[cfg(test)]
mod tests;
