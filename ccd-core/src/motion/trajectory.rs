//! Motions of any kind, as stretches of the paper's motion that they stray from by a known amount.

use super::Motion;
use super::pose::Pose;
use crate::error::InputError;
use crate::math::order::greater;
use crate::math::vector::length;
use crate::tolerance::STRETCH_F64;

/// A motion of any kind: between any two times it is near a [`Motion`], by a bound that it knows.
///
/// A query covers the time with stretches, long ones first. It takes shorter ones where the answer depends
/// on it, so that bounds have to shrink with the stretch: with its square where the motion is smooth.
///
/// Implement [`Smooth`] instead, if velocities and bounds of accelerations are known.
///
/// ```
/// use ccd_core::{glam::DVec3, InputError, Motion, Pose, Stray, Stretch, Trajectory};
///
/// /// Swings along x by the cosine of the time.
/// struct Swing;
///
/// impl Trajectory for Swing {
///     fn stretch(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
///         let at = |t: f64| Pose::at(t.cos() * DVec3::X);
///         let time = to - from;
///         let motion = match time > 0.0 {
///             true => Motion::between(at(from)?, at(to)?, DVec3::ZERO, time)?,
///             false => Motion::still(at(from)?),
///         };
///         // A chord is off by at most an eighth of the square of its time, times the acceleration.
///         let stray = Stray { shift: time * time / 8.0 + 1e-15, turn: 0.0 };
///         Ok(Stretch { motion, stray })
///     }
/// }
///
/// let stretch = Swing.stretch(1.0, 1.5)?;
/// let middle = stretch.motion.pose(0.25).translation();
/// assert!((middle.x - 1.25f64.cos()).abs() <= stretch.stray.shift);
/// # Ok::<(), InputError>(())
/// ```
pub trait Trajectory {
    /// Returns a motion near this one from a time to a later one, or the same.
    ///
    /// # Errors
    /// An [`InputError`] if there is no motion between these times.
    fn stretch(&self, from: f64, to: f64) -> Result<Stretch, InputError>;

    /// Returns a time between two others, if there is one, at which a velocity jumps: bounds of stretches
    /// that end there are better. If there are several, one about the middle is best.
    fn corner(&self, from: f64, to: f64) -> Option<f64> {
        let _ = (from, to);
        None
    }

    /// Returns the pose at a time, up to what the stretch of no length strays.
    ///
    /// # Errors
    /// Those of [`Trajectory::stretch`].
    fn pose(&self, time: f64) -> Result<Pose, InputError> {
        Ok(self.stretch(time, time)?.motion.start())
    }
}

/// A motion near a trajectory between two times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// The motion; its time 0 is the first of the two.
    pub motion: Motion,
    /// How far the trajectory strays from it.
    pub stray: Stray,
}

impl Stretch {
    /// Creates a stretch of a trajectory that is the motion itself.
    pub fn exact(motion: Motion) -> Self {
        Stretch {
            motion,
            stray: Stray::NONE,
        }
    }
}

/// Bounds of the difference of two motions of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stray {
    /// The largest distance between the two places of the motion's centre, a point of the body, in the
    /// scene's unit of length.
    pub shift: f64,
    /// The largest angle between the two orientations, in radians.
    pub turn: f64,
}

impl Stray {
    /// The motions are the same.
    pub const NONE: Stray = Stray {
        shift: 0.0,
        turn: 0.0,
    };

    /// Bounds the distance between the two places of a point that is no farther than `reach` from the motion's
    /// centre.
    pub fn at(&self, reach: f64) -> f64 {
        match self.turn > 0.0 {
            true => self.shift + self.turn * reach,
            false => self.shift,
        }
    }
}

impl std::ops::Add for Stray {
    type Output = Stray;

    fn add(self, other: Stray) -> Stray {
        Stray {
            shift: self.shift + other.shift,
            turn: self.turn + other.turn,
        }
    }
}

/// A trajectory without jumps of its velocities, known by bounds of its accelerations.
///
/// Between two times it is near the motion with the velocities of the middle. With bounds `a` and `α` of the
/// accelerations, `|x(t) − x(m) − v(m) (t − m)| ≤ a (t − m)²/2`, and the angle between both orientations is at
/// most `∫ |ω(s) − ω(m)| ds ≤ α (t − m)²/2`: the rotation that takes one to the other turns at the
/// difference of their angular velocities.
///
/// ```
/// use ccd_core::{glam::DVec3, Accelerations, InputError, Motion, Pose, Smooth, Trajectory};
///
/// /// Swings along x by the cosine of the time.
/// struct Swing;
///
/// impl Smooth for Swing {
///     fn tangent(&self, time: f64) -> Result<Motion, InputError> {
///         Motion::new(Pose::at(time.cos() * DVec3::X)?, -time.sin() * DVec3::X, DVec3::ZERO)
///     }
///     fn accelerations(&self, _from: f64, _to: f64) -> Accelerations {
///         Accelerations { linear: 1.0, angular: 0.0 }
///     }
/// }
///
/// let stretch = Swing.stretch(1.0, 1.5)?;
/// assert!(stretch.stray.shift > 0.03 && stretch.stray.shift < 0.04 && stretch.stray.turn < 1e-13);
/// # Ok::<(), InputError>(())
/// ```
pub trait Smooth {
    /// Returns the motion with the pose and the velocities of a time; its time 0 is that time.
    ///
    /// The linear velocity is that of the motion's [centre](Motion::centre).
    ///
    /// # Errors
    /// An [`InputError`] if there is no pose at that time.
    fn tangent(&self, time: f64) -> Result<Motion, InputError>;

    /// Bounds the lengths of the accelerations from a time to a later one.
    fn accelerations(&self, from: f64, to: f64) -> Accelerations;

    /// Bounds the errors of the poses of tangents from a time to a later one, if they are off by more than
    /// about 40 units in the last place, of their lengths and of a radian.
    fn rounding(&self, from: f64, to: f64) -> Stray {
        let _ = (from, to);
        Stray::NONE
    }

    /// Returns a time between two others, if there is one, at which an acceleration jumps: bounds of
    /// stretches that end there are better.
    fn corner(&self, from: f64, to: f64) -> Option<f64> {
        let _ = (from, to);
        None
    }
}

/// Bounds of the lengths of accelerations, per unit of time squared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Accelerations {
    /// Of the tangents' centre, in the scene's unit of length.
    pub linear: f64,
    /// Of the orientation, in radians: the length of the derivative of the angular velocity.
    pub angular: f64,
}

impl Accelerations {
    /// Bounds what they add up to in a time, from a tangent on.
    fn over(self, time: f64) -> Stray {
        // The time and the products are rounded.
        let square = 0.5 * time * time * (1.0 + STRETCH_F64);
        Stray {
            shift: self.linear * square,
            turn: self.angular * square,
        }
    }
}

impl<S: Smooth + ?Sized> Trajectory for S {
    fn stretch(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
        // Times far from 0 have no middle: the halves differ.
        let middle = from + 0.5 * (to - from);
        let [before, after] = [middle - from, to - middle];
        let motion = self.tangent(middle)?.started(-before)?;
        let half = greater(before, after);
        // Bounds of a stretch of no length may be infinite.
        let curved = match half > 0.0 {
            true => self.accelerations(from, to).over(half),
            false => Stray::NONE,
        };
        let rounding = motion.rounding_of_start(half) + self.rounding(from, to);
        Ok(Stretch {
            motion,
            stray: curved + rounding,
        })
    }

    fn corner(&self, from: f64, to: f64) -> Option<f64> {
        Smooth::corner(self, from, to)
    }
}

/// Each stretch is the motion itself; those that do not begin at time 0 are off by rounding.
impl Trajectory for Motion {
    fn stretch(&self, from: f64, _to: f64) -> Result<Stretch, InputError> {
        if from == 0.0 {
            return Ok(Stretch::exact(*self));
        }
        let motion = self.started(from)?;
        let stray = motion.rounding_of_start(from);
        Ok(Stretch { motion, stray })
    }
}

impl Motion {
    /// Returns the motion with another time as its time 0.
    ///
    /// # Errors
    /// [`InputError::NotFinite`].
    pub(crate) fn started(&self, at: f64) -> Result<Motion, InputError> {
        let pose = self.pose(at);
        // Checked, and normalised once more.
        let start = Pose::new(pose.translation(), pose.rotation())?;
        Motion::about(start, self.velocity(), self.spin(), self.centre())
    }

    /// Bounds the error of a start that was computed for another time.
    pub(crate) fn rounding_of_start(&self, time: f64) -> Stray {
        let turned = length(self.spin()) * time.abs();
        let travel = length(self.velocity()) * time.abs();
        let place = length(self.start().translation()) + 2.0 * length(self.centre());
        Stray {
            shift: STRETCH_F64 * (place + travel),
            turn: STRETCH_F64 * (1.0 + turned),
        }
    }
}

#[cfg(test)]
mod tests;
