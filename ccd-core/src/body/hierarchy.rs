//! Binary hierarchies over pieces, in the form in which BVH builders return them.

use super::pieces::Pieces;
use crate::error::InputError;
use crate::math::vector::bounding_box;
use glam::DVec3;

/// A binary tree whose leaves are the pieces of a body, each exactly once.
///
/// A hierarchy only groups pieces; all bounds are computed from the pieces. A poor hierarchy therefore makes a query
/// slow, never wrong.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "Vec<HierarchyNode>", into = "Vec<HierarchyNode>")
)]
pub struct Hierarchy {
    nodes: Vec<HierarchyNode>,
}

/// A node of a [`Hierarchy`]; node 0 is the root.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum HierarchyNode {
    /// A leaf, with the index of its piece.
    Leaf(u32),
    /// An inner node, with the indices of its two children.
    Inner(u32, u32),
}

impl Hierarchy {
    /// Creates a hierarchy from the nodes of a tree over `pieces` pieces.
    ///
    /// # Errors
    /// [`InputError::BadHierarchy`] when a piece is missing, repeated or out of range, or a node is
    /// reached twice or never.
    pub fn new(nodes: Vec<HierarchyNode>, pieces: usize) -> Result<Self, InputError> {
        let (mut seen_node, mut seen_piece) = (vec![false; nodes.len()], vec![false; pieces]);
        let mut stack = vec![0u32];
        while let Some(node) = stack.pop() {
            let at = node as usize;
            match seen_node.get_mut(at) {
                Some(seen @ false) => *seen = true,
                _ => return Err(InputError::BadHierarchy { index: at }),
            }
            match nodes[at] {
                HierarchyNode::Inner(left, right) => stack.extend([left, right]),
                HierarchyNode::Leaf(piece) => match seen_piece.get_mut(piece as usize) {
                    Some(seen @ false) => *seen = true,
                    _ => {
                        return Err(InputError::BadHierarchy {
                            index: piece as usize,
                        });
                    }
                },
            }
        }
        let unseen = seen_node.iter().position(|s| !s);
        match unseen.or_else(|| seen_piece.iter().position(|s| !s)) {
            Some(at) => Err(InputError::BadHierarchy { index: at }),
            None => Ok(Hierarchy { nodes }),
        }
    }

    /// Builds a hierarchy by recursive splits at the median of the pieces' centers, along the longest side of their
    /// box.
    pub fn median_split(pieces: &Pieces) -> Self {
        let centers: Vec<DVec3> = pieces
            .iter()
            .map(|piece| {
                let (lo, hi) = bounding_box(piece.points.iter().copied());
                0.5 * (lo + hi)
            })
            .collect();
        let mut order: Vec<u32> = (0..pieces.len() as u32).collect();
        let mut nodes = vec![HierarchyNode::Leaf(0)];
        let mut stack = vec![(0usize, 0usize, order.len())];
        while let Some((node, start, end)) = stack.pop() {
            let range = &mut order[start..end];
            if let [piece] = range {
                nodes[node] = HierarchyNode::Leaf(*piece);
                continue;
            }
            let (lo, hi) = bounding_box(range.iter().map(|&k| centers[k as usize]));
            let axis = (hi - lo).max_position();
            let half = range.len() / 2;
            range.select_nth_unstable_by(half, |&a, &b| {
                centers[a as usize][axis].total_cmp(&centers[b as usize][axis])
            });
            let left = nodes.len();
            nodes.extend([HierarchyNode::Leaf(0); 2]);
            nodes[node] = HierarchyNode::Inner(left as u32, left as u32 + 1);
            stack.extend([(left, start, start + half), (left + 1, start + half, end)]);
        }
        Hierarchy { nodes }
    }

    /// Returns the nodes, the root first.
    pub fn nodes(&self) -> &[HierarchyNode] {
        &self.nodes
    }
}

#[cfg(feature = "serde")]
impl TryFrom<Vec<HierarchyNode>> for Hierarchy {
    type Error = InputError;

    /// Creates a hierarchy from stored nodes, over as many pieces as there are leaves.
    fn try_from(nodes: Vec<HierarchyNode>) -> Result<Self, InputError> {
        let leaf = |node: &&HierarchyNode| matches!(node, HierarchyNode::Leaf(_));
        let pieces = nodes.iter().filter(leaf).count();
        Hierarchy::new(nodes, pieces)
    }
}

#[cfg(feature = "serde")]
impl From<Hierarchy> for Vec<HierarchyNode> {
    fn from(hierarchy: Hierarchy) -> Self {
        hierarchy.nodes
    }
}

#[cfg(test)]
mod tests;
