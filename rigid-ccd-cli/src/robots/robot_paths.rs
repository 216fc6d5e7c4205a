//! The paths that `ccd view` and `ccd clearance` show: those of a table, or joints that move over ranges.

use super::joint_values::{JointRange, check_joints};
use super::path_table::{PathTable, TablePath};
use crate::files::input_name;
use anyhow::{Context, Result, bail};
use rigid_ccd_robot::{Cell, Robot};
use std::path::Path;

/// The options that say along which paths a robot moves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RobotPaths<'a> {
    /// The table of edges or paths; without it, the joints move over their ranges.
    pub(crate) table: Option<&'a Path>,
    pub(crate) joints: &'a [JointRange],
    /// The ids of the paths to show; the first few if there are none.
    pub(crate) ids: &'a [String],
}

/// The greatest number of paths that are shown if no ids are given.
const MAX_PATHS: usize = 4;

impl RobotPaths<'_> {
    /// Returns at least one path.
    ///
    /// # Errors
    /// If the table cannot be read, or has no such path.
    pub(crate) fn read(self, cell: &Cell) -> Result<Vec<TablePath>> {
        let Some(file) = self.table else {
            if self.joints.is_empty() {
                return Ok(vec![TablePath::between(whole_range(cell.robot())?)]);
            }
            let ends = configurations(cell.robot(), self.joints)?;
            return Ok(vec![TablePath::between(ends)]);
        };
        let name = || input_name(file);
        let (table, _) =
            PathTable::open("--path", file, cell.robot(), self.joints).with_context(name)?;
        let mut paths = Vec::new();
        for path in table {
            let path = match path.with_context(name)? {
                Err(error) if !self.ids.is_empty() && !self.ids.contains(&error.id) => continue,
                path => path.with_context(name)?,
            };
            if self.ids.is_empty() || self.ids.contains(&path.id) {
                paths.push(path);
            }
            if self.ids.is_empty() && paths.len() == MAX_PATHS {
                break;
            }
        }
        if let Some(missing) = self
            .ids
            .iter()
            .find(|id| paths.iter().all(|path| path.id != **id))
        {
            bail!("{}: no path has the id {missing}", name());
        }
        if paths.is_empty() {
            bail!("{}: has a header, but no rows", name());
        }
        Ok(paths)
    }
}

/// Returns the two configurations between which joints move as given. A joint that is not named rests at 0 or, if that is
/// outside of its limits, at the nearest limit.
///
/// # Errors
/// A name that no joint with a position of its own has, or that is given twice.
fn configurations(robot: &Robot, given: &[JointRange]) -> Result<[Vec<f64>; 2]> {
    check_joints(robot, given)?;
    let names: Vec<&str> = robot.free_joint_names().collect();
    let from = robot.configuration_nearest_zero();
    let mut path = [from.clone(), from];
    for range in given {
        let number = names.iter().position(|name| *name == range.joint);
        if let Some(number) = number {
            path[0][number] = range.from;
            path[1][number] = range.to;
        }
    }
    Ok(path)
}

/// Returns the ends of the range of a robot's only joint.
///
/// # Errors
/// If the robot has more joints, or its joint has no limits.
fn whole_range(robot: &Robot) -> Result<[Vec<f64>; 2]> {
    let limits: Vec<[f64; 2]> = robot.limits().collect();
    match limits[..] {
        [[low, high]] if low.is_finite() && high.is_finite() => Ok([vec![low], vec![high]]),
        _ => {
            let names: Vec<&str> = robot.free_joint_names().collect();
            bail!(
                "give --joint NAME=FROM:TO for a joint that moves; there are {}",
                names.join(", ")
            )
        }
    }
}
