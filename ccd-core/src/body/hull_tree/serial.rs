//! Serialises a hull tree as its pieces and its input nodes. A tree that is read is checked like one that is built.

use super::{HullNode, HullTree, HullTreeError};
use crate::body::hierarchy::HierarchyNode;
use crate::body::pieces::Pieces;
use crate::body::polytope::Polytope;
use serde::{Deserialize, Serialize};

#[derive(Serialize, Deserialize)]
pub(super) struct StoredHullTree {
    pieces: Vec<Polytope>,
    nodes: Vec<HullNode>,
}

impl From<HullTree> for StoredHullTree {
    fn from(tree: HullTree) -> Self {
        let nodes = tree.hierarchy.nodes().iter().enumerate();
        let mut pieces: Vec<(u32, Polytope)> = nodes
            .filter_map(|(at, node)| match node {
                HierarchyNode::Leaf(piece) => Some((*piece, tree.hulls().polytope(at))),
                HierarchyNode::Inner(..) => None,
            })
            .collect();
        pieces.sort_by_key(|(piece, _)| *piece);
        StoredHullTree {
            pieces: pieces.into_iter().map(|(_, polytope)| polytope).collect(),
            nodes: tree.to_nodes(),
        }
    }
}

impl TryFrom<StoredHullTree> for HullTree {
    type Error = HullTreeError;

    fn try_from(stored: StoredHullTree) -> Result<Self, HullTreeError> {
        HullTree::new(&Pieces::from_polytopes(&stored.pieces)?, &stored.nodes)
    }
}
