//! A stack of nodes for depth-first traversals of a tree.

use super::NodeId;

/// A stack of nodes that allocates memory only if the tree is deeper than a balanced tree can be.
pub(super) struct NodeStack {
    inline_nodes: [NodeId; INLINE_CAPACITY],
    count: usize,
    /// The nodes on top of the stack for which `inline_nodes` has no room.
    overflow: Vec<NodeId>,
}

/// The number of nodes that the stack holds without an allocation. Each level leaves up to seven nodes: this is enough
/// for nine levels of eight children, 10⁸ pieces.
const INLINE_CAPACITY: usize = 64;

impl NodeStack {
    /// Creates a stack that contains only the tree's root.
    pub(super) fn with_root() -> Self {
        NodeStack {
            inline_nodes: [0; INLINE_CAPACITY],
            count: 1,
            overflow: Vec::new(),
        }
    }

    pub(super) fn pop(&mut self) -> Option<NodeId> {
        self.overflow.pop().or_else(|| {
            self.count = self.count.checked_sub(1)?;
            Some(self.inline_nodes[self.count])
        })
    }

    pub(super) fn extend(&mut self, nodes: impl Iterator<Item = NodeId>) {
        for node in nodes {
            match self.inline_nodes.get_mut(self.count) {
                Some(place) => {
                    *place = node;
                    self.count += 1;
                }
                None => self.overflow.push(node),
            }
        }
    }
}

#[cfg(test)]
mod tests;
