//! The trajectory of a thrown body.

use super::U;
use super::checks::check_finite_vector;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::vector::length;
use ccd_core::{
    Acceleration, AccelerationBounds, DeviationBound, InputError, Motion, Pose, SmoothTrajectory,
};

/// A thrown body: its center has constant acceleration, and the body rotates about it at a constant rate.
///
/// The center's place is `C + v t + a t²/2`. Its acceleration is constant: a stretch of any length is the
/// trajectory itself.
///
/// ```
/// use rigid_ccd::trajectory::{Ballistic, Trajectory};
/// use rigid_ccd::{Motion, Pose};
/// let thrown = Motion::new(Pose::IDENTITY, [3.0, 0.0, 4.0], [0.0, 9.0, 0.0])?;
/// let ball = Ballistic::new(thrown, [0.0, 0.0, -9.81])?;
/// let lands = ball.pose(2.0 * 4.0 / 9.81)?.translation();
/// assert!(lands.z.abs() < 1e-12 && lands.x > 2.4);
/// # Ok::<(), rigid_ccd::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ballistic {
    initial_motion: Motion,
    acceleration: DVec3,
}

impl Ballistic {
    /// Creates the trajectory of a body thrown at time 0 with the pose and the velocities of a motion.
    ///
    /// # Errors
    /// [`InputError::NotFinite`].
    pub fn new(thrown: Motion, acceleration: impl Into<[f64; 3]>) -> Result<Self, InputError> {
        Ok(Ballistic {
            initial_motion: thrown,
            acceleration: check_finite_vector(acceleration, "acceleration")?,
        })
    }
}

impl SmoothTrajectory for Ballistic {
    fn tangent_motion(&self, time: f64) -> Result<Motion, InputError> {
        let (thrown, acceleration) = (&self.initial_motion, self.acceleration);
        let pose = thrown.pose(time);
        let fallen = pose.translation() + 0.5 * time * (time * acceleration);
        let start = Pose::new(fallen, pose.rotation())?;
        let velocity = thrown.velocity() + time * acceleration;
        Motion::about(start, velocity, thrown.angular_velocity(), thrown.center())
    }

    fn acceleration_bounds(&self, _: f64, _: f64) -> AccelerationBounds {
        AccelerationBounds {
            linear_acceleration: length(self.acceleration),
            angular_acceleration: 0.0,
        }
    }

    fn osculating_motion(
        &self,
        time: f64,
        _: f64,
        _: f64,
    ) -> Result<(Motion, Option<Acceleration>), InputError> {
        let acceleration = Acceleration {
            acceleration_vector: self.acceleration,
            jerk_bound: 0.0,
        };
        Ok((self.tangent_motion(time)?, Some(acceleration)))
    }

    /// Bounds the rounding errors of poses between two times.
    fn rounding(&self, from: f64, to: f64) -> DeviationBound {
        let (thrown, acceleration) = (&self.initial_motion, self.acceleration);
        let time = greater(from.abs(), to.abs());
        let turned = length(thrown.angular_velocity()) * time;
        let way = (length(thrown.velocity()) + 0.5 * time * length(acceleration)) * time;
        DeviationBound {
            center_deviation: 16.0 * U * (length(thrown.start().translation()) + way),
            max_deviation_angle: 8.0 * U * turned,
        }
    }
}
