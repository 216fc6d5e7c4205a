//! The two kinds of numbers for predicates: intervals first, and fractions if intervals are not certain.
//!
//! The judge of decompositions shares no arithmetic with what it judges, nor with the referee of `ccd-bench`.

use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use dashu_ratio::Relaxed;
use std::cmp::Ordering;

/// The arithmetic that a predicate needs.
pub(super) trait Number: Sized {
    /// Converts a finite number exactly.
    fn from_f64(x: f64) -> Self;
    fn plus(&self, other: &Self) -> Self;
    fn minus(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Self;
    /// Divides by a nonzero number.
    fn over(&self, divisor: u32) -> Self;
    /// Returns the sign, if it is certain.
    fn sign(&self) -> Option<Ordering>;

    /// Returns the coordinates of a point.
    fn point(p: DVec3) -> [Self; 3] {
        p.to_array().map(Self::from_f64)
    }
}

impl Number for Relaxed {
    fn from_f64(x: f64) -> Self {
        Relaxed::try_from(x).expect("a finite coordinate")
    }

    fn plus(&self, other: &Self) -> Self {
        self + other
    }

    fn minus(&self, other: &Self) -> Self {
        self - other
    }

    fn times(&self, other: &Self) -> Self {
        self * other
    }

    fn over(&self, divisor: u32) -> Self {
        self / Relaxed::from(divisor)
    }

    fn sign(&self) -> Option<Ordering> {
        Some(self.cmp(&Relaxed::ZERO))
    }
}

/// A number known to lie between two others.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interval {
    pub(super) lo: f64,
    pub(super) hi: f64,
}

impl Interval {
    /// Encloses a rounded result; the error is 0 only if the result is exact.
    fn rounded(result: f64, error: f64) -> Self {
        if error == 0.0 {
            Interval {
                lo: result,
                hi: result,
            }
        } else {
            Interval {
                lo: result.next_down(),
                hi: result.next_up(),
            }
        }
    }

    fn hull(all: impl IntoIterator<Item = Interval>) -> Self {
        let empty = Interval {
            lo: f64::INFINITY,
            hi: f64::NEG_INFINITY,
        };
        all.into_iter().fold(empty, |hull, x| Interval {
            lo: lesser(hull.lo, x.lo),
            hi: greater(hull.hi, x.hi),
        })
    }
}

impl Number for Interval {
    fn from_f64(x: f64) -> Self {
        Interval { lo: x, hi: x }
    }

    fn plus(&self, other: &Self) -> Self {
        Interval {
            lo: sum(self.lo, other.lo).lo,
            hi: sum(self.hi, other.hi).hi,
        }
    }

    fn minus(&self, other: &Self) -> Self {
        Interval {
            lo: sum(self.lo, -other.hi).lo,
            hi: sum(self.hi, -other.lo).hi,
        }
    }

    fn times(&self, other: &Self) -> Self {
        Interval::hull([
            product(self.lo, other.lo),
            product(self.lo, other.hi),
            product(self.hi, other.lo),
            product(self.hi, other.hi),
        ])
    }

    fn over(&self, divisor: u32) -> Self {
        Interval::hull([quotient(self.lo, divisor), quotient(self.hi, divisor)])
    }

    fn sign(&self) -> Option<Ordering> {
        if self.lo > 0.0 {
            Some(Ordering::Greater)
        } else if self.hi < 0.0 {
            Some(Ordering::Less)
        } else if self.lo == 0.0 && self.hi == 0.0 {
            Some(Ordering::Equal)
        } else {
            None
        }
    }
}

/// Encloses a sum, with Knuth's exact error of a sum.
fn sum(x: f64, y: f64) -> Interval {
    let sum = x + y;
    let back = sum - x;
    Interval::rounded(sum, (x - (sum - back)) + (y - back))
}

fn product(x: f64, y: f64) -> Interval {
    let product = x * y;
    Interval::rounded(product, residue(product, x.mul_add(y, -product)))
}

fn quotient(x: f64, y: u32) -> Interval {
    let quotient = x / f64::from(y);
    let error = quotient.mul_add(f64::from(y), -x);
    Interval::rounded(quotient, residue(quotient, error))
}

/// Returns the error of a product or quotient by a fused multiplication. It is itself inexact if
/// the result is so small that half its digits are subnormal.
fn residue(result: f64, error: f64) -> f64 {
    if result == 0.0 || result.abs() > 1e-200 {
        error
    } else {
        f64::NAN
    }
}
