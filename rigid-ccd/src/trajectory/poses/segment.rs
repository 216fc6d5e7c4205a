//! The segment of a path from one pose to the next.

use ccd_core::glam::{DQuat, DVec3};
use ccd_core::vector::length;
use ccd_core::{InputError, Motion, Pose, shortest_rotation_vector};
use std::f64::consts::FRAC_PI_2;

/// The segment from one pose to the next: a motion at constant rates, and a correction that makes the rotation end at
/// the next orientation.
///
/// With a rotation vector `w` of the motion and a shortest one `e` that leads from its end to the next pose, the
/// orientation after a share `s` is `exp(s e) exp(s w)` times the first one.
pub(super) struct Segment {
    motion: Motion,
    /// The rotation vector `e` from the motion's last orientation to that of the next pose, divided by the duration.
    leftover_spin: DVec3,
}

/// The largest allowed correction of a segment's rotation, in radians: at half a turn, the number of turns would be
/// ambiguous.
pub(crate) const MAX_RESIDUAL_ROTATION: f64 = FRAC_PI_2;

impl Segment {
    /// Creates the segment with the number of turns nearest to what the angular velocity `spin` makes; a zero `spin` asks for the
    /// shortest rotation.
    pub(super) fn new(
        [from, to]: [Pose; 2],
        center: DVec3,
        duration: f64,
        spin: DVec3,
    ) -> Result<Self, InputError> {
        if spin == DVec3::ZERO {
            return Ok(Segment {
                motion: Motion::between(from, to, center, duration)?,
                leftover_spin: DVec3::ZERO,
            });
        }
        let way = to.transform_point(center) - from.transform_point(center);
        Ok(Segment {
            motion: Motion::about(from, way / duration, spin, center)?,
            leftover_spin: residual_rotation([&from, &to], spin, duration) / duration,
        })
    }

    /// Returns the motion that starts with the segment's pose and velocities at `time`. The time is counted from the
    /// segment's first pose.
    pub(super) fn motion_at(&self, time: f64) -> Result<Motion, InputError> {
        let (motion, leftover_spin) = (&self.motion, self.leftover_spin);
        if time == 0.0 && leftover_spin == DVec3::ZERO {
            return Ok(*motion);
        }
        let (near, center) = (motion.pose(time), motion.center());
        let (pose, spin) = if leftover_spin == DVec3::ZERO {
            (near, motion.angular_velocity())
        } else {
            let turn = DQuat::from_scaled_axis(leftover_spin * time);
            let rotation = turn * near.rotation();
            let place = near.transform_point(center) - rotation * center;
            (
                Pose::new(place, rotation)?,
                leftover_spin + turn * motion.angular_velocity(),
            )
        };
        Motion::about(pose, motion.velocity(), spin, center)
    }

    /// Returns a bound on the angular acceleration. The angular velocity is `e + exp(s e) w`, per unit of time.
    pub(super) fn angular_acceleration(&self) -> f64 {
        length(self.leftover_spin) * length(self.motion.angular_velocity())
    }
}

/// Returns the rotation that is left over after rotating `from` at `spin` for `duration`: the shortest rotation vector
/// to the orientation of `to`.
pub(crate) fn residual_rotation([from, to]: [&Pose; 2], spin: DVec3, duration: f64) -> DVec3 {
    let led = DQuat::from_scaled_axis(spin * duration) * from.rotation();
    shortest_rotation_vector(to.rotation() * led.conjugate())
}
