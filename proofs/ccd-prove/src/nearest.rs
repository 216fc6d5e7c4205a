//! Finds the nearest point of a mesh.

use crate::tree::Tree;
use ccd_core::glam::{DVec3, DVec4};
use ccd_core::order::{greater, lesser};

/// A point of a mesh.
pub(crate) struct MeshPoint {
    /// The index of its triangle in the order of the tree.
    pub(crate) triangle: usize,
    /// The barycentric weights of the corners of the triangle.
    pub(crate) weights: [f64; 3],
    /// The coordinates x, y, z, and the radius of the ball around the point.
    pub(crate) ball: DVec4,
    /// The distance of the ball from the query point.
    pub(crate) distance: f64,
}

impl MeshPoint {
    /// Finds a point of a mesh whose ball is near `point`, in the frame of the mesh. The candidates are the nearest points of all flat
    /// triangles. The function returns the candidate with the nearest ball.
    pub(crate) fn nearest(tree: &Tree, point: DVec3) -> MeshPoint {
        let triangles = tree.triangles.iter().enumerate();
        let points = triangles.map(|(triangle, corners)| {
            let weights = nearest_weights(corners.map(DVec4::truncate), point);
            let ball = (0..3).map(|k| corners[k] * weights[k]).sum::<DVec4>();
            MeshPoint {
                triangle,
                weights,
                ball,
                distance: greater(ball.truncate().distance(point) - ball.w, 0.0),
            }
        });
        let nearest = points.min_by(|a, b| a.distance.total_cmp(&b.distance));
        nearest.unwrap_or(MeshPoint {
            triangle: 0,
            weights: [1.0, 0.0, 0.0],
            ball: DVec4::NAN,
            distance: f64::INFINITY,
        })
    }
}

/// Returns the barycentric weights of the point of a triangle that is nearest to p. It is the projection of p if that is inside of the
/// triangle, or else the nearest point of an edge. The triangle may be a segment or a single point.
fn nearest_weights(corners: [DVec3; 3], p: DVec3) -> [f64; 3] {
    let distance_squared = |weights: &[f64; 3]| {
        let point = (0..3).map(|k| corners[k] * weights[k]).sum::<DVec3>();
        point.distance_squared(p)
    };
    let on_edges = [(0, 1), (1, 2), (2, 0)].map(|(from, to)| {
        let edge = corners[to] - corners[from];
        let fraction = edge.dot(p - corners[from]) / edge.length_squared();
        let fraction = if fraction > 0.0 {
            lesser(fraction, 1.0)
        } else {
            0.0
        };
        let mut weights = [0.0; 3];
        (weights[from], weights[to]) = (1.0 - fraction, fraction);
        weights
    });
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a);
    let weight = |u: DVec3, v: DVec3| normal.dot((u - p).cross(v - p)) / normal.length_squared();
    let (v, w) = (weight(c, a), weight(a, b));
    let inside = [1.0 - v - w, v, w];
    let is_inside = inside.iter().all(|&weight| weight >= 0.0);
    let nearest = on_edges.into_iter().chain(is_inside.then_some(inside));
    let nearest = nearest.min_by(|a, b| distance_squared(a).total_cmp(&distance_squared(b)));
    nearest.unwrap_or([1.0, 0.0, 0.0])
}

#[cfg(test)]
mod tests;
