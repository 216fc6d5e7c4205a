//! The turning of a body, as seen from the group that is split.

use super::lanes::{Vec3x8, splat};
use fearless_simd::{Simd, f32x8};
use glam::Vec3;

/// A body's rotation; a body that does not turn costs nothing.
pub(crate) trait Turn: Copy {
    const TURNS: bool;
    /// Returns the velocities of points due to turning.
    fn velocity<L: Simd>(&self, x: Vec3x8<L>) -> Vec3x8<L>;
    /// Returns `n × ω`.
    fn across<L: Simd>(&self, n: Vec3x8<L>) -> Vec3x8<L>;
    /// Returns `|ω|`, rounded up.
    fn rate(&self) -> f32;
    /// Returns the distances of points from the rotation's centre.
    fn arms<L: Simd>(&self, x: Vec3x8<L>) -> f32x8<L>;
    /// Returns the distance of a point from the rotation's centre.
    fn arm(&self, x: Vec3) -> f32;
}

/// A body that does not turn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Straight;

/// A body that turns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turning {
    pub(crate) spin: Vec3,
    pub(crate) rate: f32,
    /// A point on the axis of rotation.
    pub(crate) centre: Vec3,
}

impl Turn for Straight {
    const TURNS: bool = false;
    #[inline(always)]
    fn velocity<L: Simd>(&self, x: Vec3x8<L>) -> Vec3x8<L> {
        Vec3x8::splat(x.level(), Vec3::ZERO)
    }
    #[inline(always)]
    fn across<L: Simd>(&self, n: Vec3x8<L>) -> Vec3x8<L> {
        Vec3x8::splat(n.level(), Vec3::ZERO)
    }
    #[inline(always)]
    fn rate(&self) -> f32 {
        0.0
    }
    #[inline(always)]
    fn arms<L: Simd>(&self, x: Vec3x8<L>) -> f32x8<L> {
        splat(x.level(), 0.0)
    }
    #[inline(always)]
    fn arm(&self, _: Vec3) -> f32 {
        0.0
    }
}

impl Turn for Turning {
    const TURNS: bool = true;
    #[inline(always)]
    fn velocity<L: Simd>(&self, x: Vec3x8<L>) -> Vec3x8<L> {
        let level = x.level();
        Vec3x8::splat(level, self.spin).cross(x - Vec3x8::splat(level, self.centre))
    }
    #[inline(always)]
    fn across<L: Simd>(&self, n: Vec3x8<L>) -> Vec3x8<L> {
        n.cross(Vec3x8::splat(n.level(), self.spin))
    }
    #[inline(always)]
    fn rate(&self) -> f32 {
        self.rate
    }
    #[inline(always)]
    fn arms<L: Simd>(&self, x: Vec3x8<L>) -> f32x8<L> {
        (x - Vec3x8::splat(x.level(), self.centre)).length()
    }
    #[inline(always)]
    fn arm(&self, x: Vec3) -> f32 {
        (x - self.centre).length()
    }
}
