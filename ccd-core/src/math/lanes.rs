//! Eight vectors at once, in f32, one for every child of a group.

use crate::rounding::LEAST_AXIS_F32;
use fearless_simd::{ExtractToken, Simd, f32x8, mask32x8, prelude::*};
use glam::Vec3;
use std::ops::{Add, Mul, Sub};

/// The least positive normal number, which replaces zero in divisors.
pub(crate) const TINY: f32 = f32::MIN_POSITIVE;

/// Eight vectors of three coordinates in f32.
#[derive(Clone, Copy)]
pub(crate) struct Vec3x8<L: Simd> {
    pub(crate) x: f32x8<L>,
    pub(crate) y: f32x8<L>,
    pub(crate) z: f32x8<L>,
}

impl<L: Simd> Vec3x8<L> {
    #[inline(always)]
    pub(crate) fn splat(level: L, v: Vec3) -> Self {
        Vec3x8 {
            x: f32x8::splat(level, v.x),
            y: f32x8::splat(level, v.y),
            z: f32x8::splat(level, v.z),
        }
    }

    #[inline(always)]
    pub(crate) fn load(level: L, rows: &[[f32; 8]; 3]) -> Self {
        let [x, y, z] = rows;
        Vec3x8 {
            x: load(level, x),
            y: load(level, y),
            z: load(level, z),
        }
    }

    #[inline(always)]
    pub(crate) fn level(&self) -> L {
        self.x.token()
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> f32x8<L> {
        self.x * other.x + (self.y * other.y + self.z * other.z)
    }

    #[inline(always)]
    pub(crate) fn length(self) -> f32x8<L> {
        self.dot(self).sqrt()
    }

    #[inline(always)]
    pub(crate) fn cross(self, other: Self) -> Self {
        Vec3x8 {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// Returns the unit vectors along eight vectors. A vector that is too short to have one in f32 gives zero, and
    /// along zero there is no gap.
    #[inline(always)]
    pub(crate) fn unit(self) -> Self {
        self * self.reciprocal_length()
    }

    /// Returns the reciprocals of the lengths; zero for a vector that is too short to have one in f32.
    #[inline(always)]
    pub(crate) fn reciprocal_length(self) -> f32x8<L> {
        let (zero, one) = (splat(self.level(), 0.0), splat(self.level(), 1.0));
        let length = self.length();
        length.simd_gt(LEAST_AXIS_F32).select(one / length, zero)
    }
}

impl<L: Simd> Add for Vec3x8<L> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Vec3x8 {
            x: self.x + other.x,
            y: self.y + other.y,
            z: self.z + other.z,
        }
    }
}

impl<L: Simd> Sub for Vec3x8<L> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Vec3x8 {
            x: self.x - other.x,
            y: self.y - other.y,
            z: self.z - other.z,
        }
    }
}

impl<L: Simd> Mul<f32x8<L>> for Vec3x8<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f32x8<L>) -> Self {
        Vec3x8 {
            x: self.x * factor,
            y: self.y * factor,
            z: self.z * factor,
        }
    }
}

#[inline(always)]
pub(crate) fn splat<L: Simd>(level: L, x: f32) -> f32x8<L> {
    f32x8::splat(level, x)
}

#[inline(always)]
pub(crate) fn load<L: Simd>(level: L, row: &[f32; 8]) -> f32x8<L> {
    (*row).simd_into(level)
}

/// Selects vectors of `a` where the mask is set, and vectors of `b` elsewhere.
#[inline(always)]
pub(crate) fn choose<L: Simd>(mask: mask32x8<L>, a: Vec3x8<L>, b: Vec3x8<L>) -> Vec3x8<L> {
    Vec3x8 {
        x: mask.select(a.x, b.x),
        y: mask.select(a.y, b.y),
        z: mask.select(a.z, b.z),
    }
}
