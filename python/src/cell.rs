//! The Python class `Cell`.

use crate::body::extract_body;
use crate::cell_rows::{self, PathQuestion, PathRow};
use crate::cell_solver::{CellWithCachedSolver, answer_paths};
use crate::errors::{Unresolved, input_error, input_error_from, unresolved_error, with_attribute};
use crate::interruptible::run_interruptibly;
use crate::motion::read_pose;
use crate::path_array::PathArray;
use crate::robot::PyRobot;
use crate::settings::{CONTACT_SETTING_NAMES, read, read_thread_count};
use crate::table::PyTable;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rigid_ccd::answer::{ClearanceVerdict, Limit};
use rigid_ccd::{Error, Pose, Settings};
use rigid_ccd_robot::{Cell, PathError, PathPoint, RangeSettings, RobotError};
use std::sync::Arc;
use std::time::Duration;

/// A robot among obstacles that rest in the frame of its base.
///
/// A path is an array of shape (n, joints): configurations, between two of which all joints move at constant rates. An array
/// of shape (joints,) is a configuration alone.
///
/// Args:
///     robot: the robot.
#[pyclass(name = "Cell", module = "rigid_ccd", frozen)]
pub(crate) struct PyCell {
    robot: Py<PyRobot>,
    cell_with_solver: CellWithCachedSolver,
}

#[pymethods]
impl PyCell {
    #[new]
    fn new(robot: &Bound<'_, PyRobot>) -> Self {
        let PyRobot {
            robot: links,
            pairs,
            ..
        } = robot.get();
        let cell = Cell::new((**links).clone(), pairs.clone());
        PyCell {
            robot: robot.clone().unbind(),
            cell_with_solver: CellWithCachedSolver::new(cell),
        }
    }

    /// The robot, as it was given.
    #[getter]
    fn robot(&self, py: Python<'_>) -> Py<PyRobot> {
        self.robot.clone_ref(py)
    }

    /// Adds an obstacle at a pose in the frame of the robot's base.
    #[pyo3(signature = (name, body, pose = None))]
    fn add(
        &self,
        name: &str,
        body: &Bound<'_, PyAny>,
        pose: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let (body, pose) = (extract_body(body, "body")?.clone(), pose_or_identity(pose)?);
        self.change(|cell| cell.add_obstacle(name, body, pose))
    }

    /// Moves an obstacle to a pose.
    fn move_to(&self, name: &str, pose: &Bound<'_, PyAny>) -> PyResult<()> {
        let pose = read_pose(pose, "pose")?;
        self.change(|cell| cell.move_obstacle(name, pose))
    }

    /// Removes an obstacle.
    fn remove(&self, name: &str) -> PyResult<()> {
        self.change(|cell| cell.remove_obstacle(name))
    }

    /// Attaches a body to a link, at a pose in the link's frame. It may touch that link, and those in `may_touch`.
    #[pyo3(signature = (name, body, link, pose = None, may_touch = Vec::new()))]
    fn attach(
        &self,
        name: &str,
        body: &Bound<'_, PyAny>,
        link: &str,
        pose: Option<&Bound<'_, PyAny>>,
        may_touch: Vec<String>,
    ) -> PyResult<()> {
        let (body, pose) = (extract_body(body, "body")?.clone(), pose_or_identity(pose)?);
        let may_touch: Vec<&str> = may_touch.iter().map(String::as_str).collect();
        self.change(|cell| cell.attach(name, body, (link, pose), &may_touch))
    }

    /// Removes a body that is attached to a link.
    fn detach(&self, name: &str) -> PyResult<()> {
        self.change(|cell| cell.detach(name))
    }

    /// Sets the distance that obstacles have to keep from a link, in addition to the margin.
    fn set_padding(&self, link: &str, distance: f64) -> PyResult<()> {
        self.change(|cell| cell.set_padding(link, distance))
    }

    /// Sets the distance at which a pair counts as touching. `a` is a link or an attached body; so is `b`, or an obstacle.
    fn set_clearance(&self, a: &str, b: &str, distance: f64) -> PyResult<()> {
        self.change(|cell| {
            let pair = [cell.item_named(a)?, cell.item_named(b)?];
            cell.set_clearance(pair, distance)
        })
    }

    /// Returns whether nothing touches on a path. That is proven for all configurations on it.
    ///
    /// Raises:
    ///     Unresolved: a limit was reached first.
    #[pyo3(signature = (path, **settings))]
    fn is_free(
        &self,
        py: Python<'_>,
        path: &Bound<'_, PyAny>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<bool> {
        Ok(self
            .ask(py, PathQuestion::IsFree, path, settings)?
            .is_free())
    }

    /// Returns the first contact on a path, or None. Nothing touches before it.
    ///
    /// Raises:
    ///     Unresolved: a limit was reached first; `safe_until` is the last free point, in segments of the path.
    #[pyo3(signature = (path, **settings))]
    fn first_contact<'py>(
        &self,
        py: Python<'py>,
        path: &Bound<'py, PyAny>,
        settings: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        let row = self.ask(py, PathQuestion::FirstContact, path, settings)?;
        match row.limit {
            Some(limit) => {
                let until = row
                    .at
                    .map_or(0.0, |(segment, share)| segment as f64 + share);
                let text = format!("a limit was reached ({limit}); free until {until}");
                let error = Unresolved::new_err(text);
                Err(with_attribute(py, error, "safe_until", until))
            }
            None => row.contact(py),
        }
    }

    /// Returns bounds of the least distance on a path, with the nearest pair.
    #[pyo3(signature = (path, **settings))]
    fn closest_approach<'py>(
        &self,
        py: Python<'py>,
        path: &Bound<'py, PyAny>,
        settings: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let row = self.ask(py, PathQuestion::ClosestApproach, path, settings)?;
        let class = py.import("rigid_ccd")?.getattr("PathDistance")?;
        class.call1((row.lower, row.upper, row.contact(py)?))
    }

    /// Divides a path into ranges in which all pairs keep their distance, ranges in which one certainly does not, and the rest.
    /// The distance is the setting `margin` with the paddings, or the clearance of a pair.
    ///
    /// Args:
    ///     path: the path; for a mechanism with one joint `[[low], [high]]`.
    ///     resolution: the length of the shortest ranges that are examined, in segments of the path.
    ///     max_pose_error: how far points of links may be from where the path places them. A closed loop of joints is a path of
    ///         configurations in which the loop is closed; between these, points differ by the error of the interpolation.
    ///
    /// Returns:
    ///     A list of `PathRange`, in the order of the path.
    #[pyo3(signature = (path, *, resolution = RangeSettings::DEFAULT.resolution, max_pose_error = 0.0, **settings))]
    fn clearance_ranges<'py>(
        &self,
        py: Python<'py>,
        path: &Bound<'py, PyAny>,
        resolution: f64,
        max_pose_error: f64,
        settings: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let settings = read(settings, CONTACT_SETTING_NAMES)?;
        let path = PathArray::read(path, "path")?;
        let how = RangeSettings {
            resolution,
            max_pose_error,
        };
        let work = |stop: &Arc<_>| {
            let settings = Settings {
                stop: Some(Arc::clone(stop)),
                ..settings
            };
            self.cell_with_solver.ask(settings, |solver| {
                solver.clearance_ranges(&path.configurations(), how)
            })
        };
        let (ranges, seen) = run_interruptibly(py, work, |_| Ok(()))?;
        seen?;
        let class = py.import("rigid_ccd")?.getattr("PathRange")?;
        let at = |point: PathPoint| point.segment as f64 + point.share;
        let ranges = ranges.map_err(|error| path_error(py, error))?;
        let ranges = ranges.iter().map(|range| {
            let clearance = match range.verdict {
                ClearanceVerdict::Kept => "kept",
                ClearanceVerdict::Violated => "violated",
                ClearanceVerdict::Unverified => "unverified",
            };
            class.call1((at(range.from), at(range.to), clearance))
        });
        ranges.collect()
    }

    /// Answers a question about many edges, on all cores: `start` and `end` are arrays of shape (N, joints).
    ///
    /// Args:
    ///     ask: "is-free", "first-contact" or "closest-approach".
    ///     threads: how many threads; None for one on each core.
    ///
    /// Returns:
    ///     A table with a row for each edge: the column `status`, and those that the question has of `share`, `a`, `b`,
    ///     `lower`, `upper`, and the witnesses `wa_x` to `wb_z`.
    #[pyo3(signature = (start, end, ask = "is-free", *, threads = None, **settings))]
    fn edges(
        &self,
        py: Python<'_>,
        start: &Bound<'_, PyAny>,
        end: &Bound<'_, PyAny>,
        ask: &str,
        threads: Option<i64>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<PyTable> {
        let stacked = py
            .import("numpy")?
            .call_method1("stack", ((start, end), 1))
            .map_err(|error| input_error_from(py, "start, end", error))?;
        self.paths(py, &stacked, ask, threads, settings)
    }

    /// Answers a question about many paths of equally many configurations, on all cores: an array of shape
    /// (N, n, joints). The column `segment` has the number of the segment of a path; otherwise the table is that of `edges`.
    #[pyo3(signature = (paths, ask = "is-free", *, threads = None, **settings))]
    fn paths(
        &self,
        py: Python<'_>,
        paths: &Bound<'_, PyAny>,
        ask: &str,
        threads: Option<i64>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<PyTable> {
        let ask = PathQuestion::from_name(ask)?;
        let settings = read(settings, ask.allowed_setting_names())?;
        let threads = read_thread_count(threads)?;
        let cell = self.cell_with_solver.cell();
        let array = PathArray::read(paths, "paths")?;
        let joints = cell.robot().free_joint_names().len();
        array.check_shape_of_paths(joints)?;
        let work = |stop: &Arc<_>| {
            let settings = Settings {
                stop: Some(Arc::clone(stop)),
                ..settings
            };
            answer_paths(&cell, &settings, threads, array.paths(), |solver, path| {
                ask.answer(solver, path)
            })
        };
        let (rows, seen) = run_interruptibly(py, work, |_| Ok(()))?;
        seen?;
        let batch = py
            .detach(|| cell_rows::path_table(&rows, ask))
            .map_err(input_error)?;
        Ok(PyTable { batch })
    }

    fn __repr__(&self) -> String {
        let cell = self.cell_with_solver.cell();
        let obstacles: Vec<&str> = cell.obstacle_names().collect();
        format!(
            "Cell({} obstacles: {})",
            obstacles.len(),
            obstacles.join(", ")
        )
    }
}

/// The time after which a question goes on, from its start, on a thread that Ctrl-C can end. To start one for each question
/// would cost more than most questions do.
const FIRST_ATTEMPT_TIME_LIMIT: Duration = Duration::from_millis(5);

impl PyCell {
    /// Answers a question about a path, after reading its settings and its configurations.
    fn ask(
        &self,
        py: Python<'_>,
        ask: PathQuestion,
        path: &Bound<'_, PyAny>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<PathRow> {
        let settings = read(settings, ask.allowed_setting_names())?;
        let path = PathArray::read(path, "path")?;
        let path = path.configurations();
        let question = |settings| {
            let solver = &self.cell_with_solver;
            solver.ask(settings, |solver| ask.ask(solver, &path))
        };
        let limit = settings.deadline.unwrap_or(Duration::MAX);
        let first_limit = limit.min(FIRST_ATTEMPT_TIME_LIMIT);
        let first = Settings {
            deadline: Some(first_limit),
            ..settings.clone()
        };
        let mut found = py.detach(|| question(first));
        if ended_by_deadline(&found) && limit > first_limit {
            let work = |stop: &Arc<_>| {
                question(Settings {
                    deadline: settings.deadline.map(|_| limit - first_limit),
                    stop: Some(Arc::clone(stop)),
                    ..settings
                })
            };
            let (again, seen) = run_interruptibly(py, work, |_| Ok(()))?;
            seen?;
            found = again;
        }
        found.map_err(|error| path_error(py, error))
    }

    fn change(&self, change: impl FnOnce(&mut Cell) -> Result<(), RobotError>) -> PyResult<()> {
        self.cell_with_solver.change(change).map_err(input_error)
    }
}

/// Returns whether a deadline ended a question.
fn ended_by_deadline(found: &Result<PathRow, PathError>) -> bool {
    let limit = match found {
        Ok(row) => row.limit,
        Err(PathError::Query(Error::Unresolved(known))) => Some(known.limit),
        Err(_) => None,
    };
    limit == Some(Limit::Deadline)
}

fn pose_or_identity(given: Option<&Bound<'_, PyAny>>) -> PyResult<Pose> {
    given.map_or(Ok(Pose::IDENTITY), |pose| read_pose(pose, "pose"))
}

/// Converts an error about a path to a Python exception.
fn path_error(py: Python<'_>, error: PathError) -> PyErr {
    match error {
        PathError::Query(Error::Unresolved(known)) => unresolved_error(py, &known),
        error => input_error(error),
    }
}
