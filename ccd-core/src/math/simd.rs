//! Vectors in registers: eight in f32, one for every child of a group, or one in f64; and the choice of the
//! instructions for them at run time.

use crate::math::componentwise::impl_componentwise;
use crate::rounding::LEAST_AXIS_LENGTH_F32;
use crate::settings::VectorInstructions;
use fearless_simd::{
    ExtractToken, Level, Simd, SimdBase, SimdNarrow, SimdSplit, f32x4, f32x8, f64x4, mask32x8,
    prelude::*,
};
use glam::{DMat3, DVec3, Vec3};
use std::ops::{Mul, Neg};

/// The least positive normal number, which replaces zero in divisors.
pub(crate) const LEAST_DIVISOR: f32 = f32::MIN_POSITIVE;

/// Eight vectors of three coordinates in f32.
#[derive(Clone, Copy)]
pub struct Vec3x8<L: Simd> {
    /// The eight x coordinates.
    pub x: f32x8<L>,
    /// The eight y coordinates.
    pub y: f32x8<L>,
    /// The eight z coordinates.
    pub z: f32x8<L>,
}

impl<L: Simd> Vec3x8<L> {
    /// Repeats one vector eight times.
    #[inline(always)]
    pub fn splat(level: L, v: Vec3) -> Self {
        Vec3x8 {
            x: f32x8::splat(level, v.x),
            y: f32x8::splat(level, v.y),
            z: f32x8::splat(level, v.z),
        }
    }

    /// Loads eight vectors from rows of x, y and z.
    #[inline(always)]
    pub fn load(level: L, rows: &[[f32; 8]; 3]) -> Self {
        let [x, y, z] = rows;
        Vec3x8 {
            x: load(level, x),
            y: load(level, y),
            z: load(level, z),
        }
    }

    /// Returns the token of the instructions.
    #[inline(always)]
    pub fn simd_level(&self) -> L {
        self.x.token()
    }

    /// Returns the dot products.
    #[inline(always)]
    pub fn dot(self, other: Self) -> f32x8<L> {
        self.x * other.x + (self.y * other.y + self.z * other.z)
    }

    /// Returns the lengths.
    #[inline(always)]
    pub fn length(self) -> f32x8<L> {
        self.dot(self).sqrt()
    }

    /// Returns the cross products.
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
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
        let (zero, one) = (splat(self.simd_level(), 0.0), splat(self.simd_level(), 1.0));
        let length = self.length();
        length
            .simd_gt(LEAST_AXIS_LENGTH_F32)
            .select(one / length, zero)
    }
}

impl_componentwise!(Add::add for Vec3x8<L> { x, y, z });
impl_componentwise!(Sub::sub for Vec3x8<L> { x, y, z });

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

/// Repeats a number eight times.
#[inline(always)]
pub fn splat<L: Simd>(level: L, x: f32) -> f32x8<L> {
    f32x8::splat(level, x)
}

/// Loads eight numbers.
#[inline(always)]
pub fn load<L: Simd>(level: L, row: &[f32; 8]) -> f32x8<L> {
    (*row).simd_into(level)
}

/// Selects vectors of `a` where the mask is set, and vectors of `b` elsewhere.
#[inline(always)]
pub(crate) fn select_vectors<L: Simd>(mask: mask32x8<L>, a: Vec3x8<L>, b: Vec3x8<L>) -> Vec3x8<L> {
    Vec3x8 {
        x: mask.select(a.x, b.x),
        y: mask.select(a.y, b.y),
        z: mask.select(a.z, b.z),
    }
}

/// Three coordinates in memory, and an unused fourth number.
pub(crate) type PaddedVec3 = [f64; 4];

/// A vector of three coordinates in f64, in one register.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PackedVector<L: Simd>(f64x4<L>);

/// A matrix, stored by columns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PackedMatrix<L: Simd>([PackedVector<L>; 3]);

/// Extends a vector by an unused fourth number.
pub(crate) fn pad_vector(v: DVec3) -> PaddedVec3 {
    [v.x, v.y, v.z, 0.0]
}

/// Returns the columns of a matrix, each with an unused fourth number.
pub(crate) fn padded_columns(m: DMat3) -> [PaddedVec3; 3] {
    [
        pad_vector(m.x_axis),
        pad_vector(m.y_axis),
        pad_vector(m.z_axis),
    ]
}

impl<L: Simd> PackedVector<L> {
    #[inline(always)]
    pub(crate) fn new(level: L, v: DVec3) -> Self {
        PackedVector::load(level, &pad_vector(v))
    }

    #[inline(always)]
    pub(crate) fn load(level: L, row: &PaddedVec3) -> Self {
        PackedVector((*row).simd_into(level))
    }

    #[inline(always)]
    pub(crate) fn to_dvec3(self) -> DVec3 {
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
    pub(crate) fn new(columns: [PackedVector<L>; 3]) -> Self {
        PackedMatrix(columns)
    }

    /// Rounds the columns of the matrix to f32.
    #[inline(always)]
    pub(crate) fn narrow(&self) -> [f32x4<L>; 3] {
        let [x, y, z] = self.0;
        [x.narrow(), y.narrow(), z.narrow()]
    }
}

impl_componentwise!(Add::add for PackedVector<L> { 0 });
impl_componentwise!(Sub::sub for PackedVector<L> { 0 });

impl<L: Simd> Neg for PackedVector<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        PackedVector(-self.0)
    }
}

impl<L: Simd> Mul<f64> for PackedVector<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        PackedVector(self.0 * f64x4::splat(self.0.token(), factor))
    }
}

impl<L: Simd> Mul<PackedVector<L>> for PackedMatrix<L> {
    type Output = PackedVector<L>;
    #[inline(always)]
    fn mul(self, v: PackedVector<L>) -> PackedVector<L> {
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

impl VectorInstructions {
    /// Converts the choice of instructions to the token that [`vectorize!`](crate::vectorize) takes.
    #[doc(hidden)]
    pub fn simd_level(self) -> Level {
        match self {
            VectorInstructions::Best => Level::new(),
            VectorInstructions::Baseline => Level::baseline(),
        }
    }
}

/// Evaluates an expression with the best useful vector instructions: AVX2 or else SSE2 on x86, NEON on 64-bit ARM. All
/// functions called by the expression, closures included, have to be `#[inline(always)]`: others are compiled for the
/// oldest machine.
///
/// AVX-512 is left out: eight lanes of f32 gain nothing by it, and rustc 1.95 miscompiles it. Every further level is
/// another copy of the code.
///
/// WebAssembly without `simd128` has no vector instructions: each operation on eight lanes is eight, and a kernel of a
/// hundred thousand instructions takes LLVM longer than anyone waits. There, the build script does not set
/// `inline_kernels`, and the larger parts of kernels are not `#[inline(always)]`. The compiler makes functions of them,
/// which takes it less than a minute.
///
/// This is for the distance backends of this project, and no stable interface.
#[doc(hidden)]
#[macro_export]
macro_rules! vectorize {
    (@with $token:expr, $name:ident => $value:expr) => {{
        use $crate::fearless_simd::Simd as _;
        let $name = $token;
        $name.vectorize(
            #[inline(always)]
            || $value,
        )
    }};
    ($level:expr, $token:ident => $value:expr) => {{
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        {
            match $level.as_avx2() {
                Some(avx2) => $crate::vectorize!(@with avx2, $token => $value),
                None => {
                    let sse2 = $level.as_sse2().expect("an x86 target with SSE2");
                    $crate::vectorize!(@with sse2, $token => $value)
                }
            }
        }
        #[cfg(target_arch = "aarch64")]
        {
            let neon = $level.as_neon().expect("64-bit ARM with NEON");
            $crate::vectorize!(@with neon, $token => $value)
        }
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64", target_arch = "aarch64")))]
        {
            $crate::fearless_simd::dispatch!($level, $token => $value)
        }
    }};
}

#[cfg(all(
    any(target_arch = "x86", target_arch = "x86_64"),
    not(target_feature = "sse2")
))]
compile_error!(
    "ccd-core needs SSE2 on x86; build for a target that has it, such as i686 instead of i586"
);
