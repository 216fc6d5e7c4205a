//! The split of one node of a pair.

use crate::body::tree::NodeId;
use crate::problem::WhichBody;

/// A node to split, and the other body's node with which its children are paired.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Split {
    /// The body to which the split node belongs.
    pub(crate) body: WhichBody,
    pub(crate) node: NodeId,
    pub(crate) other_node: NodeId,
    /// The children to bound against the other node: bit `k` stands for child `k`.
    pub(crate) lane_mask: u8,
}

impl Split {
    /// Creates the split of a node in which all its children are bounded.
    pub(crate) fn with_all_children(body: WhichBody, node: NodeId, other: NodeId) -> Self {
        Split {
            body,
            node,
            other_node: other,
            lane_mask: u8::MAX,
        }
    }
}
