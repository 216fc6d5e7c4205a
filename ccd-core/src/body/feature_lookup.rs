//! Finds the mesh's vertex, edge or face that contains a point of a polytope.

use super::adjacency::AdjacencyLists;
use super::facets::edges_of;
use super::feature::Feature;
use super::piece::{ConvexCombination, Piece};
use super::polytope::FacetOrigin;
use crate::math::order::greater;
use crate::math::vector::{normal, unit};
use crate::tuning::{MAX_SCANNED_POINTS, POINT_ON_FACET_TOLERANCE};
use glam::DVec3;

/// Finds the mesh's vertex, edge or face that contains a point, given as a combination of a piece's corners.
///
/// Even if no facet of the mesh contains all of the corners, the point may be on the mesh: a
/// virtual facet may be within the surface, and so may a chord of two coplanar faces.
///
/// `vertex_id` returns the number of a corner in the mesh.
pub(crate) fn find_mesh_feature(
    piece: &Piece<'_>,
    point: &ConvexCombination,
    vertex_id: impl Fn(u32) -> u32,
) -> Option<Feature> {
    let (facets, support) = (piece.facets, point.point_indices());
    if !facets.is_empty() && !has_mesh_faces(piece) {
        return None;
    }
    if let [v] = *support {
        return Some(Feature::Vertex(vertex_id(v)));
    }
    let by_corner = FacetsByCorner::cached_if_many_facets(piece).zip(support.first());
    let near = by_corner.map(|(by_corner, &corner)| by_corner.facets.list(corner as usize));
    let count = near.map_or(facets.len(), <[u32]>::len);
    let facet = |k: usize| near.map_or(k, |near| near[k] as usize);
    let whole = (0..count)
        .map(facet)
        .filter_map(|k| match facets.origins_in_mesh()[k] {
            FacetOrigin::Face(id) => Some((id, facets.get(k))),
            FacetOrigin::Faces | FacetOrigin::Virtual => None,
        });
    if let [v, w] = *support {
        let joins =
            |corners: &[u32]| edges_of(corners).any(|ends| ends == (v, w) || ends == (w, v));
        if facets.is_empty() || whole.clone().any(|(_, corners)| joins(corners)) {
            return Some(Feature::edge(vertex_id(v), vertex_id(w)));
        }
    }
    let mut holding = whole.filter(|(_, corners)| support.iter().all(|v| corners.contains(v)));
    let face = match holding.next() {
        Some((face, _)) => Some(face),
        None => point
            .position(piece.points)
            .and_then(|at| face_at(piece, at)),
    };
    face.map(Feature::Face)
}

/// Returns whether any face of the mesh is on the piece.
fn has_mesh_faces(piece: &Piece<'_>) -> bool {
    match FacetsByCorner::cached_if_many_facets(piece) {
        Some(by_corner) => by_corner.has_mesh_faces,
        None => piece.mesh_triangles().next().is_some(),
    }
}

/// A table of the facets that meet in each corner of a piece.
struct FacetsByCorner {
    has_mesh_faces: bool,
    /// The facets of each corner, in ascending order.
    facets: AdjacencyLists<u32>,
}

impl FacetsByCorner {
    /// Returns the table of a piece with many facets, which is created at the first call and cached. Returns `None` for
    /// a piece with few facets, or a piece that belongs to no list.
    fn cached_if_many_facets<'a>(piece: &Piece<'a>) -> Option<&'a FacetsByCorner> {
        let many = piece.facets.len() > MAX_SCANNED_POINTS;
        let kept =
            many.then(|| piece.cached_value(|piece| Box::new(FacetsByCorner::new(piece))))?;
        kept.map(|kept| &**kept)
    }

    fn new(piece: &Piece<'_>) -> Self {
        let facets = (0..).zip(piece.facets.iter());
        let pairs = facets.flat_map(|(facet, corners)| corners.iter().map(move |&v| (v, facet)));
        FacetsByCorner {
            has_mesh_faces: piece.mesh_triangles().next().is_some(),
            facets: AdjacencyLists::new(piece.points.len(), pairs),
        }
    }
}

/// Builds the table of facets by corner for a piece in advance, so that no query waits for it.
pub(crate) fn prepare_facets_by_corner(piece: &Piece<'_>) {
    FacetsByCorner::cached_if_many_facets(piece);
}

/// Returns the number of the piece's mesh face on which a point lies, up to rounding; `None` if it is on none.
pub(crate) fn face_at(piece: &Piece<'_>, point: DVec3) -> Option<u32> {
    if !has_mesh_faces(piece) {
        return None;
    }
    let way = |p: &DVec3| p.distance(point);
    let reach = POINT_ON_FACET_TOLERANCE * piece.points.iter().map(way).fold(0.0, greater);
    let near = |[a, b, c]: [DVec3; 3]| {
        let (lo, hi) = (a.min(b).min(c) - reach, a.max(b).max(c) + reach);
        lo.cmple(point).all() && point.cmple(hi).all()
    };
    let off = piece
        .mesh_triangles()
        .filter(|&(_, triangle)| near(triangle))
        .map(|(id, triangle)| (distance_bound_from_triangle(triangle, point), id));
    let (off, face) = off.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (off <= reach).then_some(face)
}

/// Returns the larger of a point's distance from a triangle's plane and its distances beyond the triangle's edges.
fn distance_bound_from_triangle([a, b, c]: [DVec3; 3], point: DVec3) -> f64 {
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

#[cfg(test)]
mod tests;
