//! Finds common points of two polytopes, and proves them by exact signs `[SHE97]`.

use crate::double_double::six_times_signed_volume;
use crate::feature::{CommonPoint, WeightedCorners};
use crate::placed::PlacedPolytope;
use crate::tolerance::MAX_EDGE_FACE_PAIRS;
use ccd_core::exact::side_of_plane;
use ccd_core::glam::DVec3;

/// Returns the point at which an edge passes through a face, or ends on it.
///
/// # Guarantee
/// Signs are exact for the placed points, which are rounded. A crossing is returned only if the edge and one of the
/// triangles spanned by the face's corners do have a common point.
pub(crate) fn edge_face_crossing<X: PlacedPolytope, Y: PlacedPolytope>(
    x: &X,
    e: u32,
    y: &Y,
    f: u32,
) -> Option<CommonPoint> {
    let ends = x.shape().edge(e).ends;
    let edge = ends.map(|v| x.vertex(v));
    let sides = y.shape().sides_of(f);
    for k in 1..sides.len().saturating_sub(1) {
        let corners = [0, k, k + 1].map(|k| sides[k].vertex);
        let triangle = corners.map(|w| y.vertex(w));
        if segment_crosses_triangle(edge, triangle) {
            let (along, inside) = weights(edge, triangle);
            return Some(CommonPoint {
                edge_ends: WeightedCorners {
                    vertices: ends,
                    weights: along,
                },
                face_corners: WeightedCorners {
                    vertices: [corners[0], corners[1], corners[2], corners[2]],
                    weights: [inside[0], inside[1], inside[2], 0.0],
                },
                face: f,
            });
        }
    }
    None
}

/// Returns corner `v` of X as a common point if it is inside Y; the weights are those of a tetrahedron in Y around it.
///
/// # Guarantee
/// Like [`edge_face_crossing`].
pub(crate) fn contained_corner_crossing<X: PlacedPolytope, Y: PlacedPolytope>(
    x: &X,
    v: u32,
    y: &Y,
) -> Option<CommonPoint> {
    let point = x.vertex(v);
    let shape = y.shape();
    if shape.faces.len() < 3 {
        return None;
    }
    let apex = y.vertex(0);
    for f in 0..shape.faces.len() as u32 {
        let sides = shape.sides_of(f);
        if sides.iter().any(|side| side.vertex == 0) {
            continue;
        }
        for k in 1..sides.len() - 1 {
            let corners = [0, k, k + 1].map(|k| sides[k].vertex);
            let triangle = corners.map(|w| y.vertex(w));
            if let Some(inside) = barycentric_coordinates(point, apex, triangle) {
                return Some(CommonPoint {
                    edge_ends: WeightedCorners {
                        vertices: [v, v],
                        weights: [1.0, 0.0],
                    },
                    face_corners: WeightedCorners {
                        vertices: [corners[0], corners[1], corners[2], 0],
                        weights: inside,
                    },
                    face: f,
                });
            }
        }
    }
    None
}

/// Searches for an edge of X that passes through a face of Y, or a corner of X inside Y, unless the polytopes are too
/// large.
pub(crate) fn find_edge_face_crossing<X: PlacedPolytope, Y: PlacedPolytope>(
    x: &X,
    y: &Y,
) -> Option<CommonPoint> {
    let (edges, faces) = (x.shape().edges.len() as u32, y.shape().faces.len() as u32);
    if edges as usize * faces as usize > MAX_EDGE_FACE_PAIRS {
        return None;
    }
    let through = (0..faces).find_map(|f| (0..edges).find_map(|e| edge_face_crossing(x, e, y, f)));
    // If no edge goes through the surface, X is either entirely inside or entirely outside.
    through.or_else(|| contained_corner_crossing(x, 0, y))
}

/// Returns whether a segment and a triangle have a common point; false if they are coplanar.
fn segment_crosses_triangle([start, end]: [DVec3; 2], triangle: [DVec3; 3]) -> bool {
    let (first, last) = (side_of_plane(triangle, start), side_of_plane(triangle, end));
    let beside = first == last && first.is_ne();
    if beside || (first.is_eq() && last.is_eq()) {
        return false;
    }
    let [a, b, c] = triangle;
    let turns = [[a, b], [b, c], [c, a]].map(|[p, q]| side_of_plane([start, p, q], end));
    turns.iter().all(|&turn| turn.is_ge()) || turns.iter().all(|&turn| turn.is_le())
}

/// Returns the weights of a segment's ends, and of a triangle's corners, for the point in which the two intersect.
fn weights([start, end]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> ([f64; 2], [f64; 3]) {
    let (first, last) = (
        six_times_signed_volume([a, b, c], start).abs(),
        six_times_signed_volume([a, b, c], end).abs(),
    );
    let parts =
        [[b, c], [c, a], [a, b]].map(|[p, q]| six_times_signed_volume([start, p, q], end).abs());
    let total = parts[0] + parts[1] + parts[2];
    (
        [last / (first + last), first / (first + last)],
        parts.map(|part| part / total),
    )
}

/// Returns the barycentric coordinates of `point` in the tetrahedron `(a, b, c, apex)`; `None` if it is outside.
fn barycentric_coordinates(point: DVec3, apex: DVec3, [a, b, c]: [DVec3; 3]) -> Option<[f64; 4]> {
    // Every face of the tetrahedron, seen from outside.
    let faces = [[apex, c, b], [apex, a, c], [apex, b, a], [a, b, c]];
    let behind = faces.iter().all(|face| side_of_plane(*face, point).is_le());
    let solid = side_of_plane([a, b, c], apex).is_lt();
    if !(behind && solid) {
        return None;
    }
    let parts = faces.map(|face| six_times_signed_volume(face, point).abs());
    let total = parts.iter().sum::<f64>();
    Some(parts.map(|part| part / total))
}

#[cfg(test)]
mod tests;
