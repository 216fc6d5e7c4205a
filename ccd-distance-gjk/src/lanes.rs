//! Four vectors in the lanes of SIMD registers.

use ccd_core::fearless_simd::{ExtractToken, Simd, f64x4, prelude::*};
use ccd_core::glam::DVec3;

/// Four vectors in f64. Each field holds one coordinate of all four vectors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FourVectors<L: Simd> {
    pub(crate) x: f64x4<L>,
    pub(crate) y: f64x4<L>,
    pub(crate) z: f64x4<L>,
}

impl<L: Simd> FourVectors<L> {
    /// Creates four copies of a vector.
    #[inline(always)]
    pub(crate) fn splat(level: L, v: DVec3) -> Self {
        FourVectors {
            x: splat(level, v.x),
            y: splat(level, v.y),
            z: splat(level, v.z),
        }
    }

    /// Creates the lanes from four vectors.
    #[inline(always)]
    pub(crate) fn new(level: L, [a, b, c, d]: [DVec3; 4]) -> Self {
        FourVectors {
            x: [a.x, b.x, c.x, d.x].simd_into(level),
            y: [a.y, b.y, c.y, d.y].simd_into(level),
            z: [a.z, b.z, c.z, d.z].simd_into(level),
        }
    }

    #[inline(always)]
    pub(crate) fn simd_level(&self) -> L {
        self.x.token()
    }

    /// Returns the vector in the lane `k`, from 0 to 3.
    pub(crate) fn lane(self, k: usize) -> DVec3 {
        DVec3::new(self.x[k], self.y[k], self.z[k])
    }

    /// Returns the differences `self − other`.
    #[inline(always)]
    pub(crate) fn subtract(self, other: Self) -> Self {
        FourVectors {
            x: self.x - other.x,
            y: self.y - other.y,
            z: self.z - other.z,
        }
    }

    /// Returns the sums `self + t · direction`.
    #[inline(always)]
    pub(crate) fn add_scaled(self, t: f64x4<L>, direction: Self) -> Self {
        FourVectors {
            x: self.x + t * direction.x,
            y: self.y + t * direction.y,
            z: self.z + t * direction.z,
        }
    }

    /// Returns the scalar product of the two vectors in each lane.
    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> f64x4<L> {
        self.x * other.x + (self.y * other.y + self.z * other.z)
    }

    /// Returns the cross product of the two vectors in each lane.
    #[inline(always)]
    pub(crate) fn cross(self, other: Self) -> Self {
        FourVectors {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// Returns the component of each vector that is perpendicular to `direction`; the vector itself if `direction` is
    /// zero.
    #[inline(always)]
    pub(crate) fn perpendicular_part(self, direction: Self) -> Self {
        let t = self.dot(direction) * reciprocal_or_zero(direction.dot(direction));
        self.add_scaled(-t, direction)
    }
}

#[inline(always)]
pub(crate) fn splat<L: Simd>(level: L, x: f64) -> f64x4<L> {
    f64x4::splat(level, x)
}

/// Returns `1 / x`, or 0 where x is not positive: projections onto zero vectors are zero.
#[inline(always)]
pub(crate) fn reciprocal_or_zero<L: Simd>(x: f64x4<L>) -> f64x4<L> {
    let level = x.token();
    x.simd_gt(0.0)
        .select(splat(level, 1.0) / x, splat(level, 0.0))
}

/// Clamps four numbers to [0, 1].
#[inline(always)]
pub(crate) fn clamp_to_unit_interval<L: Simd>(x: f64x4<L>) -> f64x4<L> {
    x.max(0.0).min(1.0)
}
