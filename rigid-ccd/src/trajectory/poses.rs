//! A path through given poses.

use super::U;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::order::greater;
use ccd_core::vector::length;
use ccd_core::{InputError, Motion, Pose, Stray, Stretch, Trajectory};

/// A path through poses at given times: of a planner, or of a simulator's log.
///
/// From one pose to the next, a point of the body moves straight, and the body turns about it the shortest way,
/// both at constant rates ([`Motion::between`]). The body rests before the first time and after the last.
///
/// A stretch between two poses is exact, up to rounding. A longer one is a single motion from its first to its
/// last pose. The centre is farthest from it at a pose in between. Between two poses the orientation strays at
/// most as far as both ends do, and by half the angle of the difference of both turns.
///
/// ```
/// use rigid_ccd::trajectory::{Poses, Trajectory};
/// use rigid_ccd::Pose;
/// let stops = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
/// let timed = stops.iter().zip([0.0, 1.0, 3.0]);
/// let poses = timed.map(|(&at, time)| Ok((time, Pose::at(at)?)));
/// let path = Poses::new(poses.collect::<Result<_, rigid_ccd::InputError>>()?)?;
/// assert_eq!(path.pose(2.0)?.translation().y, 0.5);
/// assert_eq!(path.corner(0.0, 3.0), Some(1.0));
/// # Ok::<(), rigid_ccd::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Poses {
    poses: Vec<(f64, Pose)>,
    centre: DVec3,
}

impl Poses {
    /// Creates a path through poses at increasing times. The body's origin moves straight.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for no pose, and for times that do not increase.
    pub fn new(poses: Vec<(f64, Pose)>) -> Result<Self, InputError> {
        let refuse = |value| {
            Err(InputError::OutOfRange {
                what: "time of a pose",
                value,
                allowed: "finite and later than the one before; at least one",
            })
        };
        if poses.is_empty() {
            return refuse(f64::NAN);
        }
        for (k, &(time, _)) in poses.iter().enumerate() {
            // Written so that NaN is refused.
            if !(time.is_finite() && (k == 0 || time > poses[k - 1].0)) {
                return refuse(time);
            }
        }
        Ok(Poses {
            poses,
            centre: DVec3::ZERO,
        })
    }

    /// Lets another point of the body move straight.
    ///
    /// # Errors
    /// [`InputError::NotFinite`].
    pub fn about(self, centre: impl Into<[f64; 3]>) -> Result<Self, InputError> {
        let centre = DVec3::from_array(centre.into());
        match centre.is_finite() {
            true => Ok(Poses { centre, ..self }),
            false => Err(InputError::NotFinite { what: "centre" }),
        }
    }

    /// The time of the last pose.
    pub fn end(&self) -> f64 {
        self.poses[self.poses.len() - 1].0
    }

    /// Returns the times of the poses, in order.
    pub fn times(&self) -> impl Iterator<Item = f64> {
        self.poses.iter().map(|&(time, _)| time)
    }

    /// Returns the motion between the poses that a time is between, as it is at that time: that before a pose
    /// where `to` is not later, else that after it.
    fn at(&self, time: f64, to: f64) -> Result<Motion, InputError> {
        let next = match to > time {
            true => self.poses.partition_point(|&(at, _)| at <= time),
            false => self.poses.partition_point(|&(at, _)| at < time),
        };
        match (next.checked_sub(1), self.poses.get(next)) {
            (Some(k), Some(&(end, pose))) => {
                let (begin, from) = self.poses[k];
                let whole = Motion::between(from, pose, self.centre, end - begin)?;
                match time > begin {
                    true => self.moving(whole.pose(time - begin), &whole),
                    false => Ok(whole),
                }
            }
            // The body rests before the first pose and after the last.
            (None, Some(&(_, pose))) => self.still(pose),
            (_, None) => self.still(self.poses[self.poses.len() - 1].1),
        }
    }

    fn still(&self, pose: Pose) -> Result<Motion, InputError> {
        Motion::about(pose, DVec3::ZERO, DVec3::ZERO, self.centre)
    }

    /// Returns a motion from a pose on, at the velocities of another one.
    fn moving(&self, start: Pose, as_in: &Motion) -> Result<Motion, InputError> {
        Motion::about(start, as_in.velocity(), as_in.spin(), self.centre)
    }

    /// The poses strictly between two times.
    fn between(&self, from: f64, to: f64) -> &[(f64, Pose)] {
        let first = self.poses.partition_point(|&(at, _)| at <= from);
        let last = self.poses.partition_point(|&(at, _)| at < to);
        &self.poses[first..last.max(first)]
    }

    /// Returns a motion from the pose at one time to that at another, and how far the path strays from it.
    fn chord(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
        let end = self.at(to, to)?.start();
        let motion = Motion::between(self.at(from, to)?.start(), end, self.centre, to - from)?;
        let mut stray = Stray::NONE;
        // The turn by which the chord is off at a pose, and that pose's time.
        let mut last = (from, Off::default());
        for &(time, pose) in self.between(from, to).iter().chain(&[(to, end)]) {
            let off = Off::new(&motion, &pose, self.centre, time - from);
            // The motion that ends at this pose.
            let change = self.at(time, time)?.spin().distance(motion.spin());
            let between = 0.5 * (off.turn + last.1.turn + change * (time - last.0));
            stray.shift = greater(stray.shift, off.shift);
            stray.turn = greater(stray.turn, between);
            last = (time, off);
        }
        Ok(Stretch {
            stray,
            ..Stretch::exact(motion)
        })
    }

    /// Bounds the rounding of poses from one time to another: they are computed from those given before.
    fn rounding(&self, from: f64, to: f64) -> Stray {
        let first = self.poses.partition_point(|&(at, _)| at <= from);
        let last = self.poses.partition_point(|&(at, _)| at < to);
        let given = &self.poses[first.saturating_sub(1)..(last + 1).min(self.poses.len())];
        let lengths = given.iter().map(|(_, pose)| length(pose.translation()));
        // The way from one to the next is at most twice as long.
        let place = 3.0 * lengths.fold(0.0, greater) + 4.0 * length(self.centre);
        Stray {
            shift: 64.0 * U * place,
            turn: 64.0 * U,
        }
    }
}

impl Trajectory for Poses {
    fn stretch(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
        let stretch = match self.between(from, to).is_empty() {
            // The motion itself: one from pose to pose might turn the other way.
            true => Stretch::exact(self.at(from, to)?),
            false => self.chord(from, to)?,
        };
        Ok(Stretch {
            stray: stretch.stray + self.rounding(from, to),
            ..stretch
        })
    }

    fn corner(&self, from: f64, to: f64) -> Option<f64> {
        let inner = self.between(from, to);
        inner.get(inner.len() / 2).map(|&(time, _)| time)
    }
}

/// How far a motion is off a pose.
#[derive(Clone, Copy, Debug, Default)]
struct Off {
    shift: f64,
    turn: f64,
}

impl Off {
    fn new(motion: &Motion, pose: &Pose, centre: DVec3, time: f64) -> Self {
        let near = motion.pose(time);
        let [at, true_at] = [&near, pose].map(|pose| pose.transform_point(centre));
        let turned: DQuat = near.rotation().conjugate() * pose.rotation();
        Off {
            shift: at.distance(true_at),
            // The double of the angle of a quaternion, whose sine is the length of its vector.
            turn: 2.0 * turned.xyz().length().atan2(turned.w.abs()),
        }
    }
}
