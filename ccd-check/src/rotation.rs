//! Rotations: exponentials of rotation vectors, enclosed.

use crate::number::{Ball, FRACTION_BITS, ONE, Sign, Vector, add, add_signed, cross, dot, scale};

/// A rotation as a quaternion of unit length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rotation {
    scalar: Ball,
    vector: Vector,
}

impl Rotation {
    /// Returns the rotation by a vector: about its direction, by its length in radians.
    pub(crate) fn by(turn: Vector) -> Rotation {
        let half = turn.map(|x| x.div(2));
        let (cos, sinc) = cos_and_sinc(dot(half, half, FRACTION_BITS));
        Rotation {
            scalar: cos,
            vector: scale(half, sinc, FRACTION_BITS),
        }
    }

    /// Turns a vector, or with [`Sign::Minus`] turns it back.
    pub(crate) fn turn(&self, v: Vector, sign: Sign) -> Vector {
        let once = cross(self.vector, v, FRACTION_BITS);
        let twice = cross(self.vector, once, FRACTION_BITS);
        let once = scale(once, self.scalar, FRACTION_BITS);
        let v = add(v, add(twice, twice));
        add_signed(v, add(once, once), sign)
    }
}

/// Returns cos x and sin x / x from x², both as fractions.
fn cos_and_sinc(mut square: Ball) -> (Ball, Ball) {
    let mut halvings = 0;
    while square.size() > ONE / 4 {
        square = square.div(4);
        halvings += 1;
    }
    // Taylor: what is left out is less than (1/4)¹⁰ / 20!, which is less than one unit.
    let (mut cos, mut sinc) = (Ball::exact(ONE), Ball::exact(ONE));
    for k in (1..10).rev() {
        let next = |series: Ball, divisor| {
            Ball::exact(ONE).sub(series.mul(square, FRACTION_BITS).div(divisor))
        };
        cos = next(cos, (2 * k - 1) * (2 * k));
        sinc = next(sinc, (2 * k) * (2 * k + 1));
    }
    (cos.rad, sinc.rad) = (cos.rad + 1, sinc.rad + 1);
    // cos 2x = 2 cos² x − 1, and sin 2x / 2x = cos x · sin x / x.
    for _ in 0..halvings {
        sinc = sinc.mul(cos, FRACTION_BITS);
        let square = cos.mul(cos, FRACTION_BITS);
        cos = square.add(square).sub(Ball::exact(ONE));
    }
    (cos, sinc)
}
