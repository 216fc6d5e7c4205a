//! Screw motions.

use ccd_core::glam::{DQuat, DVec3};
use ccd_core::vector::unit;
use ccd_core::{InputError, Motion, Pose};

/// Creates the motion of a body that rotates about an axis in the world and advances along it, at constant rates:
/// `turn` in radians and `advance`, both per unit of time.
///
/// The axis passes through `point` along `direction`, of any length but 0. The motion is exact.
///
/// # Errors
/// [`InputError::NotFinite`], [`InputError::OutOfRange`] for a direction of no length.
///
/// ```
/// use rigid_ccd::trajectory::screw;
/// use rigid_ccd::Pose;
/// use std::f64::consts::TAU;
/// // A nut, a turn for each 0.2 of the thread.
/// let nut = screw(Pose::at([1.0, 0.0, 0.0])?, [0.0; 3], [0.0, 0.0, 1.0], TAU, 0.2)?;
/// let half = nut.pose(0.5).translation();
/// assert!(half.distance([-1.0, 0.0, 0.1].into()) < 1e-15);
/// # Ok::<(), rigid_ccd::InputError>(())
/// ```
pub fn screw(
    start: Pose,
    point: impl Into<[f64; 3]>,
    direction: impl Into<[f64; 3]>,
    turn: f64,
    advance: f64,
) -> Result<Motion, InputError> {
    let axis = unit_axis(direction)?;
    let centre = start
        .inverse()
        .transform_point(DVec3::from_array(point.into()));
    Motion::about(start, axis * advance, axis * turn, centre)
}

/// Normalises an axis.
pub(super) fn unit_axis(axis: impl Into<[f64; 3]>) -> Result<DVec3, InputError> {
    let axis = DVec3::from_array(axis.into());
    unit(axis).ok_or(if axis.is_finite() {
        InputError::OutOfRange {
            what: "the length of an axis",
            value: 0.0,
            allowed: "positive",
        }
    } else {
        InputError::NotFinite { what: "axis" }
    })
}

/// Returns the rotation by an angle about an axis of unit length.
pub(super) fn turn(axis: DVec3, angle: f64) -> DQuat {
    DQuat::from_axis_angle(axis, angle)
}
