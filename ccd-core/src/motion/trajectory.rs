//! Motions of any kind, approximated by stretches of constant velocities with a bound of the deviation.

use super::Motion;
use super::pose::Pose;
use crate::error::InputError;
use crate::math::componentwise::impl_componentwise;
use crate::math::order::greater;
use crate::math::vector::length;
use crate::rounding::RETIMED_POSE_ERROR_F64;
use glam::DVec3;

/// A motion of any kind that is near a [`Motion`] between any two times, up to a known deviation.
///
/// A query covers the time with stretches, long ones first. It requests shorter ones if the answer depends on it. The
/// bounds have to shrink with the length of the stretch: with its square if the motion is smooth.
///
/// Implement [`SmoothTrajectory`] instead, if velocities and bounds of accelerations are known.
///
/// ```
/// use ccd_core::{glam::DVec3, InputError, Motion, Pose, DeviationBound, Stretch, Trajectory};
///
/// /// Swings along x by the cosine of the time.
/// struct Swing;
///
/// impl Trajectory for Swing {
///     fn stretch_between(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
///         let at = |t: f64| Pose::at(t.cos() * DVec3::X);
///         let time = to - from;
///         let motion = match time > 0.0 {
///             true => Motion::between(at(from)?, at(to)?, DVec3::ZERO, time)?,
///             false => Motion::still(at(from)?),
///         };
///         // A chord is off by at most an eighth of the square of its time, times the acceleration.
///         let deviation_bound = DeviationBound { center_deviation: time * time / 8.0 + 1e-15, max_deviation_angle: 0.0 };
///         Ok(Stretch { deviation_bound, ..Stretch::exact(motion) })
///     }
/// }
///
/// let stretch = Swing.stretch_between(1.0, 1.5)?;
/// let middle = stretch.motion.pose(0.25).translation();
/// assert!((middle.x - 1.25f64.cos()).abs() <= stretch.deviation_bound.center_deviation);
/// # Ok::<(), InputError>(())
/// ```
pub trait Trajectory: Sync {
    /// Returns a motion near this trajectory between two times, which may be equal.
    ///
    /// # Errors
    /// An [`InputError`] if there is no motion between these times.
    fn stretch_between(&self, from: f64, to: f64) -> Result<Stretch, InputError>;

    /// Returns a time between two others at which a velocity jumps; `None` if there is none. Stretches that end there
    /// have better bounds. If there are several, the best one is near the middle.
    fn velocity_jump_time(&self, from: f64, to: f64) -> Option<f64> {
        let _ = (from, to);
        None
    }

    /// Returns the motion if the trajectory is a single motion over all time; otherwise `None`. Queries about two
    /// motions are answered at once, instead of stretch by stretch.
    fn as_motion(&self) -> Option<Motion> {
        None
    }

    /// Returns the pose at a time, with the accuracy of a stretch of no length.
    ///
    /// # Errors
    /// The errors of [`Trajectory::stretch_between`].
    fn pose(&self, time: f64) -> Result<Pose, InputError> {
        Ok(self.stretch_between(time, time)?.motion.start())
    }
}

/// A motion that approximates a trajectory between two times, with an acceleration of the center and a bound of the
/// deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// The approximate motion; its time 0 is the start of the stretch.
    pub motion: Motion,
    /// The constant acceleration of the motion's center. After a time `t` it displaces all points by another
    /// `acceleration · t²/2`.
    pub acceleration: DVec3,
    /// A bound of the trajectory's deviation from the accelerated motion.
    pub deviation_bound: DeviationBound,
}

impl Stretch {
    /// Creates a stretch in which the trajectory equals the motion.
    pub fn exact(motion: Motion) -> Self {
        Stretch {
            motion,
            acceleration: DVec3::ZERO,
            deviation_bound: DeviationBound::ZERO,
        }
    }

    /// Returns the pose of the accelerated motion at a time after the start of the stretch. The trajectory may deviate
    /// from it.
    pub fn pose(&self, time: f64) -> Pose {
        let pose = self.motion.pose(time);
        if self.acceleration == DVec3::ZERO {
            pose
        } else {
            pose.translated(0.5 * time * (time * self.acceleration))
        }
    }

    /// Returns the velocity, in the accelerated motion, of the body's point that is at the position `x` after a time.
    /// The trajectory may deviate from it.
    pub(crate) fn velocity_at(&self, x: DVec3, time: f64) -> DVec3 {
        let motion = &self.motion;
        let arm = x - self.pose(time).transform_point(motion.center());
        motion.velocity() + time * self.acceleration + motion.angular_velocity().cross(arm)
    }

    /// Returns the stretch with its time 0 moved to `at`, up to rounding.
    ///
    /// # Errors
    /// [`InputError::NotFinite`].
    pub(crate) fn with_time_origin(&self, at: f64) -> Result<Stretch, InputError> {
        let pose = self.pose(at);
        // The pose is checked, and its quaternion normalised once more.
        let start = Pose::new(pose.translation(), pose.rotation())?;
        let motion = &self.motion;
        let velocity = motion.velocity() + at * self.acceleration;
        Ok(Stretch {
            motion: Motion::about(start, velocity, motion.angular_velocity(), motion.center())?,
            ..*self
        })
    }

    /// Returns a bound of the rounding error of the pose when [`Stretch::with_time_origin`] moves the start by a time.
    pub(crate) fn rounding_of_moved_start(&self, time: f64) -> DeviationBound {
        let Stretch { motion, .. } = self;
        let turned = length(motion.angular_velocity()) * time.abs();
        let speed = length(motion.velocity()) + length(self.acceleration) * time.abs();
        let place = length(motion.start().translation()) + 2.0 * length(motion.center());
        DeviationBound {
            center_deviation: RETIMED_POSE_ERROR_F64 * (place + speed * time.abs()),
            max_deviation_angle: RETIMED_POSE_ERROR_F64 * (1.0 + turned),
        }
    }
}

/// Bounds of the deviation between two motions of a body, in position and orientation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DeviationBound {
    /// An upper bound of the distance between the center's positions in both motions at the same time, in the scene's
    /// unit of length.
    pub center_deviation: f64,
    /// The largest angle between the two orientations, in radians.
    pub max_deviation_angle: f64,
}

impl DeviationBound {
    /// The deviation of a motion from itself, which is zero.
    pub const ZERO: DeviationBound = DeviationBound {
        center_deviation: 0.0,
        max_deviation_angle: 0.0,
    };

    /// Returns a bound of the deviation of a point that is at most `reach` from the motion's center.
    pub fn at_reach(&self, reach: f64) -> f64 {
        let DeviationBound {
            center_deviation: shift,
            max_deviation_angle: turn,
        } = *self;
        if turn > 0.0 {
            shift + turn * reach
        } else if turn == 0.0 {
            // Without a turn the bound is exact for any `reach`.
            shift
        } else {
            // A value that is no bound becomes NaN.
            f64::NAN
        }
    }
}

impl_componentwise!(Add::add for DeviationBound { center_deviation, max_deviation_angle });

/// A trajectory without jumps of its velocities, given by bounds of its accelerations.
///
/// Between two times it is near the motion with the velocities of the middle, `m`. With bounds `a` and `α` of the
/// accelerations, `|x(t) − x(m) − v(m) (t − m)| ≤ a (t − m)²/2`, and the angle between both orientations is at
/// most `∫ |ω(s) − ω(m)| ds ≤ α (t − m)²/2`: the rotation that takes one to the other turns at the
/// difference of their angular velocities.
///
/// If the linear acceleration of the middle is known as well, and a bound `j` of its rate of change, the center
/// deviates by at most `j |t − m|³/6` from the motion with that acceleration. That shrinks faster with the time:
/// bodies that pass each other closely take no more stretches than others do.
///
/// ```
/// use ccd_core::{
///     glam::DVec3, AccelerationBounds, DeviationBound, InputError, Motion, Pose, SmoothTrajectory, Trajectory,
/// };
///
/// /// Swings along x by the cosine of the time.
/// struct Swing;
///
/// impl SmoothTrajectory for Swing {
///     fn tangent_motion(&self, time: f64) -> Result<Motion, InputError> {
///         Motion::new(Pose::at(time.cos() * DVec3::X)?, -time.sin() * DVec3::X, DVec3::ZERO)
///     }
///     fn acceleration_bounds(&self, _from: f64, _to: f64) -> AccelerationBounds {
///         AccelerationBounds { linear_acceleration: 1.0, angular_acceleration: 0.0 }
///     }
/// }
///
/// let stretch = Swing.stretch_between(1.0, 1.5)?;
/// let DeviationBound { center_deviation, max_deviation_angle } = stretch.deviation_bound;
/// assert!(center_deviation > 0.03 && center_deviation < 0.04 && max_deviation_angle < 1e-13);
/// # Ok::<(), InputError>(())
/// ```
pub trait SmoothTrajectory: Sync {
    /// Returns the motion with the trajectory's pose and velocities at a time, which is the motion's time 0.
    ///
    /// The linear velocity is that of the motion's [center](Motion::center).
    ///
    /// # Errors
    /// An [`InputError`] if there is no pose at that time.
    fn tangent_motion(&self, time: f64) -> Result<Motion, InputError>;

    /// Returns upper bounds of the magnitudes of the accelerations between two times.
    fn acceleration_bounds(&self, from: f64, to: f64) -> AccelerationBounds;

    /// Returns the tangent motion at a time, with the acceleration of its center and a bound of the acceleration's
    /// derivative between two times. The acceleration is `None` if it is unknown or its derivative is unbounded.
    ///
    /// # Errors
    /// The errors of the motion.
    fn osculating_motion(
        &self,
        time: f64,
        from: f64,
        to: f64,
    ) -> Result<(Motion, Option<Acceleration>), InputError> {
        let _ = (from, to);
        Ok((self.tangent_motion(time)?, None))
    }

    /// Returns bounds of the errors of tangent poses between two times. They matter if they exceed about 40 units in
    /// the last place, of lengths and of a radian.
    fn rounding(&self, from: f64, to: f64) -> DeviationBound {
        let _ = (from, to);
        DeviationBound::ZERO
    }

    /// Returns a time between two others at which an acceleration jumps; `None` if there is none. Stretches that end
    /// there have better bounds.
    fn acceleration_jump_time(&self, from: f64, to: f64) -> Option<f64> {
        let _ = (from, to);
        None
    }
}

/// Upper bounds of the magnitudes of a trajectory's accelerations, per unit of time squared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AccelerationBounds {
    /// A bound of the acceleration of the body's center, the point whose velocity `tangent_motion` gives, in the
    /// scene's unit of length.
    pub linear_acceleration: f64,
    /// A bound of the angular acceleration in radians, which is the derivative of the angular velocity.
    pub angular_acceleration: f64,
}

/// The linear acceleration at a time, and a bound of its rate of change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Acceleration {
    /// The acceleration vector, in the scene's unit of length per unit of time squared.
    pub acceleration_vector: DVec3,
    /// A bound of the magnitude of the acceleration's derivative, in the scene's unit of length per unit of time cubed.
    pub jerk_bound: f64,
}

impl Acceleration {
    /// Returns a bound of the center's deviation after a time from the motion with this constant acceleration.
    fn deviation_bound_after(self, time: f64) -> f64 {
        // The vector, the time and the products are rounded.
        let rounding = RETIMED_POSE_ERROR_F64 * (time * (time * length(self.acceleration_vector)));
        time * (time * (time * self.jerk_bound)) / 6.0 * (1.0 + RETIMED_POSE_ERROR_F64) + rounding
    }
}

impl AccelerationBounds {
    /// Returns bounds of a body's deviation from its tangent motion after a time, if its accelerations are within these
    /// bounds.
    fn deviation_bound_after(self, time: f64) -> DeviationBound {
        // The time and the products are rounded. The square of a short time may be zero, so none is computed.
        let deviation = |acceleration: f64| {
            0.5 * (time * (time * acceleration)) * (1.0 + RETIMED_POSE_ERROR_F64)
        };
        DeviationBound {
            center_deviation: deviation(self.linear_acceleration),
            max_deviation_angle: deviation(self.angular_acceleration),
        }
    }
}

impl<S: SmoothTrajectory + ?Sized> Trajectory for S {
    fn stretch_between(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
        // Times far from 0 have no exact middle: the halves differ.
        let middle = from + 0.5 * (to - from);
        let [before, after] = [middle - from, to - middle];
        let half = greater(before, after);
        let (motion, acceleration) = self.osculating_motion(middle, from, to)?;
        let mut tangent = Stretch::exact(motion);
        // Bounds of a stretch of no length may be infinite.
        if half > 0.0 {
            tangent.deviation_bound = self
                .acceleration_bounds(from, to)
                .deviation_bound_after(half);
            if let Some(acceleration) = acceleration
                && acceleration.deviation_bound_after(half)
                    < tangent.deviation_bound.center_deviation
            {
                tangent.acceleration = acceleration.acceleration_vector;
                tangent.deviation_bound.center_deviation = acceleration.deviation_bound_after(half);
            }
        }
        let stretch = tangent.with_time_origin(-before)?;
        let rounding = stretch.rounding_of_moved_start(half) + self.rounding(from, to);
        Ok(Stretch {
            deviation_bound: stretch.deviation_bound + rounding,
            ..stretch
        })
    }

    fn velocity_jump_time(&self, from: f64, to: f64) -> Option<f64> {
        SmoothTrajectory::acceleration_jump_time(self, from, to)
    }
}

/// A motion as a trajectory: the motion itself is each of its stretches. Stretches that do not begin at time 0 are off
/// by rounding.
impl Trajectory for Motion {
    fn as_motion(&self) -> Option<Motion> {
        Some(*self)
    }

    fn stretch_between(&self, from: f64, _to: f64) -> Result<Stretch, InputError> {
        if from == 0.0 {
            return Ok(Stretch::exact(*self));
        }
        let stretch = Stretch::exact(*self).with_time_origin(from)?;
        let stray = stretch.rounding_of_moved_start(from);
        Ok(Stretch {
            deviation_bound: stray,
            ..stretch
        })
    }
}

#[cfg(test)]
mod tests;
