//! Double-double arithmetic: a number is the unevaluated sum of two f64 \[DEKKER71\].
//!
//! The arithmetic of a judge: `ccd-distance-vmarch`, which it judges, has another.

use crate::vector::Number;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::LazyLock;

/// The number `hi + lo`, where `hi` is the sum rounded to f64. It has about 32 digits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DoubleDouble {
    hi: f64,
    lo: f64,
}

/// Returns the sum of two numbers, as the rounded sum and its error.
#[inline]
fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    let of_b = hi - a;
    let lo = (a - (hi - of_b)) + (b - of_b);
    DoubleDouble { hi, lo }
}

/// Computes [`two_sum`] faster, for `a` of larger magnitude than `b`.
#[inline]
fn quick_two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    DoubleDouble {
        hi,
        lo: b - (hi - a),
    }
}

/// Returns the product of two numbers, as the rounded product and its error, unless the error underflows.
#[inline]
fn two_prod(a: f64, b: f64) -> DoubleDouble {
    let hi = a * b;
    DoubleDouble {
        hi,
        lo: a.mul_add(b, -hi),
    }
}

impl DoubleDouble {
    pub const fn new(hi: f64) -> Self {
        DoubleDouble { hi, lo: 0.0 }
    }

    /// Returns the sine and the cosine, by reduction to quarter turns and power series.
    pub fn sin_cos(self) -> (DoubleDouble, DoubleDouble) {
        // π/2 in three parts.
        const HALF_PI_PARTS: [f64; 3] = [
            std::f64::consts::FRAC_PI_2,
            6.123_233_995_736_766e-17,
            -1.497_384_904_859_17e-33,
        ];
        let quarters = (self.hi / HALF_PI_PARTS[0]).round();
        let r = HALF_PI_PARTS
            .iter()
            .fold(self, |r, &part| r - two_prod(quarters, part));
        let square = r * r;
        let factors = &*INVERSE_FACTORIALS;
        let series = |first: usize| {
            let (mut sum, mut n) = (DoubleDouble::default(), 26 + first);
            while n > first {
                sum = factors[n] - sum * square;
                n -= 2;
            }
            factors[first] - sum * square
        };
        let (sin, cos) = (r * series(1), series(0));
        match quarters.rem_euclid(4.0) as u8 {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }

    /// Returns the angle with the given sine and cosine: the f64 angle, improved by one Newton step.
    pub fn angle(sin: DoubleDouble, cos: DoubleDouble) -> DoubleDouble {
        let near = DoubleDouble::new(sin.hi.atan2(cos.hi));
        let (s, c) = near.sin_cos();
        near + (sin * c - cos * s)
    }
}

static INVERSE_FACTORIALS: LazyLock<[DoubleDouble; 29]> = LazyLock::new(|| {
    let mut all = [DoubleDouble::new(1.0); 29];
    for n in 1..29 {
        all[n] = all[n - 1] / DoubleDouble::new(n as f64);
    }
    all
});

impl Number for DoubleDouble {
    #[inline]
    fn from_f64(x: f64) -> Self {
        DoubleDouble::new(x)
    }

    #[inline]
    fn to_f64(self) -> f64 {
        self.hi
    }

    #[inline]
    fn sqrt(self) -> Self {
        if !(self.hi > 0.0) {
            return DoubleDouble::default();
        }
        let near = DoubleDouble::new(self.hi.sqrt());
        near + (self - near * near) / (near + near)
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let (s, t) = (two_sum(self.hi, other.hi), two_sum(self.lo, other.lo));
        let s = quick_two_sum(s.hi, s.lo + t.hi);
        quick_two_sum(s.hi, s.lo + t.lo)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        DoubleDouble {
            hi: -self.hi,
            lo: -self.lo,
        }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let p = two_prod(self.hi, other.hi);
        quick_two_sum(p.hi, p.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    #[inline]
    fn div(self, other: Self) -> Self {
        let first = self.hi / other.hi;
        let rest = self - other * DoubleDouble::new(first);
        let second = rest.hi / other.hi;
        let rest = rest - other * DoubleDouble::new(second);
        quick_two_sum(first, second) + DoubleDouble::new(rest.hi / other.hi)
    }
}

impl PartialOrd for DoubleDouble {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match self.hi.partial_cmp(&other.hi)? {
            Ordering::Equal => self.lo.partial_cmp(&other.lo),
            order => Some(order),
        }
    }
}
