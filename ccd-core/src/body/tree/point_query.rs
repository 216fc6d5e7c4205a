//! Finds the pieces whose boxes contain a point or are near it, and tests whether the surface is far from it.

use super::waiting::NodeStack;
use super::{Node, NodeChildren, Tree};
use crate::body::pieces::Pieces;
use crate::rounding::DETERMINANT_ERROR_F64;
use glam::DVec3;
use std::ops::Range;

/// Returns the pieces whose boxes contain a point up to rounding, without pieces that are triangles.
pub(crate) fn polytopes_with_box_at(tree: &Tree, point: DVec3) -> impl Iterator<Item = u32> {
    leaves_near(tree, point, 0.0).filter_map(|leaf| match leaf {
        Leaf::Piece(piece) => Some(piece),
        Leaf::Triangles(_) => None,
    })
}

/// Returns the pieces whose boxes are within about `reach` of a point. Of a group of triangles with a common box, all
/// are returned.
pub(crate) fn pieces_near(tree: &Tree, point: DVec3, reach: f64) -> impl Iterator<Item = u32> {
    leaves_near(tree, point, reach).flat_map(|leaf| match leaf {
        Leaf::Piece(piece) => piece..piece + 1,
        Leaf::Triangles(triangles) => triangles,
    })
}

/// Returns whether a point is certainly farther than `reach` from all triangles of the body's surface.
pub(crate) fn is_far_from_surface(tree: &Tree, pieces: &Pieces, point: DVec3, reach: f64) -> bool {
    let is_far = |triangle| is_triangle_certainly_farther(triangle, point, reach);
    leaves_near(tree, point, reach).all(|leaf| leaf.all_triangles_satisfy(pieces, is_far))
}

/// A leaf of the tree that a search finds: one piece, or several triangles with a common box.
pub(super) enum Leaf {
    Piece(u32),
    /// Several triangles, by the indices of their pieces.
    Triangles(Range<u32>),
}

impl Leaf {
    /// Returns whether a test holds for all triangles of the body's surface on the leaf's pieces.
    pub(super) fn all_triangles_satisfy(
        self,
        pieces: &Pieces,
        mut test: impl FnMut([DVec3; 3]) -> bool,
    ) -> bool {
        match self {
            Leaf::Triangles(mut triangles) => {
                triangles.all(|piece| test(pieces.triangle(piece as usize)))
            }
            Leaf::Piece(piece) => {
                let piece = pieces.get(piece as usize);
                piece.mesh_triangles().all(|(_, triangle)| test(triangle))
            }
        }
    }
}

/// Returns the leaves whose boxes are within about `reach` of a point.
fn leaves_near(tree: &Tree, point: DVec3, reach: f64) -> impl Iterator<Item = Leaf> {
    leaves_in_region(tree, move |node| node.is_near(point, reach))
}

/// Returns the leaves that a search meets which looks only below nodes in a region.
pub(super) fn leaves_in_region(
    tree: &Tree,
    meets_region: impl Fn(&Node) -> bool,
) -> impl Iterator<Item = Leaf> {
    let mut stack = NodeStack::with_root();
    std::iter::from_fn(move || {
        while let Some(id) = stack.pop() {
            let node = &tree.nodes[id as usize];
            if !meets_region(node) {
                continue;
            }
            match node.children {
                NodeChildren::Boxes(group) => stack.extend(tree.box_group(group).header.children()),
                NodeChildren::Piece(piece) => return Some(Leaf::Piece(piece)),
                NodeChildren::Triangles(group) => {
                    let Range { start, end } = tree.triangle_group_header(group).children();
                    let nodes = tree.nodes.len() as u32;
                    return Some(Leaf::Triangles(start - nodes..end - nodes));
                }
            }
        }
        None
    })
}

/// Returns whether a tested axis proves that a point is farther than `reach` from a triangle. It tries the normal of
/// the plane, and the directions from the edges and corners.
pub(crate) fn is_triangle_certainly_farther(
    triangle: [DVec3; 3],
    point: DVec3,
    reach: f64,
) -> bool {
    let corners = triangle.map(|corner| corner - point);
    let size = |v: DVec3| v.abs().element_sum();
    let separates = |axis: DVec3| {
        let beyond =
            |p: &DVec3| axis.dot(*p) > (reach + DETERMINANT_ERROR_F64 * size(*p)) * size(axis);
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
