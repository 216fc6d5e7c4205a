//! The part of a trajectory from a later time on, with times counted from there.

use ccd_core::rounding::UNIT_ROUNDOFF_F64;
use ccd_core::vector::length;
use ccd_core::{DeviationBound, InputError, Movement, Stretch, Trajectory};

/// A trajectory whose time 0 is a given time of another trajectory.
pub(super) struct TimeShiftedTrajectory<'a> {
    pub(super) unshifted_movement: Movement<'a>,
    pub(super) from: f64,
}

impl Trajectory for TimeShiftedTrajectory<'_> {
    fn stretch_between(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
        let [first, last] = [from, to].map(|time| self.from + time);
        let stretch = self.unshifted_movement.stretch_between(first, last)?;
        // Times are rounded, so that the body is off by its displacement in the rounding error.
        let time_error = 4.0 * UNIT_ROUNDOFF_F64 * last;
        let speed =
            length(stretch.motion.velocity()) + length(stretch.acceleration) * (last - first);
        let rounding = DeviationBound {
            center_deviation: speed * time_error,
            max_deviation_angle: length(stretch.motion.angular_velocity()) * time_error,
        };
        Ok(Stretch {
            deviation_bound: stretch.deviation_bound + rounding,
            ..stretch
        })
    }

    fn velocity_jump_time(&self, from: f64, to: f64) -> Option<f64> {
        let corner = self
            .unshifted_movement
            .velocity_jump_time(self.from + from, self.from + to)?;
        Some(corner - self.from)
    }
}
