//! Orientations over time: slerp through given orientations.

use super::U;
use super::checks::check_time_is_later;
use super::segments::{Segment, Segments};
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::order::{greater, lesser};
use ccd_core::{InputError, Pose, check, shortest_rotation_vector};

/// The orientation of a body over time, which passes through given orientations at given times. The body does not
/// rotate before the first time and after the last.
///
/// ```
/// use rigid_ccd::glam::DQuat;
/// use rigid_ccd::trajectory::OrientationCurve;
/// let keys = [0.0, 1.0, 2.0].map(|t| (t, DQuat::from_rotation_z(t * t / 4.0).to_array()));
/// let (half, _) = OrientationCurve::piecewise_slerp(&keys)?.at(0.5);
/// assert!(half.angle_between(DQuat::from_rotation_z(1.0 / 8.0)) < 1e-7);
/// # Ok::<(), rigid_ccd::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct OrientationCurve {
    pub(super) segments: Segments<Turn>,
    /// The orientations before the first segment and after the last.
    end_orientations: [DQuat; 2],
}

/// A rotation at a constant angular velocity from a start orientation, as in slerp.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Turn {
    start_orientation: DQuat,
    spin: DVec3,
}

impl OrientationCurve {
    /// The orientation curve of a body that does not rotate: its axes stay those of the world.
    pub const NONE: OrientationCurve = OrientationCurve {
        segments: Segments(Vec::new()),
        end_orientations: [DQuat::IDENTITY; 2],
    };

    /// Creates a curve that rotates from each orientation to the next at a constant rate, by the shortest rotation.
    /// Quaternions have the order x, y, z, w.
    ///
    /// # Errors
    /// [`InputError::ZeroQuaternion`], [`InputError::NotFinite`], and [`InputError::OutOfRange`] for times that
    /// do not increase.
    pub fn piecewise_slerp(keys: &[(f64, [f64; 4])]) -> Result<Self, InputError> {
        let keys = aligned_quaternions(keys)?;
        let segment = |two: &[(f64, DQuat)]| {
            let [(from, start), (to, end)] = [two[0], two[1]];
            let spin = shortest_rotation_vector(end * start.conjugate()) / (to - from);
            let course = Turn {
                start_orientation: start,
                spin,
            };
            Segment {
                from,
                to,
                curve: course,
            }
        };
        Ok(OrientationCurve {
            segments: Segments(keys.windows(2).map(segment).collect()),
            end_orientations: [keys[0].1, keys[keys.len() - 1].1],
        })
    }

    /// Returns the orientation at a time, and the angular velocity in the world frame.
    pub fn at(&self, time: f64) -> (DQuat, DVec3) {
        match self.segments.segment_at(time) {
            Some(segment) if time >= segment.from => segment.orientation_and_spin_at(time),
            Some(_) => (self.end_orientations[0], DVec3::ZERO),
            None => (self.end_orientations[1], DVec3::ZERO),
        }
    }

    /// Bounds the magnitude of the angular acceleration between two times. A jump of the angular velocity counts as an
    /// acceleration that causes at least the same deviation.
    pub(super) fn angular_acceleration_bound(&self, from: f64, to: f64) -> f64 {
        self.segments
            .acceleration_covering_jumps(from, to, |segment, time| {
                segment.orientation_and_spin_at(time).1
            })
    }

    /// Bounds the rounding error of an orientation, in radians.
    pub(super) fn rounding(&self) -> f64 {
        128.0 * U
    }
}

impl Segment<Turn> {
    fn orientation_and_spin_at(&self, time: f64) -> (DQuat, DVec3) {
        let passed = greater(0.0, lesser(time, self.to) - self.from);
        let Turn {
            start_orientation: start,
            spin,
        } = self.curve;
        let turned = DQuat::from_scaled_axis(spin * passed) * start;
        (turned.normalize(), spin)
    }
}

/// Returns the orientations as unit quaternions, each with the sign that makes it nearer to the quaternion before it.
fn aligned_quaternions(keys: &[(f64, [f64; 4])]) -> Result<Vec<(f64, DQuat)>, InputError> {
    check(
        "number of orientations",
        0.0,
        !keys.is_empty(),
        "at least 1",
    )?;
    let mut units: Vec<(f64, DQuat)> = Vec::new();
    for &(time, key) in keys {
        let unit = Pose::new(DVec3::ZERO, DQuat::from_array(key))?.rotation();
        let last = units.last().copied();
        let before = last.map(|(before, _)| before);
        check_time_is_later("time of an orientation", time, before)?;
        let turned = last.is_some_and(|(_, before)| before.dot(unit) < 0.0);
        units.push((time, if turned { -unit } else { unit }));
    }
    Ok(units)
}
