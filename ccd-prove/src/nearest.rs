//! The point of a mesh that is nearest to a point.

use crate::body::Body;
use ccd_core::glam::DVec3;

/// A point of a mesh: a triangle by its place in the order of the tree, and the weights of its corners.
pub(crate) struct MeshPoint {
    pub(crate) place: usize,
    pub(crate) weights: [f64; 3],
    pub(crate) distance: f64,
}

impl MeshPoint {
    /// Returns the point of a mesh that is nearest to a point of its frame.
    pub(crate) fn nearest(body: &Body, point: DVec3) -> MeshPoint {
        let triangles = body.triangles.iter().enumerate();
        let points = triangles.map(|(place, triangle)| {
            let weights = nearest_weights(*triangle, point);
            let on_mesh = (0..3).map(|k| triangle[k] * weights[k]).sum::<DVec3>();
            MeshPoint {
                place,
                weights,
                distance: on_mesh.distance(point),
            }
        });
        let nearest = points.min_by(|a, b| a.distance.total_cmp(&b.distance));
        nearest.unwrap_or(MeshPoint {
            place: 0,
            weights: [1.0, 0.0, 0.0],
            distance: f64::INFINITY,
        })
    }
}

/// Returns the weights of the corners of the point of a triangle that is nearest to a point `[ERICSON05 §5.1.5]`.
fn nearest_weights([a, b, c]: [DVec3; 3], p: DVec3) -> [f64; 3] {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let v = d1 / (d1 - d3);
        return [1.0 - v, v, 0.0];
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let w = d2 / (d2 - d6);
        return [1.0 - w, 0.0, w];
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return [0.0, 1.0 - w, w];
    }
    let total = va + vb + vc;
    let (v, w) = (vb / total, vc / total);
    [1.0 - v - w, v, w]
}
