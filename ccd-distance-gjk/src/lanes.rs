//! Four vectors at once, coordinate by coordinate.

use ccd_core::glam::DVec3;
use wide::f64x4;

/// Four vectors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes3 {
    pub(crate) x: f64x4,
    pub(crate) y: f64x4,
    pub(crate) z: f64x4,
}

impl Lanes3 {
    /// The same vector four times.
    #[inline(always)]
    pub(crate) fn splat(v: DVec3) -> Self {
        Lanes3 {
            x: f64x4::splat(v.x),
            y: f64x4::splat(v.y),
            z: f64x4::splat(v.z),
        }
    }

    /// Four vectors side by side.
    #[inline(always)]
    pub(crate) fn new(v: [DVec3; 4]) -> Self {
        Lanes3 {
            x: f64x4::new(v.map(|v| v.x)),
            y: f64x4::new(v.map(|v| v.y)),
            z: f64x4::new(v.map(|v| v.z)),
        }
    }

    /// The vector in one lane.
    pub(crate) fn lane(self, k: usize) -> DVec3 {
        let at = |c: f64x4| c.to_array()[k];
        DVec3::new(at(self.x), at(self.y), at(self.z))
    }

    /// Returns `self − other`.
    #[inline(always)]
    pub(crate) fn minus(self, other: Self) -> Self {
        Lanes3 {
            x: self.x - other.x,
            y: self.y - other.y,
            z: self.z - other.z,
        }
    }

    /// Returns `self + t · direction`.
    #[inline(always)]
    pub(crate) fn along(self, t: f64x4, direction: Self) -> Self {
        Lanes3 {
            x: self.x + t * direction.x,
            y: self.y + t * direction.y,
            z: self.z + t * direction.z,
        }
    }

    /// Returns `self − t · direction`.
    #[inline(always)]
    pub(crate) fn back(self, t: f64x4, direction: Self) -> Self {
        Lanes3 {
            x: self.x - t * direction.x,
            y: self.y - t * direction.y,
            z: self.z - t * direction.z,
        }
    }

    /// Scalar products.
    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> f64x4 {
        self.x * other.x + (self.y * other.y + self.z * other.z)
    }

    /// Cross products.
    #[inline(always)]
    pub(crate) fn cross(self, other: Self) -> Self {
        Lanes3 {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// Returns the part of each vector that is perpendicular to `direction`; the vector itself if
    /// that is zero.
    #[inline(always)]
    pub(crate) fn perpendicular_to(self, direction: Self) -> Self {
        let t = self.dot(direction) * reciprocal(direction.dot(direction));
        self.back(t, direction)
    }
}

/// Returns `1 / x`, or 0 where x is not positive: projections onto zero vectors are zero.
#[inline(always)]
pub(crate) fn reciprocal(x: f64x4) -> f64x4 {
    x.simd_gt(f64x4::ZERO).select(f64x4::ONE / x, f64x4::ZERO)
}

/// Clamps to [0, 1].
#[inline(always)]
pub(crate) fn clamp_unit(x: f64x4) -> f64x4 {
    x.fast_max(f64x4::ZERO).fast_min(f64x4::ONE)
}
