//! Positions of joints on the command line: `knee=-90deg:40deg` for a range, `hip=0.3` for one position.

use crate::numbers::parse_finite;
use std::str::FromStr;

/// The positions between which a joint moves; both are the same for a joint at rest.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct JointRange {
    pub(crate) joint: String,
    pub(crate) from: f64,
    pub(crate) to: f64,
}

impl JointRange {
    pub(crate) fn is_at_rest(&self) -> bool {
        self.from == self.to
    }
}

impl FromStr for JointRange {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (joint, positions) = text.split_once('=').ok_or(
            "give a joint with a position or a range, such as hip=0.3 or knee=-90deg:40deg",
        )?;
        let (from, to) = match positions.split_once(':') {
            Some((from, to)) => (position(from)?, position(to)?),
            None => (position(positions)?, position(positions)?),
        };
        let joint = joint.to_owned();
        Ok(JointRange { joint, from, to })
    }
}

/// Parses the position of a joint: radians or the robot's unit of length, unless it says `deg`, `mm` or another unit.
fn position(text: &str) -> Result<f64, String> {
    with_unit(
        text,
        &[
            ("deg", 180.0 / std::f64::consts::PI),
            ("rad", 1.0),
            ("mm", 1000.0),
            ("cm", 100.0),
            ("m", 1.0),
        ],
    )
    .ok_or_else(|| format!("`{text}` is no position, such as 0.3, 40deg or 12mm"))
}

/// Parses a length in metres, the unit of robots, or in another unit, such as `0.3mm`.
pub(crate) fn length(text: &str) -> Result<f64, String> {
    with_unit(
        text,
        &[("mm", 1000.0), ("cm", 100.0), ("um", 1e6), ("m", 1.0)],
    )
    .filter(|&length| length >= 0.0)
    .ok_or_else(|| format!("`{text}` is no length of at least 0, such as 0.005 or 0.3mm"))
}

/// Parses a number with one of the units, which are given with how many of them make 1; or without a unit.
///
/// The number is divided, because the factors are whole numbers where that is possible: `0.3mm` is the number next to 0.0003.
fn with_unit(text: &str, units: &[(&str, f64)]) -> Option<f64> {
    let text = text.trim();
    let found = units
        .iter()
        .find_map(|&(unit, per_one)| Some((text.strip_suffix(unit)?, per_one)));
    let (digits, per_one) = found.unwrap_or((text, 1.0));
    Some(parse_finite(digits.trim())? / per_one)
}

#[cfg(test)]
mod tests;
