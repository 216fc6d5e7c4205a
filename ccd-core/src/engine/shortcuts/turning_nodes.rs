//! Computes for how long planes that turn with one of the bodies keep pairs of nodes apart.
//!
//! For a fixed plane the full speed of a turning body's far rim counts, however small the other body is. For a plane
//! that turns with the body it does not count: the body's own extent along the plane's normal is constant, and only
//! the other node sweeps towards the plane.
//!
//! With `n' = ω×n` and `d` from the turning body's center to a point of the other node, the height
//! `f = n·d` has `f' = n·ḋ − (n×ω)·d` and, over a time of at most `H`, `|f''| ≤ |n×ω|(|ω|(|d| + |ḋ|
//! H) + 2|ḋ|) + |d̈|`. Where the centers accelerate, that is part of `d̈`.

use crate::engine::nodes::axis::AxesX8;
use crate::engine::nodes::clock;
use crate::engine::nodes::eight_pairs::{EightPairs, second_derivative_bound};
use crate::engine::nodes::shape::{Children, OtherNode};
use crate::math::simd::{Vec3x8, splat};
use crate::rounding::{LEAST_SECOND_DERIVATIVE_F32, RATE_ERROR_F32, SECOND_DERIVATIVE_FACTOR_F32};
use crate::tuning::MAX_TURNING_PLANE_TIME;
use fearless_simd::{Simd, f32x8, prelude::*};

/// The motion of a node relative to a plane that turns with the other body, for eight pairs of nodes at once.
struct NodeMotionToTurningPlane<L: Simd> {
    /// An upper bound of the rate at which the node's points approach the plane. It is the rate `n·(v_S − v_O)` at the
    /// node's center, with both velocities taken at that point, plus a bound for the points around it.
    approach_rate_bound: f32x8<L>,
    /// The largest distance of the node's points from the center of the body that the plane turns with.
    max_distance_from_center: f32x8<L>,
    /// An upper bound of the speeds of the node's points due to the rotation of the node's own body.
    rotational_speed_bound: f32x8<L>,
    /// The angular speed `|ω|` of the node's own body.
    own_angular_speed: f32,
}

impl<L: Simd, C: Children, P: OtherNode> EightPairs<'_, L, C, P> {
    /// Returns times for which planes that turn with the body of the split node certainly keep the eight pairs apart.
    #[cfg_attr(inline_kernels, inline(always))]
    pub(crate) fn free_times_turning_with_split_body(&self, axis: AxesX8<L>) -> f32x8<L> {
        let (motion, other) = (self.motion, self.other_node);
        let level = axis.n.simd_level();
        let at = Vec3x8::splat(level, other.center());
        let velocity = Vec3x8::splat(level, motion.velocity);
        let velocity = velocity + motion.split_body_rotation.rotational_velocity(at)
            - self.other_rotational_velocity;
        let across = motion.split_body_rotation.cross_angular_velocity(axis.n);
        let own = motion.other_rotation.cross_angular_velocity(axis.n);
        self.turning_plane_free_time(
            axis,
            second_derivative_bound(
                across,
                motion.split_body_rotation.angular_speed,
                splat(level, 1.0),
            ),
            motion.split_body_rotation.angular_speed,
            &NodeMotionToTurningPlane {
                approach_rate_bound: axis.n.dot(velocity) + other.extent_along(own - across),
                max_distance_from_center: motion.split_body_rotation.distances_from_center(at)
                    + other.radius(),
                rotational_speed_bound: self.other_rotational_speed_bound,
                own_angular_speed: motion.other_rotation.angular_speed,
            },
        )
    }

    /// Returns times for which planes that turn with the body of the unsplit node certainly keep the eight pairs apart.
    #[cfg_attr(inline_kernels, inline(always))]
    pub(crate) fn free_times_of_planes_turning_with_other(&self, axis: AxesX8<L>) -> f32x8<L> {
        let (motion, children) = (self.motion, self.children);
        let level = axis.n.simd_level();
        let at = children.center(level);
        let velocity = Vec3x8::splat(level, motion.velocity);
        let velocity = velocity + motion.split_body_rotation.rotational_velocity(at)
            - motion.other_rotation.rotational_velocity(at);
        let across = motion.other_rotation.cross_angular_velocity(axis.n);
        let own = motion.split_body_rotation.cross_angular_velocity(axis.n);
        self.turning_plane_free_time(
            axis,
            second_derivative_bound(
                across,
                motion.other_rotation.angular_speed,
                splat(level, 1.0),
            ),
            motion.other_rotation.angular_speed,
            &NodeMotionToTurningPlane {
                approach_rate_bound: axis.n.dot(velocity) + children.extent_along(own - across),
                max_distance_from_center: motion.other_rotation.distances_from_center(at)
                    + children.radius(level),
                rotational_speed_bound: self.rotational_speed_bounds,
                own_angular_speed: motion.split_body_rotation.angular_speed,
            },
        )
    }

    #[cfg_attr(inline_kernels, inline(always))]
    fn turning_plane_free_time(
        &self,
        axis: AxesX8<L>,
        across: f32x8<L>,
        spin: f32,
        sweep: &NodeMotionToTurningPlane<L>,
    ) -> f32x8<L> {
        let motion = self.motion;
        let change = match motion.acceleration {
            Some(acceleration) => acceleration.length() * SECOND_DERIVATIVE_FACTOR_F32,
            None => 0.0,
        };
        let straight = motion.velocity.length() + change + motion.rate_allowance;
        let speed = sweep.rotational_speed_bound + straight;
        let far = sweep.max_distance_from_center + speed * MAX_TURNING_PLANE_TIME;
        let second_derivative = across * (far * spin + speed * 2.0)
            + sweep.rotational_speed_bound * sweep.own_angular_speed
            + change;
        // Each sweep happens at the distance of its node from the turning body's center.
        let rate_slack =
            sweep.max_distance_from_center * (RATE_ERROR_F32 * spin) + motion.rate_allowance;
        let free = clock::free_time(
            axis.across.gap - motion.required_gap,
            motion.closed_gap_threshold,
            sweep.approach_rate_bound + rate_slack,
            second_derivative * SECOND_DERIVATIVE_FACTOR_F32 + LEAST_SECOND_DERIVATIVE_F32,
        );
        free.min(MAX_TURNING_PLANE_TIME)
    }
}
