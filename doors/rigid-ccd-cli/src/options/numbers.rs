//! Parsers for numbers on the command line.

use ccd_core::limits::{LEAST_TOLERANCE, MAX_COORDINATE};
use std::time::Duration;

/// Parses the value of `--tolerance`, and refuses one out of the library's range.
pub fn tolerance(text: &str) -> Result<f64, String> {
    parse_finite(text)
        .filter(|value| (LEAST_TOLERANCE..=MAX_COORDINATE).contains(value))
        .ok_or_else(|| {
            format!("give a number from {LEAST_TOLERANCE:e} to {MAX_COORDINATE:e}, such as 1e-3")
        })
}

/// Parses a length or a time from 0 to [`MAX_COORDINATE`].
pub(crate) fn parse_nonnegative(text: &str) -> Result<f64, String> {
    parse_finite(text)
        .filter(|value| (0.0..=MAX_COORDINATE).contains(value))
        .ok_or_else(|| format!("give a number from 0 to {MAX_COORDINATE:e}, such as 0.01"))
}

/// Parses a finite number; `None` for any other text.
pub(crate) fn parse_finite(text: &str) -> Option<f64> {
    text.parse::<f64>().ok().filter(|value| value.is_finite())
}

/// Parses a duration in seconds.
pub fn parse_seconds(text: &str) -> Result<Duration, String> {
    parse_finite(text)
        .and_then(|value| Duration::try_from_secs_f64(value).ok())
        .ok_or_else(|| "give a number of seconds of at least 0, such as 0.01".to_owned())
}
