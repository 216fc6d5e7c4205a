//! Leaves found again in another list of the same pieces.

use super::HullTree;
use super::error::{HullFault, HullTreeError};
use crate::hierarchy::{Hierarchy, HierarchyNode};
use crate::pieces::Pieces;
use std::collections::HashMap;

/// The tree's hierarchy, with leaves that name the pieces of a list that they are to the bit.
pub(super) fn renumber(tree: &HullTree, pieces: &Pieces) -> Result<Hierarchy, HullTreeError> {
    let mut known: HashMap<Key, Vec<u32>> = HashMap::new();
    for k in (0..pieces.len()).rev() {
        known.entry(key(pieces, k)).or_default().push(k as u32);
    }
    let mut renamed = tree.hierarchy.nodes().to_vec();
    for (at, node) in renamed.iter_mut().enumerate() {
        if let HierarchyNode::Leaf(piece) = node {
            let same = known.get_mut(&key(&tree.hulls, at)).and_then(Vec::pop);
            *piece = same.ok_or(HullFault::NotAPiece.at(at))?;
        }
    }
    // Also fails where the list has a piece that no leaf is.
    Ok(Hierarchy::new(renamed, pieces.len())?)
}

/// A piece's points, rounding and numbers in the mesh, to the bit.
type Key = (Vec<[u64; 3]>, u64, Vec<u32>);

fn key(pieces: &Pieces, k: usize) -> Key {
    let piece = pieces.get(k);
    let bits = |p: &glam::DVec3| p.to_array().map(f64::to_bits);
    (
        piece.points.iter().map(bits).collect(),
        piece.radius.to_bits(),
        pieces.vertex_ids(k).to_vec(),
    )
}
