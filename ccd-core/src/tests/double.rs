//! Double-double arithmetic, which gives the exact values for tests of rounding. A number is the unevaluated sum of two
//! f64, with a relative error of about 1e-31.
//!
//! A separate crate of tests could not provide it: that crate would depend on this one, which would be built twice.

use crate::math::order::greater;
use crate::motion::Motion;
use glam::{DQuat, DVec3};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number `high + low`, with `|low|` at most half a unit in the last place of `high`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    pub(crate) const ZERO: DoubleDouble = DoubleDouble {
        high: 0.0,
        low: 0.0,
    };

    pub(crate) fn get(self) -> f64 {
        self.high
    }

    pub(crate) fn min(self, other: DoubleDouble) -> DoubleDouble {
        if (other - self).high < 0.0 {
            other
        } else {
            self
        }
    }

    pub(crate) fn max(self, other: DoubleDouble) -> DoubleDouble {
        -(-self).min(-other)
    }

    pub(crate) fn sqrt(self) -> DoubleDouble {
        if self.high <= 0.0 {
            return DoubleDouble::ZERO;
        }
        // One Newton step doubles the digits of the f64 root.
        let root = DoubleDouble::from(self.high.sqrt());
        (root + self / root) * DoubleDouble::from(0.5)
    }

    /// Returns the angle whose sine is `self` and whose cosine is `cosine`, up to a common factor; both are at least 0.
    pub(crate) fn atan2(self, cosine: DoubleDouble) -> DoubleDouble {
        let angle = DoubleDouble::from(self.high.atan2(cosine.high));
        // One Newton step doubles the digits of the f64 angle.
        let (sin, cos) = angle.sin_cos();
        angle + (self * cos - cosine * sin) / (self * sin + cosine * cos)
    }

    /// Returns the sine and the cosine of the angle, by Taylor series for a small fraction of the angle and repeated
    /// doubling.
    pub(crate) fn sin_cos(self) -> (DoubleDouble, DoubleDouble) {
        let mut halvings = 0;
        let mut angle = self;
        while angle.high.abs() > 0.125 {
            angle = angle * DoubleDouble::from(0.5);
            halvings += 1;
        }
        let square = angle * angle;
        let (mut sin, mut cos_minus_one) = (angle, DoubleDouble::ZERO);
        let (mut odd, mut even) = (angle, DoubleDouble::from(1.0));
        for k in 1..14 {
            let n = f64::from(2 * k);
            even = -(even * square) / DoubleDouble::from((n - 1.0) * n);
            odd = -(odd * square) / DoubleDouble::from(n * (n + 1.0));
            cos_minus_one = cos_minus_one + even;
            sin = sin + odd;
        }
        // The value cos − 1 is doubled, which does not cancel while the angle is small.
        for _ in 0..halvings {
            let two = DoubleDouble::from(2.0);
            (sin, cos_minus_one) = (
                two * sin * (cos_minus_one + DoubleDouble::from(1.0)),
                -(two * sin * sin),
            );
        }
        (sin, cos_minus_one + DoubleDouble::from(1.0))
    }
}

impl From<f64> for DoubleDouble {
    fn from(x: f64) -> Self {
        DoubleDouble { high: x, low: 0.0 }
    }
}

/// Returns the exact sum of two f64.
fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    let part = high - a;
    DoubleDouble {
        high,
        low: (a - (high - part)) + (b - part),
    }
}

impl Add for DoubleDouble {
    type Output = DoubleDouble;
    fn add(self, other: DoubleDouble) -> DoubleDouble {
        let (high, low) = (two_sum(self.high, other.high), two_sum(self.low, other.low));
        let sum = two_sum(high.high, high.low + low.high);
        two_sum(sum.high, sum.low + low.low)
    }
}

impl Neg for DoubleDouble {
    type Output = DoubleDouble;
    fn neg(self) -> DoubleDouble {
        DoubleDouble {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Sub for DoubleDouble {
    type Output = DoubleDouble;
    fn sub(self, other: DoubleDouble) -> DoubleDouble {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = DoubleDouble;
    fn mul(self, other: DoubleDouble) -> DoubleDouble {
        let high = self.high * other.high;
        let rest = self.high.mul_add(other.high, -high);
        two_sum(high, rest + (self.high * other.low + self.low * other.high))
    }
}

impl Div for DoubleDouble {
    type Output = DoubleDouble;
    fn div(self, other: DoubleDouble) -> DoubleDouble {
        let first = DoubleDouble::from(self.high / other.high);
        let rest = self - other * first;
        let second = DoubleDouble::from(rest.high / other.high);
        let rest = rest - other * second;
        first + second + DoubleDouble::from(rest.high / other.high)
    }
}

/// A vector of three double-double numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DoubleDouble3(pub(crate) [DoubleDouble; 3]);

impl From<DVec3> for DoubleDouble3 {
    fn from(v: DVec3) -> Self {
        DoubleDouble3(v.to_array().map(DoubleDouble::from))
    }
}

impl DoubleDouble3 {
    pub(crate) fn dot(self, other: DoubleDouble3) -> DoubleDouble {
        let [x, y, z] = self.0;
        let [u, v, w] = other.0;
        x * u + y * v + z * w
    }

    pub(crate) fn cross(self, other: DoubleDouble3) -> DoubleDouble3 {
        let [x, y, z] = self.0;
        let [u, v, w] = other.0;
        DoubleDouble3([y * w - z * v, z * u - x * w, x * v - y * u])
    }

    pub(crate) fn scale(self, by: DoubleDouble) -> DoubleDouble3 {
        DoubleDouble3(self.0.map(|x| x * by))
    }

    pub(crate) fn length(self) -> DoubleDouble {
        self.dot(self).sqrt()
    }

    pub(crate) fn unit(self) -> DoubleDouble3 {
        let length = self.length();
        DoubleDouble3(self.0.map(|x| x / length))
    }

    /// Returns the vector rotated by a quaternion, which need not be normalised.
    fn rotated(self, q: DQuat) -> DoubleDouble3 {
        let v = DoubleDouble3::from(q.xyz());
        let w = DoubleDouble::from(q.w);
        let square = v.dot(v) + w * w;
        let twice = v.cross(self).scale(DoubleDouble::from(2.0));
        let moved = twice.scale(w) + v.cross(twice);
        self + DoubleDouble3(moved.0.map(|x| x / square))
    }

    /// Returns the vector rotated by `angle` about a unit axis.
    pub(crate) fn turned(self, axis: DoubleDouble3, angle: DoubleDouble) -> DoubleDouble3 {
        let (sin, cos) = angle.sin_cos();
        let along = axis.scale(axis.dot(self));
        along + (self - along).scale(cos) + axis.cross(self).scale(sin)
    }
}

impl Add for DoubleDouble3 {
    type Output = DoubleDouble3;
    fn add(self, other: DoubleDouble3) -> DoubleDouble3 {
        DoubleDouble3(std::array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl Sub for DoubleDouble3 {
    type Output = DoubleDouble3;
    fn sub(self, other: DoubleDouble3) -> DoubleDouble3 {
        DoubleDouble3(std::array::from_fn(|k| self.0[k] - other.0[k]))
    }
}

/// Returns the world position of a body's point at time `s · duration`, by the formula of [`Motion`] term by term.
pub(crate) fn place(motion: &Motion, duration: f64, s: f64, point: DVec3) -> DoubleDouble3 {
    let time = DoubleDouble::from(duration) * DoubleDouble::from(s);
    let center = DoubleDouble3::from(motion.center());
    let start = DoubleDouble3::from(motion.start().translation())
        + center.rotated(motion.start().rotation());
    let arm = to_world_vector(motion, duration, s, DoubleDouble3::from(point) - center);
    start + DoubleDouble3::from(motion.velocity()).scale(time) + arm
}

/// Rotates a vector from the body's frame to the world's frame at time `s · duration`.
fn to_world_vector(motion: &Motion, duration: f64, s: f64, vector: DoubleDouble3) -> DoubleDouble3 {
    let time = DoubleDouble::from(duration) * DoubleDouble::from(s);
    let vector = vector.rotated(motion.start().rotation());
    if motion.angular_velocity() == DVec3::ZERO {
        return vector;
    }
    let spin = DoubleDouble3::from(motion.angular_velocity());
    vector.turned(spin.unit(), spin.length() * time)
}

/// The given poses of a body at both ends of a motion; the quaternions need not be normalised.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EndPoses {
    pub(crate) positions: [DVec3; 2],
    pub(crate) turned: [DQuat; 2],
    /// The center of rotation in the body's frame, which moves on a straight line.
    pub(crate) center: DVec3,
}

impl EndPoses {
    /// Returns the exact world position of a body's point after the share `share` of the duration.
    pub(crate) fn place(&self, share: DoubleDouble, point: DVec3) -> DoubleDouble3 {
        let center = DoubleDouble3::from(self.center);
        let [start, end] =
            [0, 1].map(|k| DoubleDouble3::from(self.positions[k]) + center.rotated(self.turned[k]));
        let arm = (DoubleDouble3::from(point) - center).rotated(self.turned[0]);
        let ([x, y, z], w) = self.rotation_from_start_to_end();
        let axis = DoubleDouble3([x, y, z]);
        let sine = axis.length();
        let arm = if sine.high > 0.0 {
            arm.turned(axis.unit(), DoubleDouble::from(2.0) * sine.atan2(w) * share)
        } else {
            arm
        };
        start + (end - start).scale(share) + arm
    }

    /// Returns a quaternion that rotates the first orientation to the second; it is not normalised, and its real part
    /// is not negative.
    fn rotation_from_start_to_end(&self) -> ([DoubleDouble; 3], DoubleDouble) {
        let [from, to] = self.turned;
        let [v, u] = [from.xyz(), to.xyz()].map(DoubleDouble3::from);
        let [a, b] = [from.w, to.w].map(DoubleDouble::from);
        // u w* of quaternions (b, u) and (a, −v)
        let DoubleDouble3(xyz) = u.scale(a) - v.scale(b) - u.cross(v);
        let w = a * b + u.dot(v);
        if w.high < 0.0 {
            (xyz.map(|x| -x), -w)
        } else {
            (xyz, w)
        }
    }
}

#[test]
fn has_twice_the_digits() {
    let third = DoubleDouble::from(1.0) / DoubleDouble::from(3.0);
    let one = third + third + third;
    assert!((one - DoubleDouble::from(1.0)).get().abs() < 1e-31);
    let root = DoubleDouble::from(2.0).sqrt();
    assert!((root * root - DoubleDouble::from(2.0)).get().abs() < 1e-31);
    // Here sin² + cos² = 1, and the double angle agrees with another formula, also after many turns.
    for angle in [1e-9, 0.3, 2.0, -7.5, 1e3, 1e6] {
        let (sin, cos) = DoubleDouble::from(angle).sin_cos();
        let scale = 1e-30 * greater(1.0, angle.abs());
        assert!(
            (sin * sin + cos * cos - DoubleDouble::from(1.0))
                .get()
                .abs()
                < scale
        );
        assert!((sin.get() - angle.sin()).abs() < 1e-15);
        let first = DoubleDouble::from(angle.rem_euclid(1.5));
        let (sine, cosine) = first.sin_cos();
        assert!((sine.atan2(cosine) - first).get().abs() < 1e-30);
        let (third_sin, _) = (DoubleDouble::from(angle) / DoubleDouble::from(3.0)).sin_cos();
        let cubed = third_sin * third_sin * third_sin;
        let triple = DoubleDouble::from(3.0) * third_sin - DoubleDouble::from(4.0) * cubed;
        assert!((triple - sin).get().abs() < scale);
    }
}
