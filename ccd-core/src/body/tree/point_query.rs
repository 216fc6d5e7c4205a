//! Queries for the pieces at a point, and for the surface near it.

use super::waiting::Waiting;
use super::{Below, Tree};
use crate::body::pieces::Pieces;
use crate::tolerance::SIGN_F64;
use glam::DVec3;

/// Returns the pieces that are no triangles and whose boxes contain a point, or nearly.
pub(crate) fn pieces_at(tree: &Tree, point: DVec3) -> impl Iterator<Item = u32> {
    let mut stack = Waiting::root();
    std::iter::from_fn(move || {
        while let Some(id) = stack.pop() {
            let node = &tree.nodes[id as usize];
            if !node.holds(point, 0.0) {
                continue;
            }
            match node.below {
                Below::Boxes(group) => {
                    let members = &tree.boxes[group as usize].members;
                    stack.extend(members.first..members.first + members.count);
                }
                Below::Piece(piece) => return Some(piece),
                Below::Triangles(_) => {}
            }
        }
        None
    })
}

/// Returns whether a point is certainly farther than `reach` from the surface: from the triangles,
/// or the mesh's faces on the pieces.
pub(crate) fn is_clear(tree: &Tree, pieces: &Pieces, point: DVec3, reach: f64) -> bool {
    let mut stack = Waiting::root();
    while let Some(id) = stack.pop() {
        let node = &tree.nodes[id as usize];
        if !node.holds(point, reach) {
            continue;
        }
        let clear = match node.below {
            Below::Boxes(group) => {
                let members = &tree.boxes[group as usize].members;
                stack.extend(members.first..members.first + members.count);
                true
            }
            Below::Triangles(group) => {
                let members = tree.triangle_members(group);
                let first = members.first as usize - tree.nodes.len();
                (first..first + members.count as usize)
                    .all(|piece| is_past(pieces.triangle(piece), point, reach))
            }
            Below::Piece(piece) => pieces
                .get(piece as usize)
                .mesh_triangles()
                .all(|(_, triangle)| is_past(triangle, point, reach)),
        };
        if !clear {
            return false;
        }
    }
    true
}

/// Returns whether an axis shows that a point is farther than `reach` from a triangle: the normal
/// of its plane, or the direction from an edge or a corner.
fn is_past(triangle: [DVec3; 3], point: DVec3, reach: f64) -> bool {
    let corners = triangle.map(|corner| corner - point);
    let size = |v: DVec3| v.abs().element_sum();
    let separates = |axis: DVec3| {
        let beyond = |p: &DVec3| axis.dot(*p) > (reach + SIGN_F64 * size(*p)) * size(axis);
        corners.iter().all(beyond)
    };
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a);
    let across = |(p, q): (DVec3, DVec3)| {
        let edge = q - p;
        p - edge * (p.dot(edge) / edge.dot(edge))
    };
    separates(normal)
        || separates(-normal)
        || [(a, b), (b, c), (c, a)]
            .map(across)
            .into_iter()
            .any(separates)
        || corners.into_iter().any(separates)
}
