//! The directions of the largest and smallest spread of points.

use glam::{DMat3, DVec3};

/// Returns the eigenvectors of the weighted points' covariance, by Jacobi rotations.
pub(crate) fn principal_axes<I: Iterator<Item = (DVec3, f64)>>(points: impl Fn() -> I) -> DMat3 {
    let (sum, total) = points().fold((DVec3::ZERO, 0.0), |(s, w), (p, weight)| {
        (s + p * weight, w + weight)
    });
    let mean = sum / total;
    let mut m = [[0.0f64; 3]; 3];
    for (p, weight) in points() {
        let d = (p - mean).to_array();
        for i in 0..3 {
            for j in 0..3 {
                m[i][j] += weight * d[i] * d[j];
            }
        }
    }
    let mut axes = DMat3::IDENTITY;
    for sweep in 0..12 {
        let (i, j) = [(0, 1), (0, 2), (1, 2)][sweep % 3];
        if !(m[i][j].abs() > 0.0) {
            continue;
        }
        let theta = 0.5 * (2.0 * m[i][j]).atan2(m[j][j] - m[i][i]);
        let (s, c) = theta.sin_cos();
        rotate(&mut m, i, j, s, c);
        let (x, y) = (axes.col(i), axes.col(j));
        *axes.col_mut(i) = x * c - y * s;
        *axes.col_mut(j) = x * s + y * c;
    }
    axes
}

/// Computes `m ← Jᵀ m J` for the rotation by (s, c) in the plane of `i` and `j`.
fn rotate(m: &mut [[f64; 3]; 3], i: usize, j: usize, s: f64, c: f64) {
    for row in m.iter_mut() {
        let (x, y) = (row[i], row[j]);
        (row[i], row[j]) = (c * x - s * y, s * x + c * y);
    }
    let (row_i, row_j) = (m[i], m[j]);
    m[i] = [0, 1, 2].map(|k| c * row_i[k] - s * row_j[k]);
    m[j] = [0, 1, 2].map(|k| s * row_i[k] + c * row_j[k]);
}
