//! Vectors and matrices in f64, with one vector register for each vector.

use fearless_simd::{
    ExtractToken, Simd, SimdBase, SimdNarrow, SimdSplit, f32x4, f64x4, prelude::*,
};
use glam::{DMat3, DVec3, Vec3};
use std::ops::{Add, Mul, Neg, Sub};

/// Three coordinates in memory, and an unused fourth number.
pub(crate) type Row = [f64; 4];

/// A vector in one register.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Packed<L: Simd>(f64x4<L>);

/// A matrix, stored by columns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PackedMatrix<L: Simd>([Packed<L>; 3]);

/// Extends a vector by an unused fourth number.
pub(crate) fn row(v: DVec3) -> Row {
    [v.x, v.y, v.z, 0.0]
}

/// Returns the columns of a matrix, each with an unused fourth number.
pub(crate) fn rows(m: DMat3) -> [Row; 3] {
    [row(m.x_axis), row(m.y_axis), row(m.z_axis)]
}

impl<L: Simd> Packed<L> {
    #[inline(always)]
    pub(crate) fn new(level: L, v: DVec3) -> Self {
        Packed::load(level, &row(v))
    }

    #[inline(always)]
    pub(crate) fn load(level: L, row: &Row) -> Self {
        Packed((*row).simd_into(level))
    }

    #[inline(always)]
    pub(crate) fn unpacked(self) -> DVec3 {
        DVec3::new(self.0[0], self.0[1], self.0[2])
    }

    /// Rounds the vector to f32, in a register.
    #[inline(always)]
    pub(crate) fn narrow(self) -> f32x4<L> {
        self.0.narrow(self.0).split().0
    }

    /// Rounds the vector to f32.
    #[inline(always)]
    pub(crate) fn as_vec3(self) -> Vec3 {
        as_vec3(self.narrow())
    }
}

#[inline(always)]
pub(crate) fn as_vec3<L: Simd>(v: f32x4<L>) -> Vec3 {
    Vec3::new(v[0], v[1], v[2])
}

impl<L: Simd> PackedMatrix<L> {
    #[inline(always)]
    pub(crate) fn new(columns: [Packed<L>; 3]) -> Self {
        PackedMatrix(columns)
    }

    /// Rounds the columns of the matrix to f32.
    #[inline(always)]
    pub(crate) fn narrow(&self) -> [f32x4<L>; 3] {
        let [x, y, z] = self.0;
        [x.narrow(), y.narrow(), z.narrow()]
    }
}

impl<L: Simd> Add for Packed<L> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Packed(self.0 + other.0)
    }
}

impl<L: Simd> Sub for Packed<L> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Packed(self.0 - other.0)
    }
}

impl<L: Simd> Neg for Packed<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Packed(-self.0)
    }
}

impl<L: Simd> Mul<f64> for Packed<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        Packed(self.0 * f64x4::splat(self.0.token(), factor))
    }
}

impl<L: Simd> Mul<Packed<L>> for PackedMatrix<L> {
    type Output = Packed<L>;
    #[inline(always)]
    fn mul(self, v: Packed<L>) -> Packed<L> {
        let [x, y, z] = self.0;
        x * v.0[0] + y * v.0[1] + z * v.0[2]
    }
}

impl<L: Simd> Mul for PackedMatrix<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let [x, y, z] = other.0;
        PackedMatrix([self * x, self * y, self * z])
    }
}
