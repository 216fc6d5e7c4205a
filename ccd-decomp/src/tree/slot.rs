//! Slots for subtrees in the node list of a binary tree, which is filled from the root.

/// The slot of a subtree in the node list: its root and the range of its descendants.
pub(super) struct SubtreeSlot<'n, N> {
    pub(super) node: &'n mut N,
    /// The descendants: the two children, then the descendants of the second child, then the descendants of the first
    /// child.
    pub(super) descendants: &'n mut [N],
    /// The index of the first descendant.
    pub(super) first_descendant_index: u32,
}

impl<'n, N> SubtreeSlot<'n, N> {
    /// Returns the slot of the whole tree; `None` for a tree without nodes.
    pub(super) fn of_whole_tree(nodes: &'n mut [N]) -> Option<Self> {
        let (node, below) = nodes.split_first_mut()?;
        Some(SubtreeSlot {
            node,
            descendants: below,
            first_descendant_index: 1,
        })
    }

    /// Returns the slots of both children; `None` for a leaf. The second child has `leaves` leaves.
    pub(super) fn children(&mut self, leaves: usize) -> Option<[SubtreeSlot<'_, N>; 2]> {
        let [left, right, below @ ..] = &mut *self.descendants else {
            return None;
        };
        let (below_right, below_left) = below.split_at_mut(2 * (leaves - 1));
        let first = self.first_descendant_index + 2;
        let of_left = SubtreeSlot {
            node: left,
            first_descendant_index: first + below_right.len() as u32,
            descendants: below_left,
        };
        let of_right = SubtreeSlot {
            node: right,
            first_descendant_index: first,
            descendants: below_right,
        };
        Some([of_left, of_right])
    }
}
