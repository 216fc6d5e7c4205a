//! Rotations: exponentials of rotation vectors, enclosed.

use crate::number::{AXES, FRACTION, Matrix, Number, ONE, Vector};

/// A rotation as a quaternion, with 2 over the square of its length.
pub(crate) struct Rotation {
    pub(crate) scalar: Number,
    pub(crate) vector: Vector,
    pub(crate) factor: Number,
}

impl Rotation {
    /// Returns the rotation by a vector: about its direction, by its length in radians.
    pub(crate) fn by(turn: Vector) -> Rotation {
        let half = turn.over(2);
        let (mut part, mut halvings) = (half, 0);
        while part.size() > ONE.mid[0] / 4 {
            (part, halvings) = (part.over(2), halvings + 1);
        }
        let square = part.dot(part);
        // Taylor, for x ≤ 1/4: what is left out is less than (1/16)¹⁰ / 20!, which is less than one unit.
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
        Rotation {
            scalar: cos,
            vector: half.times(sinc, FRACTION),
            factor: ONE + ONE,
        }
    }

    pub(crate) fn matrix(&self) -> Matrix {
        Matrix::of(AXES.map(|axis| self.rotated(Vector::exact(axis))))
    }

    fn rotated(&self, v: Vector) -> Vector {
        let once = self.vector.cross(v);
        let sum = once.times(self.scalar, FRACTION) + self.vector.cross(once);
        v + sum.times(self.factor, FRACTION)
    }
}
