//! Which pieces are at a point.

use super::{Below, Node, Tree};
use glam::DVec3;

/// The pieces that are no triangles and whose boxes hold a point, or nearly.
pub(crate) fn pieces_at(tree: &Tree, point: DVec3) -> Vec<u32> {
    let mut found = Vec::new();
    let mut stack = vec![0u32];
    while let Some(id) = stack.pop() {
        let node = &tree.nodes[id as usize];
        if !holds(node, point) {
            continue;
        }
        match node.below {
            Below::Boxes(group) => {
                let members = &tree.boxes[group as usize].members;
                stack.extend(members.first..members.first + members.count);
            }
            Below::Piece(piece) => found.push(piece),
            Below::Triangles(_) => {}
        }
    }
    found
}

/// Whether a point is within a node's box, or near it.
pub(super) fn holds(node: &Node, point: DVec3) -> bool {
    let way = point - node.centre;
    (0..3).all(|k| way.dot(node.axes[k].as_dvec3()).abs() <= node.reach_f64(k))
}
