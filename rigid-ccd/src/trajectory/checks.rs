//! Checks the numbers that trajectories are made from, such as durations and times.

use ccd_core::glam::DVec3;
use ccd_core::{InputError, check, check_finite};

/// Returns a vector, or an error that names the quantity if one of its components is not finite.
pub(super) fn check_finite_vector(
    vector: impl Into<[f64; 3]>,
    quantity: &'static str,
) -> Result<DVec3, InputError> {
    let vector = DVec3::from_array(vector.into());
    check_finite(quantity, vector.is_finite())?;
    Ok(vector)
}

/// Refuses a duration that is not positive and finite.
pub(super) fn check_duration(duration: f64) -> Result<(), InputError> {
    let is_allowed = duration > 0.0 && duration.is_finite();
    check("duration", duration, is_allowed, "positive and finite")
}

/// Refuses a time that is not finite, or not later than the time before it.
pub(super) fn check_time_is_later(
    quantity: &'static str,
    time: f64,
    before: Option<f64>,
) -> Result<(), InputError> {
    // Written so that NaN is refused.
    let is_later = time.is_finite() && before.is_none_or(|before| time > before);
    check(
        quantity,
        time,
        is_later,
        "finite and later than the one before",
    )
}
