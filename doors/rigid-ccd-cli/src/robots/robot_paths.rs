//! The paths of `ccd view` and `ccd clearance`: from a table, or from joints that move over ranges.

use super::joint_values::{JointsArgs, check_joints};
use super::path_table::{PathTable, TablePath};
use crate::console::print_remarks;
use crate::files::input_name;
use anyhow::{Context, Result, bail};
use rigid_ccd_robot::{Cell, Robot};
use std::path::Path;

/// The options that say along which paths a robot moves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RobotPaths<'a> {
    /// The table of edges or paths; without it, the joints move over their ranges.
    pub(crate) table: Option<&'a Path>,
    pub(crate) joints: &'a JointsArgs,
    /// The ids of the paths to show; if empty, the first few paths are shown.
    pub(crate) ids: &'a [String],
}

/// The greatest number of paths that are shown if no ids are given.
const MAX_PATHS: usize = 4;

/// The paths that the options select.
#[derive(Debug, Default)]
pub(crate) struct SelectedPaths {
    pub(crate) paths: Vec<TablePath>,
    /// The messages about bad rows, and about ids that no path has.
    pub(crate) problems: Vec<String>,
}

impl RobotPaths<'_> {
    /// Returns the selected paths and the problems, at least one path or one problem.
    ///
    /// # Errors
    /// If the table cannot be read or has no rows, or a joint has no position.
    pub(crate) fn read(self, cell: &Cell) -> Result<SelectedPaths> {
        let mut selected = SelectedPaths::default();
        let Some(file) = self.table else {
            let ends = if self.joints.joint.is_empty() {
                whole_range(cell.robot())?
            } else {
                configurations(cell.robot(), self.joints)?
            };
            selected.paths.push(TablePath::between(ends));
            return Ok(selected);
        };
        let name = || input_name(file);
        let (mut table, _) =
            PathTable::open("--path", file, cell.robot(), self.joints).with_context(name)?;
        for path in table.by_ref() {
            match path.with_context(name)? {
                Err(error) if self.ids.is_empty() || self.ids.contains(&error.id) => {
                    selected.problems.push(format!("{}: {error}", name()));
                }
                Ok(path) if self.ids.is_empty() || self.ids.contains(&path.id) => {
                    selected.paths.push(path);
                }
                _ => {}
            }
            if self.ids.is_empty() && selected.paths.len() == MAX_PATHS {
                break;
            }
        }
        print_remarks(table.remark_on_degrees());
        let remark = |path: &TablePath| path.remark(cell.robot());
        print_remarks(selected.paths.iter().find_map(remark));
        if self.ids.is_empty() && selected.paths.is_empty() && selected.problems.is_empty() {
            bail!("{}: has a header, but no rows", name());
        }
        for id in self.ids {
            if selected.paths.iter().all(|path| path.id != *id) {
                let problem = format!("{}: no path to show has the id {id:?}", name());
                selected.problems.push(problem);
            }
        }
        Ok(selected)
    }
}

/// Returns the two configurations between which the joints move.
///
/// # Errors
/// A name is of no independent joint or is given twice, or a joint has no position.
fn configurations(robot: &Robot, joints: &JointsArgs) -> Result<[Vec<f64>; 2]> {
    let ranges = &joints.joint;
    check_joints(robot, ranges)?;
    let names: Vec<&str> = robot.independent_joint_names().collect();
    let is_named = |name: &&str| ranges.iter().any(|range| range.joint == *name);
    let missing: Vec<&str> = names
        .iter()
        .copied()
        .filter(|name| !is_named(name))
        .collect();
    if !joints.rest && !missing.is_empty() {
        bail!(
            "no --joint for {}: give their positions, or --rest, which lets them rest at 0, or at their limit nearest to 0",
            missing.join(", ")
        );
    }
    let from = robot.configuration_nearest_zero();
    let mut path = [from.clone(), from];
    for range in ranges {
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
            let names: Vec<&str> = robot.independent_joint_names().collect();
            bail!(
                "give --joint NAME=FROM:TO for a joint that moves; the joints are {}",
                names.join(", ")
            )
        }
    }
}
