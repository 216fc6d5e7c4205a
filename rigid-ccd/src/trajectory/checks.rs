//! Checks the numbers that trajectories are made from, such as durations and times.

use ccd_core::InputError;
use ccd_core::glam::DVec3;

pub(super) fn out_of_range_error(
    what: &'static str,
    value: f64,
    allowed: &'static str,
) -> InputError {
    InputError::OutOfRange {
        quantity: what,
        value,
        allowed,
    }
}

/// Returns a vector, or an error that calls it `what` if one of its components is not finite.
pub(super) fn check_finite_vector(
    vector: impl Into<[f64; 3]>,
    what: &'static str,
) -> Result<DVec3, InputError> {
    let vector = DVec3::from_array(vector.into());
    if vector.is_finite() {
        Ok(vector)
    } else {
        Err(InputError::NotFinite { quantity: what })
    }
}

/// Refuses a duration that is not positive and finite.
pub(super) fn check_duration(duration: f64) -> Result<(), InputError> {
    if duration > 0.0 && duration.is_finite() {
        Ok(())
    } else {
        Err(out_of_range_error(
            "duration",
            duration,
            "positive and finite",
        ))
    }
}

/// Refuses a time that is not finite, or not later than the time before it.
pub(super) fn check_time_is_later(
    what: &'static str,
    time: f64,
    before: Option<f64>,
) -> Result<(), InputError> {
    // Written so that NaN is refused.
    if time.is_finite() && before.is_none_or(|before| time > before) {
        Ok(())
    } else {
        let allowed = "finite and later than the one before";
        Err(out_of_range_error(what, time, allowed))
    }
}
