//! Positions of joints on the command line: `knee=-90deg:40deg` for a range, `hip=0.3` for one position.

use crate::options::numbers::{parse_finite, tolerance};
use anyhow::{Result, bail};
use ccd_core::limits::MAX_COORDINATE;
use ccd_tables::joint_columns::AngleUnit;
use clap::Args;
use rigid_ccd::trajectory::JointKind;
use rigid_ccd_robot::Robot;
use std::str::FromStr;

/// The options for joints without columns in a table, and for the unit of angles.
#[derive(Clone, Debug, Args)]
pub(crate) struct JointsArgs {
    /// Position at which a joint rests, such as finger=0.04 or hip=30deg. Without a table it may be a range over which
    /// the joint moves, such as knee=-90deg:40deg; several joints move together
    #[arg(long, value_name = "NAME=FROM:TO", allow_hyphen_values = true)]
    pub(crate) joint: Vec<JointRange>,
    /// Let all joints without columns and without --joint rest at 0, or at their limit nearest to 0; without this
    /// option they are an error
    #[arg(long)]
    pub(crate) rest: bool,
    /// Read the positions of revolute joints in the table as degrees; without this option only columns that end in _deg
    /// have degrees
    #[arg(long)]
    pub(crate) degrees: bool,
}

impl JointsArgs {
    /// Returns the unit of angles in columns whose names end in no unit.
    pub(crate) fn unit(&self) -> AngleUnit {
        if self.degrees {
            AngleUnit::Degree
        } else {
            AngleUnit::Radian
        }
    }
}

/// The positions between which a joint moves; both are the same for a joint at rest.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct JointRange {
    pub(crate) joint: String,
    pub(crate) from: f64,
    pub(crate) to: f64,
    /// The quantity that the unit of the positions measures; `None` if they have no unit.
    quantity: Option<Quantity>,
}

/// The quantity that a unit measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Quantity {
    Angle,
    Length,
}

impl JointRange {
    pub(crate) fn is_at_rest(&self) -> bool {
        self.from == self.to
    }
}

impl FromStr for JointRange {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        let (joint, positions) = text.split_once('=').ok_or(
            "give a joint with a position or a range, such as hip=0.3 or knee=-90deg:40deg",
        )?;
        let (from, to) = positions.split_once(':').unwrap_or((positions, positions));
        let (from, from_quantity) = position(from)?;
        let (to, to_quantity) = position(to)?;
        if let (Some(one), Some(other)) = (from_quantity, to_quantity)
            && one != other
        {
            return Err(format!("`{positions}` has an angle and a length"));
        }
        let (joint, quantity) = (joint.to_owned(), from_quantity.or(to_quantity));
        Ok(JointRange {
            joint,
            from,
            to,
            quantity,
        })
    }
}

/// Refuses names of no independent joint, names that occur twice, and units that do not fit a joint.
pub(crate) fn check_joints(robot: &Robot, ranges: &[JointRange]) -> Result<()> {
    let names: Vec<&str> = robot.independent_joint_names().collect();
    for (k, range) in ranges.iter().enumerate() {
        let name = &range.joint;
        if ranges[..k].iter().any(|other| other.joint == *name) {
            bail!("--joint {name}: is given twice");
        }
        let joint = robot.joints().iter().find(|joint| joint.name == *name);
        let Some(joint) = joint.filter(|_| names.contains(&name.as_str())) else {
            let names = names.join(", ");
            bail!("--joint {name}: no independent joint has this name; there are {names}");
        };
        let turns = matches!(joint.geometry.kind(), JointKind::Revolute(_));
        match range.quantity {
            Some(Quantity::Length) if turns => {
                bail!("--joint {name}: turns; give an angle, such as 0.3 or 20deg")
            }
            Some(Quantity::Angle) if !turns => {
                bail!("--joint {name}: slides; give a length, such as 0.3 or 20mm")
            }
            _ => {}
        }
    }
    Ok(())
}

const ANGLES: &[(&str, f64)] = &[("deg", 180.0 / std::f64::consts::PI), ("rad", 1.0)];
const LENGTHS: &[(&str, f64)] = &[("mm", 1000.0), ("cm", 100.0), ("um", 1e6), ("m", 1.0)];

/// Parses the position of a joint: radians or the robot's unit of length, unless it says `deg`, `mm` or another unit.
fn position(text: &str) -> std::result::Result<(f64, Option<Quantity>), String> {
    let plain = || Some((parse_finite(text.trim())?, None));
    let angle = || Some((with_unit(text, ANGLES)?, Some(Quantity::Angle)));
    let length = || Some((with_unit(text, LENGTHS)?, Some(Quantity::Length)));
    let position = plain().or_else(angle).or_else(length);
    position.ok_or_else(|| format!("`{text}` is no position, such as 0.3, 40deg or 12mm"))
}

/// Parses a length in metres, the unit of robots, or in another unit, such as `0.3mm`.
pub(crate) fn length(text: &str) -> std::result::Result<f64, String> {
    parse_finite(text.trim())
        .or_else(|| with_unit(text, LENGTHS))
        .filter(|length| (0.0..=MAX_COORDINATE).contains(length))
        .ok_or_else(|| format!("`{text}` is no length of at least 0, such as 0.005 or 0.3mm"))
}

/// Parses the value of `--tolerance`, a length in the range of the library.
pub(crate) fn tolerance_length(text: &str) -> std::result::Result<f64, String> {
    tolerance(&length(text)?.to_string())
}

/// Parses a number with one of the given units. Each unit comes with the number of units in one radian or one metre.
///
/// The number is divided, because the factors are whole numbers where that is possible: `0.3mm` is the number next to 0.0003.
fn with_unit(text: &str, units: &[(&str, f64)]) -> Option<f64> {
    let text = text.trim();
    let digits_and_unit = units
        .iter()
        .find_map(|&(unit, units_per_one)| Some((text.strip_suffix(unit)?, units_per_one)));
    let (digits, units_per_one) = digits_and_unit?;
    Some(parse_finite(digits.trim())? / units_per_one)
}

#[cfg(test)]
mod tests;
