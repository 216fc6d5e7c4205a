//! Numbers of twice the digits, for what is made once and has to be right `[SHE97]`.
//!
//! The normal of a sliver is the small difference of large products: in f64 it would be right to no
//! digit where the sliver is thinner than 1e-16 of its length, and wrong by as much as it is thin
//! elsewhere. Sums of pairs of f64 leave 106 bits for it.

use ccd_core::glam::DVec3;
use std::ops::{Add, Mul, Sub};

/// A number held as the unevaluated sum of two.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Twofold {
    high: f64,
    low: f64,
}

impl Twofold {
    /// `a − b`, without rounding.
    pub(crate) fn difference(a: f64, b: f64) -> Self {
        let high = a - b;
        let back = high - a;
        let low = (a - (high - back)) - (b + back);
        Twofold { high, low }
    }

    /// Rounded to f64.
    pub(crate) fn value(self) -> f64 {
        self.high + self.low
    }

    /// The sum of two numbers of which the first is not smaller.
    fn renormalised(high: f64, low: f64) -> Self {
        let sum = high + low;
        Twofold {
            high: sum,
            low: low - (sum - high),
        }
    }
}

impl Add for Twofold {
    type Output = Twofold;

    fn add(self, other: Twofold) -> Twofold {
        let sum = Twofold::difference(self.high, -other.high);
        Twofold::renormalised(sum.high, sum.low + (self.low + other.low))
    }
}

impl Sub for Twofold {
    type Output = Twofold;

    fn sub(self, other: Twofold) -> Twofold {
        let negated = Twofold {
            high: -other.high,
            low: -other.low,
        };
        self + negated
    }
}

impl Mul for Twofold {
    type Output = Twofold;

    fn mul(self, other: Twofold) -> Twofold {
        let high = self.high * other.high;
        let low = self.high.mul_add(other.high, -high);
        Twofold::renormalised(high, low + (self.high * other.low + self.low * other.high))
    }
}

/// A vector of such numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct TwofoldVector([Twofold; 3]);

impl TwofoldVector {
    /// `a − b`, without rounding.
    pub(crate) fn difference(a: DVec3, b: DVec3) -> Self {
        TwofoldVector([0, 1, 2].map(|k| Twofold::difference(a[k], b[k])))
    }

    pub(crate) fn cross(self, other: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        TwofoldVector([b * f - c * e, c * d - a * f, a * e - b * d])
    }

    pub(crate) fn dot(self, other: Self) -> Twofold {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        a * d + b * e + c * f
    }

    /// Rounded to f64.
    pub(crate) fn value(self) -> DVec3 {
        DVec3::from_array(self.0.map(Twofold::value))
    }
}

impl Add for TwofoldVector {
    type Output = TwofoldVector;

    fn add(self, other: Self) -> Self {
        TwofoldVector([0, 1, 2].map(|k| self.0[k] + other.0[k]))
    }
}

/// Six times the volume of a tetrahedron, positive where `d` sees the triangle counter-clockwise.
pub(crate) fn volume([a, b, c]: [DVec3; 3], d: DVec3) -> f64 {
    let from = |p: DVec3| TwofoldVector::difference(p, a);
    from(b).cross(from(c)).dot(from(d)).value()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_that_cancel_are_kept() {
        // (2²⁷ + 1)² − 2⁵⁴ = 2²⁸ + 1, of which f64 loses the 1.
        let x = Twofold::difference(134_217_729.0, 0.0);
        let square = Twofold::difference(18_014_398_509_481_984.0, 0.0);
        assert_eq!((x * x - square).value(), 268_435_457.0);
    }

    #[test]
    fn slivers_have_normals() {
        // The difference of both products is 2⁻¹⁰⁴.
        let tiny = 1.0 + f64::EPSILON;
        let (a, b) = (DVec3::new(tiny, 1.0, 0.0), DVec3::new(1.0, 1.0 / 1.0, 0.0));
        let zero = DVec3::ZERO;
        let cross = TwofoldVector::difference(a, zero).cross(TwofoldVector::difference(b, zero));
        assert_eq!(cross.value(), DVec3::new(0.0, 0.0, f64::EPSILON));
        let square = DVec3::new(tiny, 1.0, 0.0);
        let other = DVec3::new(1.0, 2.0 - tiny, 0.0);
        let cross =
            TwofoldVector::difference(square, zero).cross(TwofoldVector::difference(other, zero));
        assert_eq!(cross.value().z, -f64::EPSILON * f64::EPSILON);
    }

    #[test]
    fn volumes_have_signs() {
        let base = [DVec3::ZERO, DVec3::X, DVec3::Y];
        assert_eq!(volume(base, 2.0 * DVec3::Z), 2.0);
        assert_eq!(volume(base, -DVec3::Z + 9.0 * DVec3::X), -1.0);
    }
}
