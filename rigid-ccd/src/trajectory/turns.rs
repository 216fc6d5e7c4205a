//! Orientations over time: slerp and squad through given orientations.

mod squad;

use super::U;
use super::knots::{middle_knot, overlapping, spread};
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::order::{greater, lesser};
use ccd_core::vector::length;
use ccd_core::{InputError, Pose};
use squad::{Squad, logarithm};

/// A rotation through given orientations at given times. The body does not turn before the first and after the last.
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
    /// The pieces, at increasing times.
    pieces: Vec<Piece>,
    /// The orientation before the first piece, and after the last.
    ends: [DQuat; 2],
}

/// The rotation between two times.
#[derive(Clone, Debug, PartialEq)]
struct Piece {
    from: f64,
    to: f64,
    turn: Turn,
}

#[derive(Clone, Debug, PartialEq)]
enum Turn {
    /// A rotation at a constant rate, starting at an orientation.
    Slerp {
        start: DQuat,
        spin: DVec3,
    },
    Squad(Squad),
}

impl Turns {
    /// No rotation: the body stays oriented as the world.
    pub const NONE: Turns = Turns {
        pieces: Vec::new(),
        ends: [DQuat::IDENTITY; 2],
    };

    /// Rotates from each orientation to the next at a constant rate, the shortest way. Quaternions have the order x, y,
    /// z, w.
    ///
    /// # Errors
    /// [`InputError::ZeroQuaternion`], [`InputError::NotFinite`], and [`InputError::OutOfRange`] for times that
    /// do not increase.
    pub fn slerp(keys: &[(f64, [f64; 4])]) -> Result<Self, InputError> {
        let keys = checked(keys)?;
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
        let keys = checked(keys)?;
        let at = |k: usize| keys[k.min(keys.len() - 1)].1;
        let inner = |k: usize| squad::inner(at(k.saturating_sub(1)), at(k), at(k + 1));
        let mut squads = Vec::new();
        for k in 0..keys.len().saturating_sub(1) {
            let squad = Squad::new(
                [at(k), at(k + 1)],
                [inner(k), inner(k + 1)],
                keys[k + 1].0 - keys[k].0,
            );
            squads.push(squad.ok_or(InputError::OutOfRange {
                what: "turn between orientations",
                value: at(k).angle_between(at(k + 1)),
                allowed: "small enough for a spherical quadrangle: give more orientations",
            })?);
        }
        Ok(Turns::from_keys(&keys, |k| Turn::Squad(squads[k].clone())))
    }

    fn from_keys(keys: &[(f64, DQuat)], turn: impl Fn(usize) -> Turn) -> Self {
        let piece = |k: usize| Piece {
            from: keys[k].0,
            to: keys[k + 1].0,
            turn: turn(k),
        };
        Turns {
            pieces: (0..keys.len() - 1).map(piece).collect(),
            ends: [keys[0].1, keys[keys.len() - 1].1],
        }
    }

    /// Returns the orientation at a time, and the angular velocity along the world's axes.
    pub fn at(&self, time: f64) -> (DQuat, DVec3) {
        let next = self.pieces.partition_point(|piece| piece.to < time);
        match self.pieces.get(next) {
            Some(piece) if time >= piece.from => piece.at(time),
            Some(_) => (self.ends[0], DVec3::ZERO),
            None => (self.ends[1], DVec3::ZERO),
        }
    }

    /// Bounds the angular acceleration between two times. A spin that jumps counts as one that changes in half
    /// of the time, by which the orientation strays farther.
    pub(super) fn acceleration(&self, from: f64, to: f64) -> f64 {
        let smooth = self
            .overlapping(from, to)
            .iter()
            .map(|piece| match &piece.turn {
                Turn::Slerp { .. } => 0.0,
                Turn::Squad(squad) => squad.acceleration(),
            });
        smooth.fold(0.0, greater) + spread(self.jumps(from, to), from, to)
    }

    /// Bounds the angular speed between two times.
    pub(super) fn speed(&self, from: f64, to: f64) -> f64 {
        let speeds = self
            .overlapping(from, to)
            .iter()
            .map(|piece| match &piece.turn {
                Turn::Slerp { spin, .. } => length(*spin),
                Turn::Squad(squad) => squad.speed(),
            });
        speeds.fold(0.0, greater)
    }

    /// Returns a knot strictly between two times, about in the middle; `None` without one.
    pub(super) fn corner(&self, from: f64, to: f64) -> Option<f64> {
        middle_knot(
            self.overlapping(from, to),
            |piece| [piece.from, piece.to],
            from,
            to,
        )
    }

    /// Bounds the rounding of an orientation.
    pub(super) fn rounding(&self) -> f64 {
        128.0 * U
    }

    fn overlapping(&self, from: f64, to: f64) -> &[Piece] {
        overlapping(&self.pieces, |piece| [piece.from, piece.to], from, to)
    }

    /// Returns the magnitudes of the jumps of the angular velocity strictly between two times.
    fn jumps(&self, from: f64, to: f64) -> impl Iterator<Item = f64> {
        let pieces = self.overlapping(from, to);
        // The angular velocity is zero before the first piece and after the last.
        let before = pieces.iter().map(|piece| Some(piece.at(piece.to).1));
        let after = pieces
            .iter()
            .map(|piece| (piece.from, piece.at(piece.from).1));
        let end = pieces.last().map(|piece| (piece.to, DVec3::ZERO));
        let starts = std::iter::once(None).chain(before).zip(after.chain(end));
        starts
            .filter(move |&(_, (knot, _))| knot > from && knot < to)
            .map(|(before, (_, spin))| before.unwrap_or(DVec3::ZERO).distance(spin))
    }
}

impl Piece {
    fn at(&self, time: f64) -> (DQuat, DVec3) {
        let passed = greater(0.0, lesser(time, self.to) - self.from);
        match &self.turn {
            Turn::Slerp { start, spin } => {
                let turned = DQuat::from_scaled_axis(*spin * passed) * *start;
                (turned.normalize(), *spin)
            }
            Turn::Squad(squad) => squad.at(passed),
        }
    }
}

/// Returns unit quaternions, each with the sign that is nearer to the one before.
fn checked(keys: &[(f64, [f64; 4])]) -> Result<Vec<(f64, DQuat)>, InputError> {
    let refuse = |value| {
        Err(InputError::OutOfRange {
            what: "time of an orientation",
            value,
            allowed: "finite and later than the one before",
        })
    };
    let mut units: Vec<(f64, DQuat)> = Vec::new();
    for &(time, key) in keys {
        let unit = Pose::new(DVec3::ZERO, DQuat::from_array(key))?.rotation();
        let last = units.last().copied();
        // Written so that NaN is refused.
        if !(time.is_finite() && last.is_none_or(|(before, _)| time > before)) {
            return refuse(time);
        }
        let turned = last.is_some_and(|(_, before)| before.dot(unit) < 0.0);
        units.push((time, if turned { -unit } else { unit }));
    }
    if units.is_empty() {
        Err(InputError::OutOfRange {
            what: "number of orientations",
            value: 0.0,
            allowed: "at least 1",
        })
    } else {
        Ok(units)
    }
}
