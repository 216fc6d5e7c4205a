//! Hull trees over pieces: split top down, hulls built bottom up `[SWIFT01]`.

mod split;

use crate::hull::{HullError, Way, hull};
use ccd_core::glam::DVec3;
use ccd_core::{Hull, HullNode, HullTree, HullTreeError, InputError, Pieces};
use split::Splitter;

/// Builds the convex hull tree of pieces.
///
/// The pieces are split where the hull of their centres is longest, at half its length or, where that
/// leaves too few on one side, at the median; the hull of a node is that of its children's corners.
///
/// # Guarantee
/// Every hull is exact. The depth is at most logarithmic in the number of pieces. The same pieces give
/// the same tree; no input panics.
///
/// # Errors
/// [`BuildError`]: a coordinate that exact predicates cannot deal with, or too many pieces.
///
/// # Complexity
/// O(n log² n) for n corners where few of them stay corners from level to level; at worst O(h n log n)
/// for hulls of up to h facets.
pub fn build_hull_tree(pieces: &Pieces) -> Result<HullTree, BuildError> {
    Ok(grow(pieces)?.tree)
}

/// A hull tree, and how it came about.
pub(crate) struct Grown {
    pub(crate) tree: HullTree,
    /// How many hulls the library got wrong, so that they were computed exactly.
    pub(crate) rebuilt: usize,
}

/// As [`build_hull_tree`], with an account.
pub(crate) fn grow(pieces: &Pieces) -> Result<Grown, BuildError> {
    if pieces.len() >= u32::MAX as usize / 2 {
        let pieces = pieces.len();
        return Err(HullTreeError::from(InputError::TooManyPieces { pieces }).into());
    }
    let mut nodes = split_all(pieces);
    let mut rebuilt = 0;
    // Children come after their parents.
    for at in (0..nodes.len()).rev() {
        if let HullNode::Inner(children, _) = nodes[at] {
            let corners = children.map(|child| corners(&nodes[child as usize], pieces));
            let (hull, way) = joint_hull(&corners.concat())?;
            rebuilt += usize::from(way == Way::Rebuilt);
            nodes[at] = HullNode::Inner(children, hull);
        }
    }
    let tree = HullTree::new(pieces, &nodes)?;
    Ok(Grown { tree, rebuilt })
}

/// Why pieces have no hull tree.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// A coordinate is so near to 0 that exact predicates cannot tell on which side it is.
    #[error("the point {0} has a coordinate that is out of range for exact predicates")]
    OutOfRange(DVec3),
    /// A hull could not be proven to be one.
    #[error("the hull of {points} points could not be proven")]
    Unproven {
        /// How many points it is of.
        points: usize,
    },
    /// The core does not take the tree.
    #[error(transparent)]
    Tree(#[from] HullTreeError),
}

/// The tree without hulls: every node before its children.
fn split_all(pieces: &Pieces) -> Vec<HullNode> {
    let splitter = Splitter::new(pieces);
    let mut order: Vec<u32> = (0..pieces.len() as u32).collect();
    let mut nodes = vec![HullNode::Leaf(0)];
    let mut stack = vec![(0, 0, order.len())];
    // Either side of a split has fewer pieces.
    while let Some((at, start, end)) = stack.pop() {
        let range = &mut order[start..end];
        if let [piece] = *range {
            nodes[at] = HullNode::Leaf(piece);
            continue;
        }
        let middle = start + splitter.split(range);
        let left = nodes.len();
        nodes.extend([HullNode::Leaf(0), HullNode::Leaf(0)]);
        let children = [left, left + 1].map(|child| child as u32);
        nodes[at] = HullNode::Inner(children, Hull::default());
        stack.extend([(left, start, middle), (left + 1, middle, end)]);
    }
    nodes
}

fn corners<'a>(node: &'a HullNode, pieces: &'a Pieces) -> &'a [DVec3] {
    match node {
        HullNode::Leaf(piece) => pieces.get(*piece as usize).points,
        HullNode::Inner(_, hull) => &hull.points,
    }
}

fn joint_hull(points: &[DVec3]) -> Result<(Hull, Way), BuildError> {
    let point = |k: u32| points[k as usize];
    let lower = |points| Hull {
        points,
        facets: Vec::new(),
    };
    match hull(points) {
        Ok(found) => {
            let mut number = vec![0; points.len()];
            for (k, &v) in (0..).zip(&found.vertices) {
                number[v as usize] = k;
            }
            let facets = found.facets.iter();
            let hull = Hull {
                points: found.vertices.iter().map(|&v| point(v)).collect(),
                facets: facets
                    .map(|corners| corners.iter().map(|&v| number[v as usize]).collect())
                    .collect(),
            };
            Ok((hull, found.way))
        }
        Err(HullError::Single(a)) => Ok((lower(vec![point(a)]), Way::Flat)),
        Err(HullError::Collinear(a, b)) => Ok((lower(vec![point(a), point(b)]), Way::Flat)),
        Err(HullError::OutOfRange(a)) => Err(BuildError::OutOfRange(point(a))),
        Err(HullError::Empty | HullError::Unproven(_)) => Err(BuildError::Unproven {
            points: points.len(),
        }),
    }
}

#[cfg(test)]
mod tests;
