//! Motions that rotate about an axis and advance along it.

use super::checks::check_finite_vector;
use ccd_core::glam::DVec3;
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
    let center = start
        .inverse()
        .transform_point(DVec3::from_array(point.into()));
    Motion::about(start, axis * advance, axis * turn, center)
}

/// Returns the unit vector along an axis, or an error for an axis without a direction.
pub(super) fn unit_axis(axis: impl Into<[f64; 3]>) -> Result<DVec3, InputError> {
    let axis = check_finite_vector(axis, "axis")?;
    unit(axis).ok_or(InputError::OutOfRange {
        quantity: "the length of an axis",
        value: 0.0,
        allowed: "positive",
    })
}
