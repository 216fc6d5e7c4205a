//! Computes the position of a moving body at an instant, to within intervals.

use super::enclosure::{IntervalMatrix, IntervalVector};
use super::interval::point_interval;
use super::rounding::{FORTY_ROUNDINGS_ERROR, ROUND_UP_FACTOR, nan_propagating_max};
use super::surface::Surface;
use ccd_core::Motion;
use ccd_core::glam::{DMat3, DVec3};

/// The motion of a body in intervals: x(t) = c₀ + v t + R(ω t) R₀ (p − c).
#[derive(Clone, Debug)]
pub(super) struct EnclosedMotion {
    /// The center of rotation c, in the body's frame.
    pub(super) center: IntervalVector,
    /// The velocity v of the center, in the world frame.
    pub(super) velocity: IntervalVector,
    /// The angular velocity ω, in the world frame.
    pub(super) spin: IntervalVector,
    /// The angular velocity ω as floats.
    spin_floats: DVec3,
    /// The orientation R₀ at the start.
    orientation: IntervalMatrix,
    /// The position c₀ of the center at the start, in the world frame.
    start_center: IntervalVector,
    /// An upper bound of the distance of the body's points from the center c.
    pub(super) max_distance_from_center: f64,
    /// An upper bound |ω|²ρ of the acceleration of the point that is farthest from the axis, at distance ρ.
    pub(super) max_acceleration: f64,
}

/// The placement of a body at an instant: x = `center` + `rotation` (p − c).
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement {
    pub(super) rotation: IntervalMatrix,
    pub(super) center: IntervalVector,
}

impl EnclosedMotion {
    pub(super) fn new(motion: &Motion, surface: &Surface) -> Self {
        let start = motion.start();
        let orientation = IntervalMatrix::from_quaternion(start.rotation());
        let center = IntervalVector::from(motion.center());
        let mut track = EnclosedMotion {
            center,
            velocity: IntervalVector::from(motion.velocity()),
            spin: IntervalVector::from(motion.angular_velocity()),
            spin_floats: motion.angular_velocity(),
            start_center: IntervalVector::from(start.translation()) + &orientation * &center,
            orientation,
            max_distance_from_center: 0.0,
            max_acceleration: 0.0,
        };
        // The axis is fixed in the body's frame. The distance from it is convex there, so it is
        // largest at a corner of the box around the body.
        let axis = DMat3::from_quat(start.rotation()).transpose() * motion.angular_velocity();
        let rate = motion.angular_velocity().length();
        for corner in surface.box_corners() {
            let arm = corner - motion.center();
            track.max_distance_from_center = nan_propagating_max(
                track.max_distance_from_center,
                arm.length() * ROUND_UP_FACTOR,
            );
            // The sum covers the rounding of the cross product, which is relative to its factors.
            let speed = axis.cross(arm).length() + FORTY_ROUNDINGS_ERROR * rate * arm.length();
            track.max_acceleration =
                nan_propagating_max(track.max_acceleration, rate * speed * ROUND_UP_FACTOR);
        }
        track
    }

    pub(super) fn placement_at(&self, time: f64) -> Placement {
        Placement {
            rotation: &IntervalMatrix::rotation_after(self.spin_floats, time) * &self.orientation,
            center: self.start_center + self.velocity.scaled(point_interval(time)),
        }
    }
}
