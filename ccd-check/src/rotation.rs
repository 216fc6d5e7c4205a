//! Rotations of quaternions and of rotation vectors, enclosed.

use crate::number::{AXES, FRACTION, Matrix, Number, ONE, Vector};

/// Returns the rotation of a quaternion, with 2 over the square of its length.
pub(crate) fn of_quaternion(scalar: Number, vector: Vector, factor: Number) -> Matrix {
    Matrix::of(AXES.map(|axis| {
        let axis = Vector::exact(axis);
        let once = vector.cross(axis);
        axis + (once.times(scalar, FRACTION) + vector.cross(once)).times(factor, FRACTION)
    }))
}

/// Returns the rotation by a vector: about its direction, by its length in radians.
pub(crate) fn by(turn: Vector) -> Matrix {
    let half = turn.over(2);
    let (mut part, mut halvings) = (half, 0);
    while part.size() > ONE.mid[0] {
        (part, halvings) = (part.over(2), halvings + 1);
    }
    let square = part.dot(part);
    // Taylor, for x ≤ 1: what is left out is at most 1 / 20!, which is less than one unit.
    let (mut cos, mut sinc) = (ONE, ONE);
    for k in (1..10).rev() {
        cos = ONE - cos.times(square, FRACTION).over((2 * k - 1) * (2 * k));
        sinc = ONE - sinc.times(square, FRACTION).over((2 * k) * (2 * k + 1));
    }
    (cos.rad, sinc.rad) = (cos.rad + 1, sinc.rad + 1);
    // cos 2x = 2 cos² x − 1, and sin 2x / 2x = cos x · sin x / x.
    for _ in 0..halvings {
        sinc = sinc.times(cos, FRACTION);
        let square = cos.times(cos, FRACTION);
        cos = square + square - ONE;
    }
    of_quaternion(cos, half.times(sinc, FRACTION), ONE + ONE)
}
