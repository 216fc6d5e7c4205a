//! Renumbers the leaves of a hull tree for a reordered list of pieces.

use super::HullTree;
use super::error::{HullFault, HullTreeError};
use crate::body::hierarchy::{Hierarchy, HierarchyNode};
use crate::body::pieces::Pieces;
use std::cmp::Ordering;

impl HullTree {
    /// Renumbers the leaves so that they refer to the same pieces, bitwise equal, in another order. Among equal pieces,
    /// the first leaf gets the first piece.
    ///
    /// # Errors
    /// [`HullFault::NotAPiece`] at a leaf that is not in the list.
    pub(crate) fn renumber_leaves(self, pieces: &Pieces) -> Result<Self, HullTreeError> {
        let hulls = self.hulls();
        let mut renamed = self.hierarchy.nodes().to_vec();
        let nodes = (0..renamed.len()).filter(|&at| matches!(renamed[at], HierarchyNode::Leaf(_)));
        let leaves = sorted_by_piece(nodes.collect(), hulls);
        let known = sorted_by_piece((0..pieces.len()).collect(), pieces);
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
        let hierarchy = Hierarchy::new(renamed, pieces.len())?;
        Ok(HullTree { hierarchy, ..self })
    }
}

/// Returns the numbers of pieces sorted by the pieces, and by number where two of these are equal.
fn sorted_by_piece(mut numbers: Vec<usize>, pieces: &Pieces) -> Vec<usize> {
    numbers.sort_unstable_by(|&one, &other| {
        compare_pieces([pieces; 2], [one, other]).then(one.cmp(&other))
    });
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
