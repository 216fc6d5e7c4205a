//! Closed meshes.

use super::nearest::Triangle;
use glam::DVec3;

/// A cube from −half to half, outward normals, each face cut into `n × n` squares.
pub(crate) fn cube(half: f64, n: usize) -> Vec<Triangle> {
    let mut out = Vec::new();
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let at = |i: usize, j: usize| {
                let mut p = DVec3::ZERO;
                let place = |k: usize| (2.0 * k as f64 / n as f64 - 1.0) * half;
                p[axis] = sign * half;
                p[(axis + 1) % 3] = place(i);
                p[(axis + 2) % 3] = place(j);
                p
            };
            for i in 0..n {
                for j in 0..n {
                    let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                    out.extend(match sign > 0.0 {
                        true => [[a, b, c], [a, c, d]],
                        false => [[a, c, b], [a, d, c]],
                    });
                }
            }
        }
    }
    out
}

/// The same surface with its normals the other way.
pub(crate) fn inside_out(triangles: &[Triangle]) -> Vec<Triangle> {
    triangles.iter().map(|&[a, b, c]| [a, c, b]).collect()
}

pub(crate) fn moved(triangles: &[Triangle], by: DVec3) -> Vec<Triangle> {
    triangles.iter().map(|t| t.map(|p| p + by)).collect()
}
