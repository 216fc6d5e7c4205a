//! The principal axes of points: their directions of largest and smallest spread.

use crate::rounding::SQUARED_LENGTH_RANGE;
use crate::tuning::MIN_JACOBI_ANGLE;
use glam::{DMat3, DVec3};

/// Returns the eigenvectors of the weighted points' covariance, by Jacobi rotations.
pub(crate) fn principal_axes<I: Iterator<Item = (DVec3, f64)>>(points: impl Fn() -> I) -> DMat3 {
    let (sum, total) = points().fold((DVec3::ZERO, 0.0), |(s, w), (p, weight)| {
        (s + p * weight, w + weight)
    });
    let mean = sum / total;
    let mut m = [[0.0f64; 3]; 3];
    for (p, weight) in points() {
        let d = p - mean;
        let of = d * weight;
        m[0][0] += of.x * d.x;
        m[0][1] += of.x * d.y;
        m[0][2] += of.x * d.z;
        m[1][1] += of.y * d.y;
        m[1][2] += of.y * d.z;
        m[2][2] += of.z * d.z;
    }
    (m[1][0], m[2][0], m[2][1]) = (m[0][1], m[0][2], m[1][2]);
    let mut axes = DMat3::IDENTITY;
    for sweep in 0..12 {
        let (i, j) = [(0, 1), (0, 2), (1, 2)][sweep % 3];
        // A rotation by a smaller angle does not change a box noticeably.
        if !(m[i][j].abs() > MIN_JACOBI_ANGLE * (m[j][j] - m[i][i]).abs()) {
            continue;
        }
        let (s, c) = sin_cos_of_half_angle(2.0 * m[i][j], m[j][j] - m[i][i]);
        apply_jacobi_rotation(&mut m, i, j, s, c);
        let (x, y) = (axes.col(i), axes.col(j));
        *axes.col_mut(i) = x * c - y * s;
        *axes.col_mut(j) = x * s + y * c;
    }
    axes
}

/// Returns the sine and cosine of half the angle of the vector (x, y), from −π/2 to π/2.
fn sin_cos_of_half_angle(y: f64, x: f64) -> (f64, f64) {
    let square = x * x + y * y;
    // Squares of small numbers have lost their digits.
    if !SQUARED_LENGTH_RANGE.contains(&square) {
        return (0.5 * y.atan2(x)).sin_cos();
    }
    let length = square.sqrt();
    // The larger of the two is the root of a sum without cancellation.
    let larger = (0.5 + 0.5 * x.abs() / length).sqrt();
    let smaller = 0.5 * y.abs() / (length * larger);
    let (sine, cosine) = if x > 0.0 {
        (smaller, larger)
    } else {
        (larger, smaller)
    };
    (sine.copysign(y), cosine)
}

/// Applies the Jacobi rotation by (s, c) in the plane of `i` and `j`: `m ← Jᵀ m J`.
fn apply_jacobi_rotation(m: &mut [[f64; 3]; 3], i: usize, j: usize, s: f64, c: f64) {
    for row in m.iter_mut() {
        let (x, y) = (row[i], row[j]);
        (row[i], row[j]) = (c * x - s * y, s * x + c * y);
    }
    let (row_i, row_j) = (m[i], m[j]);
    m[i] = [0, 1, 2].map(|k| c * row_i[k] - s * row_j[k]);
    m[j] = [0, 1, 2].map(|k| s * row_i[k] + c * row_j[k]);
}

#[cfg(test)]
mod tests;
