//! What a search needs of its vectors, so that one search serves both precisions.

use ccd_core::glam::{DVec3, Vec3A};
use num_traits::Float;
use std::fmt::Debug;
use std::ops::{Add, Mul, Neg, Sub};

/// A vector in three dimensions.
pub(crate) trait Vector:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<Self::Scalar, Output = Self>
{
    /// Its coordinates' type.
    type Scalar: Float + Debug + From<f32>;

    /// The zero vector.
    const ZERO: Self;
    /// The scalar product.
    fn dot(self, other: Self) -> Self::Scalar;
    /// The cross product.
    fn cross(self, other: Self) -> Self;
    /// Rounds from f64.
    fn round(from: DVec3) -> Self;
    /// To f64.
    fn widen(self) -> DVec3;

    /// The square of the length.
    #[inline]
    fn square(self) -> Self::Scalar {
        self.dot(self)
    }
}

impl Vector for DVec3 {
    type Scalar = f64;

    const ZERO: Self = DVec3::ZERO;
    #[inline]
    fn dot(self, other: Self) -> f64 {
        self.dot(other)
    }
    #[inline]
    fn cross(self, other: Self) -> Self {
        self.cross(other)
    }
    #[inline]
    fn round(from: DVec3) -> Self {
        from
    }
    #[inline]
    fn widen(self) -> DVec3 {
        self
    }
}

impl Vector for Vec3A {
    type Scalar = f32;

    const ZERO: Self = Vec3A::ZERO;
    #[inline]
    fn dot(self, other: Self) -> f32 {
        self.dot(other)
    }
    #[inline]
    fn cross(self, other: Self) -> Self {
        self.cross(other)
    }
    #[inline]
    fn round(from: DVec3) -> Self {
        from.as_vec3a()
    }
    #[inline]
    fn widen(self) -> DVec3 {
        self.as_dvec3()
    }
}

/// `ulps` units in the last place of one.
#[inline]
pub(crate) fn ulps<S: Float + From<f32>>(ulps: f32) -> S {
    <S as From<f32>>::from(ulps) * S::epsilon()
}
