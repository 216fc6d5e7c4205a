//! Closed meshes for tests: cubes and tori.

use super::nearest::Triangle;
use glam::{DVec2, DVec3};

/// Returns a cube of edge length `2 half` about the origin, with outward normals. Each face is cut into `n × n` squares
/// of two triangles.
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
                    out.extend(if sign > 0.0 {
                        [[a, b, c], [a, c, d]]
                    } else {
                        [[a, c, b], [a, d, c]]
                    });
                }
            }
        }
    }
    out
}

/// Returns a torus about the z axis with radii 1 and 0.3, of `2 n m` triangles with outward normals.
pub(crate) fn torus(n: usize, m: usize) -> Vec<Triangle> {
    let at = |i: usize, j: usize| {
        let (around, about) = (turn(i, n), turn(j, m));
        let out = 1.0 + 0.3 * about.x;
        DVec3::new(out * around.x, out * around.y, 0.3 * about.y)
    };
    let square = |i: usize, j: usize| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    let squares = (0..n).flat_map(|i| (0..m).map(move |j| (i, j)));
    squares.flat_map(|(i, j)| square(i, j)).collect()
}

/// Returns the `k`th of `n` equally spaced points on the unit circle.
fn turn(k: usize, n: usize) -> DVec2 {
    DVec2::from_angle(std::f64::consts::TAU * (k % n) as f64 / n as f64)
}

/// Returns the triangles with reversed orientation, so that normals point inward.
pub(crate) fn reversed_triangles(triangles: &[Triangle]) -> Vec<Triangle> {
    triangles.iter().map(|&[a, b, c]| [a, c, b]).collect()
}

pub(crate) fn translated_triangles(triangles: &[Triangle], by: DVec3) -> Vec<Triangle> {
    triangles.iter().map(|t| t.map(|p| p + by)).collect()
}
