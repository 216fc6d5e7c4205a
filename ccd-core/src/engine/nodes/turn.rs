//! The rotation of a body, as seen from the group that is split.

use crate::math::lanes::Vec3x8;
use fearless_simd::{Simd, f32x8};
use glam::Vec3;

/// A body's rotation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    /// False for a body that does not turn, for which nothing is computed.
    pub(crate) turns: bool,
    pub(crate) spin: Vec3,
    /// `|ω|`, rounded up.
    pub(crate) rate: f32,
    /// A point on the axis of rotation.
    pub(crate) centre: Vec3,
}

impl Turn {
    /// A body that does not turn.
    pub(crate) const NONE: Turn = Turn {
        turns: false,
        spin: Vec3::ZERO,
        rate: 0.0,
        centre: Vec3::ZERO,
    };

    /// Returns the velocities of points due to turning.
    #[inline(always)]
    pub(crate) fn velocity<L: Simd>(&self, x: Vec3x8<L>) -> Vec3x8<L> {
        let level = x.level();
        if self.turns {
            Vec3x8::splat(level, self.spin).cross(x - Vec3x8::splat(level, self.centre))
        } else {
            Vec3x8::splat(level, Vec3::ZERO)
        }
    }

    /// Returns `n × ω`.
    #[inline(always)]
    pub(crate) fn across<L: Simd>(&self, n: Vec3x8<L>) -> Vec3x8<L> {
        if self.turns {
            n.cross(Vec3x8::splat(n.level(), self.spin))
        } else {
            Vec3x8::splat(n.level(), Vec3::ZERO)
        }
    }

    /// Returns the distances of points from the rotation's centre.
    #[inline(always)]
    pub(crate) fn arms<L: Simd>(&self, x: Vec3x8<L>) -> f32x8<L> {
        (x - Vec3x8::splat(x.level(), self.centre)).length()
    }

    /// Returns the distance of a point from the rotation's centre, if there is one.
    #[inline(always)]
    pub(crate) fn arm(&self, x: Vec3) -> f32 {
        if self.turns {
            (x - self.centre).length()
        } else {
            0.0
        }
    }
}
