//! Finds common points of two triangles, where an edge of one passes through the other.

use super::nearest::{Corners, NearestPoints, point_at_weights};
use ccd_core::glam::DVec3;
use ccd_core::order::lesser;

/// Returns the pair of points with the least distance among `near` and the six points where an edge's line meets the
/// other triangle's plane.
///
/// Two non-coplanar triangles that intersect share a segment, which ends where an edge of one meets the other.
/// Triangles in one plane have crossing edges or a corner inside, which `near` covers. Clamping to edge and face
/// replaces an inside test.
pub(crate) fn nearest_with_edge_plane_intersections(
    p: &Corners,
    q: &Corners,
    near: NearestPoints,
) -> NearestPoints {
    let through_p = edge_plane_intersections(q, p).map(|(b, a)| NearestPoints { a, b });
    let through_q = edge_plane_intersections(p, q).map(|(a, b)| NearestPoints { a, b });
    let square = |n: &NearestPoints| n.separation_vector(p, q).length_squared();
    through_p
        .into_iter()
        .chain(through_q)
        .fold(near, |best, it| {
            if square(&it) < square(&best) {
                it
            } else {
                best
            }
        })
}

/// Intersects the edges of the triangle `of` with the plane of `face`, clamped to the edges and to the face. Returns
/// the weights of both triangles' corners for each intersection.
fn edge_plane_intersections(of: &Corners, face: &Corners) -> [([f64; 3], [f64; 3]); 3] {
    let (e, f) = (face[1] - face[0], face[2] - face[0]);
    let n = e.cross(f);
    let heights = of.map(|x| n.dot(x - face[0]));
    std::array::from_fn(|k| {
        let (start, end) = (k, (k + 1) % 3);
        let rise = heights[end] - heights[start];
        let t = match -heights[start] / rise {
            t if t > 0.0 => lesser(1.0, t),
            _ => 0.0,
        };
        let mut edge = [0.0; 3];
        edge[start] = 1.0 - t;
        edge[end] = t;
        (
            edge,
            projected_weights(e, f, n, point_at_weights(of, edge) - face[0]),
        )
    })
}

/// Returns the barycentric coordinates of the projection of `x` onto a face, clamped to the face.
fn projected_weights(e: DVec3, f: DVec3, n: DVec3, x: DVec3) -> [f64; 3] {
    let per = n.length_squared().recip();
    let part = |weight: f64| match weight {
        weight if weight > 0.0 => lesser(1.0, weight),
        _ => 0.0,
    };
    let v = part(per * x.dot(f.cross(n)));
    let w = lesser(part(per * x.dot(n.cross(e))), 1.0 - v);
    [1.0 - v - w, v, w]
}
