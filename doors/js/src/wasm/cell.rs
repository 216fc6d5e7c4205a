//! A robot among obstacles, and questions about its paths.

use super::body::Body;
use super::fault::Fault;
use super::host::tell_warnings;
use super::path_answer::PathAnswer;
use super::poses::pose_from_numbers;
use super::robot::{Robot, names_of_pairs, remark_texts};
use super::solver::Question;
use rigid_ccd::answer::ClearanceVerdict;
use rigid_ccd::{Settings, StartPolicy};
use rigid_ccd_robot::{CellSolver, PathError, RangeSettings, RobotError};
use self_cell::self_cell;
use wasm_bindgen::prelude::wasm_bindgen;

self_cell!(
    /// A cell with its solver, which reuses memory between questions.
    struct CellWithSolver {
        owner: rigid_ccd_robot::Cell,
        #[not_covariant]
        dependent: CellSolver,
    }
);

/// A robot among obstacles that are static in the frame of its base.
#[wasm_bindgen]
pub struct Cell {
    /// `None` only during a change of the cell.
    cell: Option<CellWithSolver>,
}

/// The settings of a question about a path.
#[wasm_bindgen]
#[derive(Clone, Copy, Debug)]
pub struct PathSettings {
    tolerance: f64,
    margin: f64,
    budget: f64,
    leaves_start_contacts: bool,
}

#[wasm_bindgen]
impl PathSettings {
    /// Creates settings. The start policy is to leave or to report contacts at the start.
    #[wasm_bindgen(constructor)]
    pub fn new(tolerance: f64, margin: f64, budget: f64, leaves_start_contacts: bool) -> Self {
        PathSettings {
            tolerance,
            margin,
            budget,
            leaves_start_contacts,
        }
    }
}

impl From<PathSettings> for Settings {
    fn from(settings: PathSettings) -> Self {
        Settings {
            tolerance: settings.tolerance,
            margin: settings.margin,
            // The cast saturates: a larger number is the largest budget.
            budget: settings.budget as u64,
            start_policy: if settings.leaves_start_contacts {
                StartPolicy::Leave
            } else {
                StartPolicy::Report
            },
            ..Settings::DEFAULT
        }
    }
}

#[wasm_bindgen]
impl Cell {
    /// Creates a cell without obstacles.
    #[wasm_bindgen(constructor)]
    pub fn new(robot: &Robot) -> Self {
        let cell = rigid_ccd_robot::Cell::new(robot.robot.clone(), robot.pairs.clone());
        tell_warnings(cell.remarks());
        Cell {
            cell: Some(with_solver(cell)),
        }
    }

    /// Adds an obstacle.
    ///
    /// # Errors
    /// A name that is taken, or an invalid pose.
    pub fn add_obstacle(&mut self, name: &str, body: &Body, pose: &[f64]) -> Result<(), Fault> {
        let pose = pose_from_numbers(pose)?;
        self.change(|cell| {
            tell_warnings(cell.remark_on_size(name, &body.body));
            cell.add_obstacle(name, body.body.clone(), pose)
        })
    }

    /// Moves an obstacle.
    ///
    /// # Errors
    /// An unknown obstacle, or an invalid pose.
    pub fn move_obstacle(&mut self, name: &str, pose: &[f64]) -> Result<(), Fault> {
        let pose = pose_from_numbers(pose)?;
        self.change(|cell| cell.move_obstacle(name, pose))
    }

    /// Removes an obstacle.
    ///
    /// # Errors
    /// An unknown obstacle.
    pub fn remove_obstacle(&mut self, name: &str) -> Result<(), Fault> {
        self.change(|cell| cell.remove_obstacle(name))
    }

    /// Attaches a body to a link.
    ///
    /// # Errors
    /// A name that is taken, an unknown link, or an invalid pose.
    pub fn attach(
        &mut self,
        name: &str,
        body: &Body,
        link: &str,
        pose: &[f64],
        may_touch: Vec<String>,
    ) -> Result<(), Fault> {
        let pose = pose_from_numbers(pose)?;
        self.change(move |cell| {
            let may_touch: Vec<&str> = may_touch.iter().map(String::as_str).collect();
            tell_warnings(cell.remark_on_size(name, &body.body));
            cell.attach(name, body.body.clone(), (link, pose), &may_touch)
        })
    }

    /// Detaches a body from its link, and removes it.
    ///
    /// # Errors
    /// An unknown attached body.
    pub fn detach(&mut self, name: &str) -> Result<(), Fault> {
        self.change(|cell| cell.detach(name))
    }

    /// Allows two items to touch.
    ///
    /// # Errors
    /// An unknown name, or a pair that is never checked.
    pub fn allow_contact(&mut self, a: &str, b: &str) -> Result<(), Fault> {
        self.change(|cell| cell.allow_contact([cell.item_named(a)?, cell.item_named(b)?]))
    }

    /// Revokes the permission of two items to touch.
    ///
    /// # Errors
    /// An unknown name, or a pair that is never checked.
    pub fn forbid_contact(&mut self, a: &str, b: &str) -> Result<(), Fault> {
        self.change(|cell| cell.forbid_contact([cell.item_named(a)?, cell.item_named(b)?]))
    }

    /// Returns two texts for each remark: "warning" or "remark", then the remark itself.
    ///
    /// # Errors
    /// The cell is lost, because a change of it failed with a panic.
    pub fn remarks(&self) -> Result<Vec<String>, Fault> {
        let cell = self.cell.as_ref().ok_or_else(lost_cell)?.borrow_owner();
        Ok(remark_texts(cell.remarks()))
    }

    /// Sets the distance that obstacles have to keep from a link.
    ///
    /// # Errors
    /// An unknown link, or a distance that is out of range.
    pub fn set_padding(&mut self, link: &str, distance: f64) -> Result<(), Fault> {
        self.change(|cell| cell.set_padding(link, distance))
    }

    /// Sets the distance at which a pair counts as touching.
    ///
    /// # Errors
    /// An unknown name, or a distance that is out of range.
    pub fn set_clearance(&mut self, a: &str, b: &str, distance: f64) -> Result<(), Fault> {
        self.change(|cell| {
            let pair = [cell.item_named(a)?, cell.item_named(b)?];
            cell.set_clearance(pair, distance)
        })
    }

    /// Returns the checked pairs of links, two names for each pair.
    ///
    /// # Errors
    /// The cell is lost, because a change of it failed with a panic.
    pub fn checked_pairs(&self) -> Result<Vec<String>, Fault> {
        let cell = self.cell.as_ref().ok_or_else(lost_cell)?.borrow_owner();
        Ok(names_of_pairs(cell.robot(), cell.link_pairs()))
    }

    /// Answers a question about a path. `path` has its configurations one after another.
    ///
    /// # Errors
    /// An invalid configuration or setting.
    pub fn ask(
        &mut self,
        question: Question,
        path: &[f64],
        count: usize,
        settings: PathSettings,
    ) -> Result<PathAnswer, Fault> {
        self.with_solver_for((path, count), settings, |solver, path| {
            Ok(solver.answer(question.into(), path)?.into())
        })
    }

    /// Divides a path into ranges that keep the margin, violate it, or are unverified. Each range has three numbers:
    /// its start and its end in segments, and 0, 1 or 2 for these three cases.
    ///
    /// # Errors
    /// As for [`Cell::ask`].
    pub fn clearance_ranges(
        &mut self,
        path: &[f64],
        count: usize,
        settings: PathSettings,
        resolution: f64,
        max_pose_error: f64,
    ) -> Result<Vec<f64>, Fault> {
        let range_settings = RangeSettings {
            resolution,
            max_pose_error,
        };
        let ranges = self.with_solver_for((path, count), settings, |solver, path| {
            solver.clearance_ranges(path, range_settings)
        })?;
        let numbers = ranges.iter().flat_map(|range| {
            let verdict = match range.verdict {
                ClearanceVerdict::Kept => 0.0,
                ClearanceVerdict::Violated => 1.0,
                ClearanceVerdict::Unverified => 2.0,
            };
            [range.from.time(), range.to.time(), verdict]
        });
        Ok(numbers.collect())
    }
}

impl Cell {
    fn change(
        &mut self,
        change: impl FnOnce(&mut rigid_ccd_robot::Cell) -> Result<(), RobotError>,
    ) -> Result<(), Fault> {
        let mut cell = self.take_cell()?.into_owner();
        let changed = change(&mut cell);
        self.cell = Some(with_solver(cell));
        Ok(changed?)
    }

    fn take_cell(&mut self) -> Result<CellWithSolver, Fault> {
        self.cell.take().ok_or_else(lost_cell)
    }

    /// Calls a function with the solver and the configurations of a path.
    fn with_solver_for<T>(
        &mut self,
        (path, count): (&[f64], usize),
        settings: PathSettings,
        call: impl FnOnce(&mut CellSolver<'_>, &[&[f64]]) -> Result<T, PathError>,
    ) -> Result<T, Fault> {
        let mut cell = self.take_cell()?;
        let joints = cell.borrow_owner().robot().limits().len();
        let configurations: Vec<&[f64]> = match joints {
            0 => vec![&[]; count],
            _ => path.chunks(joints).collect(),
        };
        tell_warnings(cell.borrow_owner().remark_on_tolerance(settings.tolerance));
        let robot = cell.borrow_owner().robot();
        let mut remarks = configurations
            .iter()
            .filter_map(|configuration| robot.remark_on_configuration(configuration));
        tell_warnings(remarks.next());
        let answer = cell.with_dependent_mut(|_, solver| {
            solver.set_settings(settings.into());
            call(solver, &configurations)
        });
        self.cell = Some(cell);
        Ok(answer?)
    }
}

fn lost_cell() -> Fault {
    Fault::plain("the cell was lost in an earlier error")
}

fn with_solver(cell: rigid_ccd_robot::Cell) -> CellWithSolver {
    CellWithSolver::new(cell, |cell| cell.solver())
}
