//! Hull trees over pieces: split top down, hulls built bottom up `[SWIFT01]`.

mod split;

use crate::hull::{HullError, Way, hull};
use crate::tolerance::SIDE_BY_SIDE;
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
/// the same tree, on any number of threads; no input panics.
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
    let mut order: Vec<u32> = (0..pieces.len() as u32).collect();
    let mut nodes = vec![HullNode::Leaf(0); (2 * order.len()).saturating_sub(1)];
    let grower = Grower {
        pieces,
        splitter: Splitter::new(pieces),
    };
    let rebuilt = match nodes.split_first_mut() {
        Some((root, below)) => grower.grow(
            &mut order,
            Place {
                node: root,
                below,
                first: 1,
            },
        )?,
        None => 0,
    };
    let tree = HullTree::new(pieces, &nodes)?;
    // Giving back that much memory takes a while, which nobody has to wait for.
    rayon::spawn(move || drop(nodes));
    Ok(Grown { tree, rebuilt })
}

struct Grower<'a> {
    pieces: &'a Pieces,
    splitter: Splitter,
}

/// Where a subtree goes: its root, and all below, which starts at a number.
struct Place<'a> {
    node: &'a mut HullNode,
    below: &'a mut [HullNode],
    first: u32,
}

impl Grower<'_> {
    /// Makes the subtree over some pieces, every node before its children, and says how many hulls were
    /// rebuilt. A share of the pieces goes to either side, so that the depth is logarithmic.
    fn grow(&self, pieces: &mut [u32], place: Place<'_>) -> Result<usize, BuildError> {
        let Place { node, below, first } = place;
        if let [piece] = *pieces {
            *node = HullNode::Leaf(piece);
            return Ok(0);
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
        let to_left = Place {
            node: left,
            below: below_left,
            first: left_start,
        };
        let to_right = Place {
            node: right,
            below: below_right,
            first: start,
        };
        let (grown_left, grown_right) = match count >= SIDE_BY_SIDE {
            true => rayon::join(
                || self.grow(of_left, to_left),
                || self.grow(of_right, to_right),
            ),
            false => (self.grow(of_left, to_left), self.grow(of_right, to_right)),
        };
        let rebuilt = grown_left? + grown_right?;
        let corners = [&*left, &*right].map(|child| corners(child, self.pieces));
        let (hull, way) = joint_hull(&corners.concat())?;
        *node = HullNode::Inner([first, first + 1], hull);
        Ok(rebuilt + usize::from(way == Way::Rebuilt))
    }
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
        Ok(mut found) => {
            let mut number = vec![0; points.len()];
            for (k, &v) in (0..).zip(&found.vertices) {
                number[v as usize] = k;
            }
            for corner in found.facets.iter_mut().flatten() {
                *corner = number[*corner as usize];
            }
            let hull = Hull {
                points: found.vertices.iter().map(|&v| point(v)).collect(),
                facets: found.facets,
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
