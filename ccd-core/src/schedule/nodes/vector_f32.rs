//! Arithmetic that vectorises: written out, branch-free, fused where the machine can.

use crate::tolerance::LEAST_AXIS_F32;
use glam::Vec3;

/// The least normal number, a divisor in place of zero.
pub(super) const TINY: f32 = f32::MIN_POSITIVE;

#[inline(always)]
pub(super) fn fused(a: f32, b: f32, c: f32) -> f32 {
    if cfg!(target_feature = "fma") {
        a.mul_add(b, c)
    } else {
        a * b + c
    }
}

#[inline(always)]
pub(super) fn dot(a: Vec3, b: Vec3) -> f32 {
    fused(a.x, b.x, fused(a.y, b.y, a.z * b.z))
}

#[inline(always)]
pub(super) fn length(a: Vec3) -> f32 {
    dot(a, a).sqrt()
}

#[inline(always)]
pub(super) fn cross(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(
        fused(a.y, b.z, -(a.z * b.y)),
        fused(a.z, b.x, -(a.x * b.z)),
        fused(a.x, b.y, -(a.y * b.x)),
    )
}

#[inline(always)]
pub(super) fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline(always)]
pub(super) fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The unit vector, or zero for a vector that is too short to have one in f32: no gap exists along
/// zero.
#[inline(always)]
pub(super) fn unit(a: Vec3) -> Vec3 {
    let length = length(a);
    a * if length > LEAST_AXIS_F32 {
        1.0 / length
    } else {
        0.0
    }
}

#[inline(always)]
pub(super) fn choose(first: bool, a: f32, b: f32) -> f32 {
    if first { a } else { b }
}
