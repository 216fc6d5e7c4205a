//! The point of a mesh that is nearest to a point.

use crate::tree::Tree;
use ccd_core::glam::{DVec3, DVec4};
use ccd_core::order::{greater, lesser};

/// A point of a mesh: a triangle by its place in the order of the tree, and the weights of its corners.
pub(crate) struct MeshPoint {
    pub(crate) place: usize,
    pub(crate) weights: [f64; 3],
    /// The point, and the radius of the ball around it.
    pub(crate) ball: DVec4,
    /// The distance from the rounded triangle.
    pub(crate) distance: f64,
}

impl MeshPoint {
    /// Returns the point of a mesh that is nearest to a point of its frame: of the nearest points of all triangles, as if they were
    /// flat, the one whose ball is nearest.
    pub(crate) fn nearest(tree: &Tree, point: DVec3) -> MeshPoint {
        let triangles = tree.triangles.iter().enumerate();
        let points = triangles.map(|(place, triangle)| {
            let weights = nearest_weights(triangle.map(DVec4::truncate), point);
            let ball = (0..3).map(|k| triangle[k] * weights[k]).sum::<DVec4>();
            MeshPoint {
                place,
                weights,
                ball,
                distance: greater(ball.truncate().distance(point) - ball.w, 0.0),
            }
        });
        let nearest = points.min_by(|a, b| a.distance.total_cmp(&b.distance));
        nearest.unwrap_or(MeshPoint {
            place: 0,
            weights: [1.0, 0.0, 0.0],
            ball: DVec4::NAN,
            distance: f64::INFINITY,
        })
    }
}

/// Returns the weights of the corners of the point of a triangle that is nearest to a point: that below it, if it is inside, or
/// the nearest one of an edge. So a triangle may be a segment or a point.
fn nearest_weights(corners: [DVec3; 3], p: DVec3) -> [f64; 3] {
    let distance = |weights: &[f64; 3]| {
        let point = (0..3).map(|k| corners[k] * weights[k]).sum::<DVec3>();
        point.distance_squared(p)
    };
    let on_edges = [(0, 1), (1, 2), (2, 0)].map(|(from, to)| {
        let edge = corners[to] - corners[from];
        let share = edge.dot(p - corners[from]) / edge.length_squared();
        let share = if share > 0.0 { lesser(share, 1.0) } else { 0.0 };
        let mut weights = [0.0; 3];
        (weights[from], weights[to]) = (1.0 - share, share);
        weights
    });
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a);
    let share = |u: DVec3, v: DVec3| normal.dot((u - p).cross(v - p)) / normal.length_squared();
    let (v, w) = (share(c, a), share(a, b));
    let inside = [1.0 - v - w, v, w];
    let is_inside = inside.iter().all(|&weight| weight >= 0.0);
    let nearest = on_edges.into_iter().chain(is_inside.then_some(inside));
    let nearest = nearest.min_by(|a, b| distance(a).total_cmp(&distance(b)));
    nearest.unwrap_or([1.0, 0.0, 0.0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_triangles_segments_and_points_are_the_nearest() {
        let [x, y] = [DVec3::X, DVec3::Y];
        for (corners, point, expected) in [
            (
                [DVec3::ZERO, x, y],
                DVec3::new(0.2, 0.3, 5.0),
                [0.5, 0.2, 0.3],
            ),
            (
                [DVec3::ZERO, x, y],
                DVec3::new(0.5, -2.0, 1.0),
                [0.5, 0.5, 0.0],
            ),
            (
                [DVec3::ZERO, x, y],
                DVec3::new(3.0, -1.0, 0.0),
                [0.0, 1.0, 0.0],
            ),
            ([-x, x, x], DVec3::new(0.0, 2.0, 0.0), [0.5, 0.5, 0.0]),
            ([x, x, -x], DVec3::new(-3.0, 2.0, 0.0), [0.0, 0.0, 1.0]),
        ] {
            let found = nearest_weights(corners, point);
            let off = (0..3).map(|k| (found[k] - expected[k]).abs()).sum::<f64>();
            assert!(off < 1e-12, "{corners:?} {point}: {found:?}");
        }
        let of_a_point = nearest_weights([x; 3], y);
        assert!((of_a_point.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }
}
