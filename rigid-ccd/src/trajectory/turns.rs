//! Orientations over time: slerp and squad through given orientations.

mod squad;

use super::U;
use super::checks::{check_later, out_of_range};
use super::rotation::logarithm;
use super::segments::{Segment, Segments};
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::order::{greater, lesser};
use ccd_core::vector::length;
use ccd_core::{InputError, Pose};
use squad::Squad;

/// A rotation through given orientations at given times, with a fixed origin. The body does not turn before the first
/// and after the last.
///
/// ```
/// use rigid_ccd::glam::DQuat;
/// use rigid_ccd::trajectory::Turns;
/// let keys = [0.0, 1.0, 2.0].map(|t| (t, DQuat::from_rotation_z(t * t / 4.0).to_array()));
/// let (half, _) = Turns::slerp(&keys)?.at(0.5);
/// assert!(half.angle_between(DQuat::from_rotation_z(1.0 / 8.0)) < 1e-7);
/// # Ok::<(), rigid_ccd::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Turns {
    segments: Segments<Turn>,
    /// The orientations before the first segment and after the last.
    ends: [DQuat; 2],
}

/// The rotation between two times.
#[derive(Clone, Debug, PartialEq)]
enum Turn {
    /// A rotation at a constant rate, starting at an orientation (slerp).
    Slerp {
        start: DQuat,
        spin: DVec3,
    },
    Squad(Squad),
}

impl Turns {
    /// The rotation of a body whose axes stay those of the world.
    pub const NONE: Turns = Turns {
        segments: Segments(Vec::new()),
        ends: [DQuat::IDENTITY; 2],
    };

    /// Rotates from each orientation to the next at a constant rate, the shortest way. Quaternions have the order x, y,
    /// z, w.
    ///
    /// # Errors
    /// [`InputError::ZeroQuaternion`], [`InputError::NotFinite`], and [`InputError::OutOfRange`] for times that
    /// do not increase.
    pub fn slerp(keys: &[(f64, [f64; 4])]) -> Result<Self, InputError> {
        let keys = aligned_quaternions(keys)?;
        Ok(Turns::from_keys(&keys, |k| {
            let [(from, start), (to, end)] = [keys[k], keys[k + 1]];
            Turn::Slerp {
                start,
                spin: logarithm(end * start.conjugate()) / (to - from),
            }
        }))
    }

    /// Rotates smoothly through all orientations by spherical quadrangles, whose angular velocities are continuous if
    /// the times are evenly spaced.
    ///
    /// # Errors
    /// Those of [`Turns::slerp`], and [`InputError::OutOfRange`] if orientations are so far apart, about a quarter
    /// of a turn, that the quadrangle between them is too large.
    pub fn squad(keys: &[(f64, [f64; 4])]) -> Result<Self, InputError> {
        let keys = aligned_quaternions(keys)?;
        let at = |k: usize| keys[k.min(keys.len() - 1)].1;
        let inner =
            |k: usize| squad::control_orientation(at(k.saturating_sub(1)), at(k), at(k + 1));
        let mut squads = Vec::new();
        for k in 0..keys.len().saturating_sub(1) {
            let squad = Squad::new(
                [at(k), at(k + 1)],
                [inner(k), inner(k + 1)],
                keys[k + 1].0 - keys[k].0,
            );
            squads.push(squad.ok_or(out_of_range(
                "turn between orientations",
                at(k).angle_between(at(k + 1)),
                "small enough for a spherical quadrangle: give more orientations",
            ))?);
        }
        Ok(Turns::from_keys(&keys, |k| Turn::Squad(squads[k].clone())))
    }

    fn from_keys(keys: &[(f64, DQuat)], turn: impl Fn(usize) -> Turn) -> Self {
        let segment = |k: usize| Segment {
            from: keys[k].0,
            to: keys[k + 1].0,
            course: turn(k),
        };
        Turns {
            segments: Segments((0..keys.len() - 1).map(segment).collect()),
            ends: [keys[0].1, keys[keys.len() - 1].1],
        }
    }

    /// Returns the orientation at a time, and the angular velocity in the world frame.
    pub fn at(&self, time: f64) -> (DQuat, DVec3) {
        match self.segments.at(time) {
            Some(segment) if time >= segment.from => segment.at(time),
            Some(_) => (self.ends[0], DVec3::ZERO),
            None => (self.ends[1], DVec3::ZERO),
        }
    }

    /// Bounds the magnitude of the angular acceleration between two times. A spin that jumps counts as one that changes
    /// in half of the time, by which the orientation strays farther.
    pub(super) fn acceleration(&self, from: f64, to: f64) -> f64 {
        let smooth = self
            .segments
            .greatest(from, to, |segment| match &segment.course {
                Turn::Slerp { .. } => 0.0,
                Turn::Squad(squad) => squad.acceleration(),
            });
        let jumps = self
            .segments
            .jump_acceleration(from, to, |segment, time| segment.at(time).1);
        smooth + jumps
    }

    /// Bounds the angular speed between two times.
    pub(super) fn speed(&self, from: f64, to: f64) -> f64 {
        self.segments
            .greatest(from, to, |segment| match &segment.course {
                Turn::Slerp { spin, .. } => length(*spin),
                Turn::Squad(squad) => squad.speed(),
            })
    }

    /// Returns a knot strictly between two times, near the middle of them; `None` without one.
    pub(super) fn corner(&self, from: f64, to: f64) -> Option<f64> {
        self.segments.corner(from, to)
    }

    /// Bounds the rounding error of an orientation.
    pub(super) fn rounding(&self) -> f64 {
        128.0 * U
    }
}

impl Segment<Turn> {
    fn at(&self, time: f64) -> (DQuat, DVec3) {
        let passed = greater(0.0, lesser(time, self.to) - self.from);
        match &self.course {
            Turn::Slerp { start, spin } => {
                let turned = DQuat::from_scaled_axis(*spin * passed) * *start;
                (turned.normalize(), *spin)
            }
            Turn::Squad(squad) => squad.at(passed),
        }
    }
}

/// Returns the orientations as unit quaternions, each with the sign that is nearer to the one before.
fn aligned_quaternions(keys: &[(f64, [f64; 4])]) -> Result<Vec<(f64, DQuat)>, InputError> {
    let mut units: Vec<(f64, DQuat)> = Vec::new();
    for &(time, key) in keys {
        let unit = Pose::new(DVec3::ZERO, DQuat::from_array(key))?.rotation();
        let last = units.last().copied();
        check_later(
            "time of an orientation",
            time,
            last.map(|(before, _)| before),
        )?;
        let turned = last.is_some_and(|(_, before)| before.dot(unit) < 0.0);
        units.push((time, if turned { -unit } else { unit }));
    }
    if units.is_empty() {
        Err(out_of_range("number of orientations", 0.0, "at least 1"))
    } else {
        Ok(units)
    }
}
