//! Renumbers the leaves of a hull tree for a reordered list of pieces.

use super::HullTree;
use super::error::{HullFault, HullTreeError};
use crate::body::hierarchy::{Hierarchy, HierarchyNode};
use crate::body::pieces::Pieces;
use std::cmp::Ordering;

impl HullTree {
    /// Renumbers the leaves so that they refer to the same pieces in another order.
    ///
    /// # Errors
    /// [`HullFault::NotAPiece`] at a leaf that is not in the list.
    pub(crate) fn renumber_leaves(self, pieces: &Pieces) -> Result<Self, HullTreeError> {
        let hierarchy = renumbered_hierarchy(&self, pieces)?;
        Ok(HullTree { hierarchy, ..self })
    }
}

/// Returns the tree's hierarchy with its leaves renumbered for `pieces`. These must be the tree's pieces, bitwise
/// equal, in any order. Among equal pieces, the first leaf gets the first piece.
fn renumbered_hierarchy(tree: &HullTree, pieces: &Pieces) -> Result<Hierarchy, HullTreeError> {
    let hulls = tree.hulls();
    let mut renamed = tree.hierarchy.nodes().to_vec();
    let nodes = (0..renamed.len()).filter(|&at| matches!(renamed[at], HierarchyNode::Leaf(_)));
    let leaves = sort_numbers_by(nodes.collect(), |one, other| {
        compare_pieces([hulls, hulls], [one, other])
    });
    let known = sort_numbers_by((0..pieces.len()).collect(), |one, other| {
        compare_pieces([pieces, pieces], [one, other])
    });
    let mut known = known.into_iter().peekable();
    let mut found = Vec::with_capacity(leaves.len());
    for at in leaves {
        let to_leaf = |&k: &usize| compare_pieces([pieces, hulls], [k, at]);
        // A piece that is less than this leaf is not a leaf.
        while known.next_if(|k| to_leaf(k) == Ordering::Less).is_some() {}
        let same = known.next_if(|k| to_leaf(k) == Ordering::Equal);
        found.push((at, same));
    }
    found.sort_unstable();
    for (at, same) in found {
        let piece = same.ok_or(HullFault::NotAPiece.at_node(at))?;
        renamed[at] = HierarchyNode::Leaf(piece as u32);
    }
    // This also fails if a piece of the list is not a leaf.
    Ok(Hierarchy::new(renamed, pieces.len())?)
}

/// Returns the numbers sorted by `order`, and by number where `order` finds two of them equal.
fn sort_numbers_by(
    mut numbers: Vec<usize>,
    order: impl Fn(usize, usize) -> Ordering,
) -> Vec<usize> {
    numbers.sort_unstable_by(|&one, &other| order(one, other).then(one.cmp(&other)));
    numbers
}

/// Compares two pieces bit by bit: their points, radii and mesh numbers.
fn compare_pieces(of: [&Pieces; 2], at: [usize; 2]) -> Ordering {
    let [one, other] = [0, 1].map(|k| of[k].get(at[k]));
    let bits = |p: &glam::DVec3| p.to_array().map(f64::to_bits);
    let points = || {
        one.points
            .iter()
            .map(bits)
            .cmp(other.points.iter().map(bits))
    };
    let radii = || one.radius.to_bits().cmp(&other.radius.to_bits());
    let ids = || of[0].vertex_ids(at[0]).cmp(of[1].vertex_ids(at[1]));
    points().then_with(radii).then_with(ids)
}
