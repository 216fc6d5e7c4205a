//! Describes a body's surface around one of its points by vectors to nearby corners.

use super::Body;
use super::facets::fan_triangles;
use super::piece::Piece;
use super::tree::point_query::{is_triangle_certainly_farther, pieces_near};
use glam::DVec3;

impl Body {
    /// Calls `add` with vectors from a surface point to points of the body around it, in the body's frame. They lead to
    /// the corners of all faces nearer than about `reach`, to the points of pieces without known faces, and into the
    /// solid.
    ///
    /// # Complexity
    /// Linear in the number of faces of the pieces within that distance.
    pub(crate) fn visit_nearby_point_offsets(
        &self,
        at: DVec3,
        reach: f64,
        mut add: impl FnMut(DVec3),
    ) {
        for k in pieces_near(self.tree(), at, reach) {
            let piece = self.pieces().get(k as usize);
            let mut is_near = false;
            for_each_face_or_facet(&piece, |face| {
                let near = match *face {
                    [a] => !is_triangle_certainly_farther([a; 3], at, reach),
                    [a, b] => !is_triangle_certainly_farther([a, b, b], at, reach),
                    [a, b, c] => !is_triangle_certainly_farther([a, b, c], at, reach),
                    // The box of the piece is near.
                    _ => true,
                };
                if near {
                    is_near = true;
                    face.iter().for_each(|&corner| add(corner - at));
                }
            });
            if let Some(inside) = self.interior_point(k).filter(|_| is_near) {
                add(inside - at);
            }
        }
    }
}

/// Calls `look` with the corners of each mesh triangle on a piece. If there are none, calls it with the triangles of
/// the piece's facets, or with all points at once if no facets are known.
fn for_each_face_or_facet(piece: &Piece<'_>, mut look: impl FnMut(&[DVec3])) {
    let mut is_on_mesh = false;
    for (_, triangle) in piece.mesh_triangles() {
        is_on_mesh = true;
        look(&triangle);
    }
    if is_on_mesh {
        return;
    }
    for corners in piece.facets.iter() {
        for fan in fan_triangles(corners) {
            look(&fan.map(|v| piece.points[v as usize]));
        }
    }
    if piece.facets.is_empty() {
        look(piece.points);
    }
}
