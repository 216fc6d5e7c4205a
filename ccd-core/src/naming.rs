//! Which feature of a mesh a point of a polytope lies on.

use crate::oracle::Combination;
use crate::order::greater;
use crate::piece::{Origin, Piece};
use crate::tolerance::ON_FACET;
use crate::vector::{normal, unit};
use glam::DVec3;

/// What a point of a polytope is, by the polytope's corners and the mesh's faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Name {
    Vertex(u32),
    Edge(u32, u32),
    Face(u32),
    Nothing,
}

/// Names a combination of corners.
///
/// Corners that no facet of the mesh holds together may still name a point on the mesh: a virtual
/// facet may lie within the surface, and so may a chord of two coplanar faces.
pub(crate) fn of_polytope(piece: &Piece<'_>, point: &Combination) -> Name {
    let (facets, support) = (piece.facets, point.support());
    if !facets.is_empty() && piece.mesh_triangles().next().is_none() {
        return Name::Nothing;
    }
    if let [v] = *support {
        return Name::Vertex(v);
    }
    let faces = facets.origins().iter().zip(facets.iter());
    let whole = faces.clone().filter_map(|(origin, corners)| match origin {
        Origin::Face(id) => Some((*id, corners)),
        Origin::Faces | Origin::Virtual => None,
    });
    if let [v, w] = *support {
        let joins = |corners: &[u32]| {
            let mut ends =
                (0..corners.len()).map(|k| (corners[k], corners[(k + 1) % corners.len()]));
            ends.any(|ends| ends == (v, w) || ends == (w, v))
        };
        if faces.len() == 0 || whole.clone().any(|(_, corners)| joins(corners)) {
            return Name::Edge(v, w);
        }
    }
    let mut holding = whole.filter(|(_, corners)| support.iter().all(|v| corners.contains(v)));
    match holding.next() {
        Some((face, _)) => Name::Face(face),
        None => point
            .of(piece.points)
            .and_then(|at| face_under(piece, at))
            .map_or(Name::Nothing, Name::Face),
    }
}

/// The face of the mesh that a point lies on, but for rounding.
pub(crate) fn face_under(piece: &Piece<'_>, point: DVec3) -> Option<u32> {
    let way = |p: &DVec3| p.distance(point);
    let reach = ON_FACET * piece.points.iter().map(way).fold(0.0, greater);
    let near = |[a, b, c]: [DVec3; 3]| {
        let (lo, hi) = (a.min(b).min(c) - reach, a.max(b).max(c) + reach);
        lo.cmple(point).all() && point.cmple(hi).all()
    };
    let off = piece
        .mesh_triangles()
        .filter(|&(_, triangle)| near(triangle))
        .map(|(id, triangle)| (distance_off(triangle, point), id));
    let (off, face) = off.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (off <= reach).then_some(face)
}

/// How far a point is off a triangle's plane, or beyond one of its edges, whichever is more.
fn distance_off([a, b, c]: [DVec3; 3], point: DVec3) -> f64 {
    let Some(normal) = normal([a, b, c]) else {
        return f64::INFINITY;
    };
    let beyond = |from: DVec3, to: DVec3| {
        let outward = unit((to - from).cross(normal)).unwrap_or(DVec3::ZERO);
        outward.dot(point - from)
    };
    let height = normal.dot(point - a).abs();
    greater(
        greater(greater(height, beyond(a, b)), beyond(b, c)),
        beyond(c, a),
    )
}
