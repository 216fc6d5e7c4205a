//! The turning of a body, as seen from the group that is split.

use super::vector_f32::{cross, length};
use glam::Vec3;

/// A body's rotation; a body that does not turn costs nothing.
pub(crate) trait Turn: Copy {
    const TURNS: bool;
    /// Returns the velocity of the point `x` due to turning.
    fn velocity(&self, x: Vec3) -> Vec3;
    /// Returns `n × ω`.
    fn across(&self, n: Vec3) -> Vec3;
    /// Returns `|ω|`, rounded up.
    fn rate(&self) -> f32;
    /// Returns the distance of `x` from the rotation's centre.
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
    fn velocity(&self, _: Vec3) -> Vec3 {
        Vec3::ZERO
    }
    #[inline(always)]
    fn across(&self, _: Vec3) -> Vec3 {
        Vec3::ZERO
    }
    #[inline(always)]
    fn rate(&self) -> f32 {
        0.0
    }
    #[inline(always)]
    fn arm(&self, _: Vec3) -> f32 {
        0.0
    }
}

impl Turn for Turning {
    const TURNS: bool = true;
    #[inline(always)]
    fn velocity(&self, x: Vec3) -> Vec3 {
        cross(self.spin, x - self.centre)
    }
    #[inline(always)]
    fn across(&self, n: Vec3) -> Vec3 {
        cross(n, self.spin)
    }
    #[inline(always)]
    fn rate(&self) -> f32 {
        self.rate
    }
    #[inline(always)]
    fn arm(&self, x: Vec3) -> f32 {
        length(x - self.centre)
    }
}
