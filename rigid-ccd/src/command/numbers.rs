//! Numbers on the command line.

use ccd_core::limits::{LEAST_TOLERANCE, MAX_COORDINATE};

/// Parses the value of `--tolerance`.
pub(super) fn tolerance(text: &str) -> Result<f64, String> {
    number(text)
        .filter(|value| (LEAST_TOLERANCE..=MAX_COORDINATE).contains(value))
        .ok_or_else(|| {
            format!("give a number from {LEAST_TOLERANCE:e} to {MAX_COORDINATE:e}, such as 1e-3")
        })
}

/// Parses a length or time of at least 0.
pub(super) fn not_negative(text: &str) -> Result<f64, String> {
    number(text)
        .filter(|value| (0.0..=MAX_COORDINATE).contains(value))
        .ok_or_else(|| format!("give a number from 0 to {MAX_COORDINATE:e}, such as 0.01"))
}

/// Parses a finite number.
pub(super) fn number(text: &str) -> Option<f64> {
    text.parse::<f64>().ok().filter(|value| value.is_finite())
}
