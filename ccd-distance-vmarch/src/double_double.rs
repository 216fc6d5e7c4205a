//! Vectors of double-double numbers.
//!
//! The normal of a sliver is the small difference of large products. In f64 it would have no
//! correct digit if the sliver is thinner than 1e-16 of its length, and lose accuracy in proportion
//! to its thinness otherwise.

use ccd_core::double_double::DoubleDouble;
use ccd_core::glam::DVec3;
use std::ops::Add;

/// A vector of three double-double numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct DoubleDoubleVector([DoubleDouble; 3]);

impl DoubleDoubleVector {
    /// Returns `a − b` without rounding.
    pub(crate) fn difference(a: DVec3, b: DVec3) -> Self {
        DoubleDoubleVector([0, 1, 2].map(|k| DoubleDouble::difference(a[k], b[k])))
    }

    pub(crate) fn cross(self, other: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        DoubleDoubleVector([b * f - c * e, c * d - a * f, a * e - b * d])
    }

    pub(crate) fn dot(self, other: Self) -> DoubleDouble {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        a * d + b * e + c * f
    }

    /// Rounds the vector to f64.
    pub(crate) fn value(self) -> DVec3 {
        DVec3::from_array(self.0.map(DoubleDouble::value))
    }
}

impl Add for DoubleDoubleVector {
    type Output = DoubleDoubleVector;

    fn add(self, other: Self) -> Self {
        DoubleDoubleVector([0, 1, 2].map(|k| self.0[k] + other.0[k]))
    }
}

/// Returns six times the volume of a tetrahedron, positive if the triangle is counterclockwise as seen from `d`.
pub(crate) fn six_times_signed_volume([a, b, c]: [DVec3; 3], d: DVec3) -> f64 {
    let from = |p: DVec3| DoubleDoubleVector::difference(p, a);
    from(b).cross(from(c)).dot(from(d)).value()
}

#[cfg(test)]
mod tests;
