//! A body's rotation in the coordinates of the split group.

use crate::math::lanes::Vec3x8;
use fearless_simd::{Simd, f32x8};
use glam::Vec3;

/// The angular velocity of a body, with its centre of rotation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyRotation {
    /// False for a body without rotation; the other fields are not used then.
    pub(crate) is_turning: bool,
    pub(crate) spin: Vec3,
    /// The angular speed `|ω|`, rounded up.
    pub(crate) rate: f32,
    /// The position of a point on the axis of rotation.
    pub(crate) centre: Vec3,
}

impl BodyRotation {
    /// The rotation of a body that does not turn.
    pub(crate) const NONE: BodyRotation = BodyRotation {
        is_turning: false,
        spin: Vec3::ZERO,
        rate: 0.0,
        centre: Vec3::ZERO,
    };

    /// Returns the velocities of points due to rotation, `ω × (x − centre)`.
    #[inline(always)]
    pub(crate) fn velocity<L: Simd>(&self, x: Vec3x8<L>) -> Vec3x8<L> {
        let level = x.level();
        if self.is_turning {
            Vec3x8::splat(level, self.spin).cross(x - Vec3x8::splat(level, self.centre))
        } else {
            Vec3x8::splat(level, Vec3::ZERO)
        }
    }

    /// Returns the cross products `n × ω`.
    #[inline(always)]
    pub(crate) fn cross_spin<L: Simd>(&self, n: Vec3x8<L>) -> Vec3x8<L> {
        if self.is_turning {
            n.cross(Vec3x8::splat(n.level(), self.spin))
        } else {
            Vec3x8::splat(n.level(), Vec3::ZERO)
        }
    }

    /// Returns the distances of points from the centre of rotation.
    #[inline(always)]
    pub(crate) fn distances_from_centre<L: Simd>(&self, x: Vec3x8<L>) -> f32x8<L> {
        (x - Vec3x8::splat(x.level(), self.centre)).length()
    }

    /// Returns the distance of a point from the centre of rotation; 0 without rotation.
    #[inline(always)]
    pub(crate) fn distance_from_centre(&self, x: Vec3) -> f32 {
        if self.is_turning {
            (x - self.centre).length()
        } else {
            0.0
        }
    }
}
