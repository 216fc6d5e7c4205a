//! A stack of nodes for depth-first traversals of a tree.

use super::NodeId;

/// A stack of nodes that allocates nothing unless the tree is deeper than any balanced one.
pub(super) struct NodeStack {
    inline_nodes: [NodeId; INLINE_CAPACITY],
    count: usize,
    /// The nodes for which `inline_nodes` has no room.
    overflow: Vec<NodeId>,
}

/// The number of nodes that need no allocation. Each level leaves up to seven nodes: this is enough for nine levels of
/// eight children, 10⁸ pieces.
const INLINE_CAPACITY: usize = 64;

impl NodeStack {
    /// Creates a stack that holds the root.
    pub(super) fn root() -> Self {
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
mod tests {
    use super::*;
    use crate::tests::scene::{RngExt, rng};

    #[test]
    fn nodes_come_back_as_from_a_list() {
        let mut rng = rng(1);
        let (mut waiting, mut list) = (NodeStack::root(), vec![0]);
        let mut most = 0;
        for k in 0..20_000u32 {
            let count = rng.random_range(0..9);
            // The stack grows for a while, and shrinks again.
            let pops = rng.random_range(0..9) + if k % 400 < 200 { 0 } else { 3 };
            waiting.extend(k..k + count);
            list.extend(k..k + count);
            most = most.max(list.len());
            for _ in 0..pops {
                assert_eq!(waiting.pop(), list.pop());
            }
        }
        assert!(most > 2 * INLINE_CAPACITY, "{most}");
    }
}
