//! Intervals of numbers, vectors and matrices, stored as middle and radius.
//!
//! Rounding is plain: enclosures are those of exact arithmetic up to a few units in the last place.
//! The referee, which judges rivals, has intervals of its own with sound rounding (`truth/interval.rs`).

use ccd_core::glam::{DMat3, DVec3};
use std::ops::{Add, Mul, Sub};

/// All numbers within `radius` of `middle`; for vectors and matrices, an interval for every entry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval<T = f64> {
    pub(super) middle: T,
    pub(super) radius: T,
}

pub(super) type IntervalVec = Interval<DVec3>;
pub(super) type IntervalMat = Interval<DMat3>;

/// The ranges of cosine and sine over all angles between −h and h, for a half angle h.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SineCosineRange {
    pub(super) cos: Interval,
    /// The radius of the range of the sine, which is centered at zero.
    pub(super) sin_radius: f64,
}

impl SineCosineRange {
    /// Returns the ranges of cosine and sine over an arc of the given half angle.
    #[inline]
    pub(super) fn new(half_angle: f64) -> Self {
        use std::f64::consts::{FRAC_PI_2, PI};
        let (sin, cos) = half_angle.sin_cos();
        let least_cos = if half_angle < PI { cos } else { -1.0 };
        SineCosineRange {
            cos: Interval {
                middle: 0.5 * (1.0 + least_cos),
                radius: 0.5 * (1.0 - least_cos),
            },
            sin_radius: if half_angle < FRAC_PI_2 { sin } else { 1.0 },
        }
    }
}

impl Interval {
    #[inline]
    pub(super) fn low(self) -> f64 {
        self.middle - self.radius
    }

    #[inline]
    pub(super) fn high(self) -> f64 {
        self.middle + self.radius
    }

    /// Returns true if no number in the interval is zero; false for NaN.
    #[inline]
    pub(super) fn excludes_zero(self) -> bool {
        self.middle.abs() > self.radius
    }
}

impl<T: Add<Output = T>> Add for Interval<T> {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Interval {
            middle: self.middle + other.middle,
            radius: self.radius + other.radius,
        }
    }
}

impl<T: Add<Output = T> + Sub<Output = T>> Sub for Interval<T> {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        Interval {
            middle: self.middle - other.middle,
            radius: self.radius + other.radius,
        }
    }
}

impl IntervalVec {
    /// Returns the interval of the dot products of this interval's vectors with a vector.
    #[inline]
    pub(super) fn dot_vector(self, other: DVec3) -> Interval {
        Interval {
            middle: self.middle.dot(other),
            radius: self.radius.dot(other.abs()),
        }
    }

    /// Returns the interval of the dot products of this interval's vectors with those of another interval.
    #[inline]
    pub(super) fn dot(self, other: IntervalVec) -> Interval {
        Interval {
            middle: self.middle.dot(other.middle),
            radius: self.middle.abs().dot(other.radius)
                + self.radius.dot(other.middle.abs() + other.radius),
        }
    }

    /// Returns the interval of the cross products of this interval's vectors with a vector.
    #[inline]
    pub(super) fn cross_vector(self, other: DVec3) -> IntervalVec {
        IntervalVec {
            middle: self.middle.cross(other),
            radius: cross_radius(self.radius, other.abs()),
        }
    }

    /// Returns the interval of the cross products of this interval's vectors with those of another interval.
    #[inline]
    pub(super) fn cross(self, other: IntervalVec) -> IntervalVec {
        IntervalVec {
            middle: self.middle.cross(other.middle),
            radius: cross_radius(self.middle.abs(), other.radius)
                + cross_radius(self.radius, other.middle.abs() + other.radius),
        }
    }

    /// Returns the interval of the differences between this interval's vectors and a vector.
    #[inline]
    pub(super) fn minus_point(self, other: DVec3) -> IntervalVec {
        IntervalVec {
            middle: self.middle - other,
            radius: self.radius,
        }
    }

    /// Returns the largest absolute value of each coordinate.
    #[inline]
    pub(super) fn magnitude(self) -> DVec3 {
        self.middle.abs() + self.radius
    }

    /// Returns the smallest absolute value of each coordinate; negative if the interval contains zero.
    #[inline]
    pub(super) fn mignitude(self) -> DVec3 {
        self.middle.abs() - self.radius
    }
}

/// Returns the cross product with sums in place of differences, which bounds the radius of a cross product.
#[inline]
pub(super) fn cross_radius(a: DVec3, b: DVec3) -> DVec3 {
    DVec3::new(
        a.y * b.z + a.z * b.y,
        a.z * b.x + a.x * b.z,
        a.x * b.y + a.y * b.x,
    )
}

impl Mul<DVec3> for IntervalMat {
    type Output = IntervalVec;

    #[inline]
    fn mul(self, point: DVec3) -> IntervalVec {
        IntervalVec {
            middle: self.middle * point,
            radius: self.radius * point.abs(),
        }
    }
}

impl Mul<IntervalVec> for IntervalMat {
    type Output = IntervalVec;

    #[inline]
    fn mul(self, vector: IntervalVec) -> IntervalVec {
        IntervalVec {
            middle: self.middle * vector.middle,
            radius: self.middle.abs() * vector.radius + self.radius * vector.magnitude(),
        }
    }
}

impl Mul for IntervalMat {
    type Output = IntervalMat;

    fn mul(self, other: IntervalMat) -> IntervalMat {
        IntervalMat {
            middle: self.middle * other.middle,
            radius: self.middle.abs() * other.radius
                + self.radius * (other.middle.abs() + other.radius),
        }
    }
}

impl IntervalMat {
    /// Returns the interval of the transposed matrices.
    pub(super) fn transpose(self) -> IntervalMat {
        IntervalMat {
            middle: self.middle.transpose(),
            radius: self.radius.transpose(),
        }
    }
}

#[cfg(test)]
mod tests;
