//! Eight pairs of nodes, each a child of one group with the same other node, and their closing rates.

use super::axis::AxesX8;
use super::clock;
use super::shape::{Children, OtherNode};
use crate::math::simd::{Vec3x8, splat};
use crate::rounding::{
    CROSS_PRODUCT_ERROR_F32, LEAST_SECOND_DERIVATIVE_F32, RATE_ERROR_F32,
    SECOND_DERIVATIVE_FACTOR_F32,
};
use fearless_simd::{Simd, f32x8};
use glam::Vec3;

/// The relative motion of two bodies, in f32, with allowances for rounding.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RelativeMotionF32 {
    /// The velocity of the split body's center relative to the other body's.
    pub(crate) velocity: Vec3,
    /// The derivative of `velocity`; `None` if both centers accelerate equally.
    pub(crate) acceleration: Option<Vec3>,
    pub(crate) split_body_rotation: BodyRotation,
    pub(crate) other_rotation: BodyRotation,
    /// The time left to the end of the duration.
    pub(crate) remaining_time: f32,
    /// The gap to keep, plus a bound of the rounding error of a computed gap.
    pub(crate) required_gap: f32,
    /// The excess of a gap over the slack up to which the gap counts as closed.
    pub(crate) closed_gap_threshold: f32,
    /// A bound of the rounding of a closing rate.
    pub(crate) rate_allowance: f32,
    pub(crate) larger_body: Option<LargerBody>,
}

/// The body that turns and whose nodes are much larger than the other's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LargerBody {
    BodyToSplit,
    OtherBody,
}

/// The children of a group, each paired with the same other node.
pub(crate) struct EightPairs<'a, L: Simd, C, P> {
    pub(crate) children: &'a C,
    pub(crate) other_node: &'a P,
    pub(crate) motion: &'a RelativeMotionF32,
    /// The vectors from the children's centers to the other node's center.
    pub(crate) offset: Vec3x8<L>,
    /// The velocities of the children's centers relative to the other node's.
    pub(crate) velocity: Vec3x8<L>,
    /// Upper bounds of the speeds of the children's points due to rotation.
    pub(crate) rotational_speed_bounds: f32x8<L>,
    /// The velocity of the other node's center due to rotation.
    pub(crate) other_rotational_velocity: Vec3x8<L>,
    /// An upper bound of the speeds of the other node's points due to rotation.
    pub(crate) other_rotational_speed_bound: f32x8<L>,
}

impl<'a, L: Simd, C: Children, P: OtherNode> EightPairs<'a, L, C, P> {
    #[inline(always)]
    pub(crate) fn simd_level(&self) -> L {
        self.offset.simd_level()
    }

    #[inline(always)]
    pub(crate) fn new(
        level: L,
        children: &'a C,
        other: &'a P,
        motion: &'a RelativeMotionF32,
    ) -> Self {
        let (center, other_center) = (children.center(level), Vec3x8::splat(level, other.center()));
        let turning = motion.split_body_rotation.rotational_velocity(center);
        let other_turning = motion.other_rotation.rotational_velocity(other_center);
        let velocity = Vec3x8::splat(level, motion.velocity);
        EightPairs {
            children,
            other_node: other,
            motion,
            offset: other_center - center,
            velocity: velocity + turning - other_turning,
            // A slack on the speeds covers the rounding of the second derivatives.
            rotational_speed_bounds: turning.length()
                + children.radius(level) * motion.split_body_rotation.angular_speed
                + motion.rate_allowance,
            other_rotational_velocity: other_turning,
            other_rotational_speed_bound: other_turning.length()
                + motion.other_rotation.angular_speed * other.radius()
                + motion.rate_allowance,
        }
    }

    /// Returns the times for which fixed planes perpendicular to the axes keep the pairs apart.
    #[cfg_attr(inline_kernels, inline(always))]
    pub(crate) fn fixed_plane_free_times(&self, axis: AxesX8<L>) -> f32x8<L> {
        let motion = self.motion;
        // n·(v + ω×arm) of the centers, plus the contribution of the points around them.
        let mut rate = axis.n.dot(self.velocity) + motion.rate_allowance;
        let mut second_derivative = splat(axis.n.simd_level(), LEAST_SECOND_DERIVATIVE_F32);
        if motion.split_body_rotation.is_turning {
            let m = motion.split_body_rotation.cross_angular_velocity(axis.n);
            rate += self.children.extent_along(m);
            second_derivative += second_derivative_bound(
                m,
                motion.split_body_rotation.angular_speed,
                self.rotational_speed_bounds,
            );
        }
        if motion.other_rotation.is_turning {
            let m = motion.other_rotation.cross_angular_velocity(axis.n);
            rate += self.other_node.extent_along(m);
            second_derivative += second_derivative_bound(
                m,
                motion.other_rotation.angular_speed,
                self.other_rotational_speed_bound,
            );
        }
        let apart = axis.across.gap - motion.required_gap;
        if let Some(acceleration) = motion.acceleration {
            let along = axis.n.dot(Vec3x8::splat(axis.n.simd_level(), acceleration));
            let rounding = splat(axis.n.simd_level(), RATE_ERROR_F32 * acceleration.length());
            clock::free_time_decelerating(
                apart,
                motion.closed_gap_threshold,
                rate,
                second_derivative + along + rounding,
            )
        } else if motion.split_body_rotation.is_turning || motion.other_rotation.is_turning {
            clock::free_time(apart, motion.closed_gap_threshold, rate, second_derivative)
        } else {
            clock::free_time_at_constant_rate(apart, motion.closed_gap_threshold, rate)
        }
    }
}

/// Returns an upper bound of the second derivative of heights along `n`, for points that turn at an angular speed
/// `rate` and move at `speed` at most; `m` is `n × ω`.
#[inline(always)]
pub(crate) fn second_derivative_bound<L: Simd>(
    m: Vec3x8<L>,
    rate: f32,
    speed: f32x8<L>,
) -> f32x8<L> {
    (m.length() * SECOND_DERIVATIVE_FACTOR_F32 + CROSS_PRODUCT_ERROR_F32 * rate) * speed
}

/// The angular velocity of a body, with its center of rotation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyRotation {
    /// False for a body without rotation; the other fields are not used then.
    pub(crate) is_turning: bool,
    pub(crate) spin: Vec3,
    /// The angular speed `|ω|`, rounded up.
    pub(crate) angular_speed: f32,
    /// The position of a point on the axis of rotation.
    pub(crate) rotation_center: Vec3,
}

impl BodyRotation {
    /// The rotation of a body that does not turn.
    pub(crate) const NO_ROTATION: BodyRotation = BodyRotation {
        is_turning: false,
        spin: Vec3::ZERO,
        angular_speed: 0.0,
        rotation_center: Vec3::ZERO,
    };

    /// Returns the velocities of points due to rotation, `ω × (x − center)`.
    #[inline(always)]
    pub(crate) fn rotational_velocity<L: Simd>(&self, x: Vec3x8<L>) -> Vec3x8<L> {
        let level = x.simd_level();
        if self.is_turning {
            Vec3x8::splat(level, self.spin).cross(x - Vec3x8::splat(level, self.rotation_center))
        } else {
            Vec3x8::splat(level, Vec3::ZERO)
        }
    }

    /// Returns the cross products `n × ω`.
    #[inline(always)]
    pub(crate) fn cross_angular_velocity<L: Simd>(&self, n: Vec3x8<L>) -> Vec3x8<L> {
        if self.is_turning {
            n.cross(Vec3x8::splat(n.simd_level(), self.spin))
        } else {
            Vec3x8::splat(n.simd_level(), Vec3::ZERO)
        }
    }

    /// Returns the distances of points from the center of rotation.
    #[inline(always)]
    pub(crate) fn distances_from_center<L: Simd>(&self, x: Vec3x8<L>) -> f32x8<L> {
        (x - Vec3x8::splat(x.simd_level(), self.rotation_center)).length()
    }

    /// Returns the distance of a point from the center of rotation; 0 without rotation.
    #[inline(always)]
    pub(crate) fn distance_from_center(&self, x: Vec3) -> f32 {
        if self.is_turning {
            (x - self.rotation_center).length()
        } else {
            0.0
        }
    }
}
