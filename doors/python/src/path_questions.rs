//! Answers questions of Python about one path in a cell.

use crate::cell_remarks::{AskedPaths, warn_of_question};
use crate::cell_solver::CellWithCachedSolvers;
use crate::errors::{bounds_interruption, input_error, interruption_error, time_interruption};
use crate::interruptible::run_interruptibly;
use crate::path_answers::ended_by_deadline;
use crate::path_array::GivenPath;
use ccd_tables::path_rows::{PathQuestion, PathRow};
use pyo3::prelude::*;
use rigid_ccd::answer::ClearanceVerdict;
use rigid_ccd::{Question, Settings};
use rigid_ccd_robot::{ClearanceRange, PathError, RangeSettings};
use std::sync::Arc;
use std::time::Duration;

/// The time limit of a first attempt on this thread. A question that takes longer is repeated from its start on another
/// thread, while this thread checks for Ctrl-C. Starting a thread for every question would take longer than most questions.
const FIRST_ATTEMPT_TIME_LIMIT: Duration = Duration::from_millis(5);

/// Reads a path, and answers a question about it.
pub(crate) fn answer_path(
    py: Python<'_>,
    solvers: &CellWithCachedSolvers,
    question: Question,
    path: &Bound<'_, PyAny>,
    mut settings: Settings,
) -> PyResult<PathRow> {
    let cell = solvers.cell();
    let path = GivenPath::read(path, cell.robot())?;
    settings.check().map_err(input_error)?;
    warn_of_question(py, &cell, &AskedPaths::Path(&path), settings.tolerance)?;
    let path_question = PathQuestion {
        question,
        clearance: settings.clearance.take(),
    };
    let ask = |settings: Settings| {
        solvers.ask(&settings, |solver| match &path {
            GivenPath::Configurations(array) => path_question.ask(solver, &array.configurations()),
            GivenPath::Curve(curve) => path_question.ask(solver, curve),
        })
    };
    let limit = settings.deadline.unwrap_or(Duration::MAX);
    let first_limit = limit.min(FIRST_ATTEMPT_TIME_LIMIT);
    let first_settings = Settings {
        deadline: Some(first_limit),
        ..settings.clone()
    };
    let mut answer = py.detach(|| ask(first_settings));
    if ended_by_deadline(&answer) && limit > first_limit {
        let work = |stop: &Arc<_>| {
            let settings = Settings {
                deadline: settings.deadline.map(|_| limit - first_limit),
                ..settings
            };
            ask(settings.stopped_by(stop))
        };
        let (second_answer, interruption) = run_interruptibly(py, work, |_| Ok(()))?;
        interruption
            .map_err(|cause| interrupted_question_error(py, cause, question, &second_answer))?;
        answer = second_answer;
    }
    answer.map_err(input_error)
}

/// Makes the exception for an interrupted question, with the bounds known so far.
fn interrupted_question_error(
    py: Python<'_>,
    cause: PyErr,
    question: Question,
    answer: &Result<PathRow, PathError>,
) -> PyErr {
    let row = answer.as_ref().ok().map(|answer| &answer.row);
    if question.is_for_a_distance() {
        let lower = row.and_then(|row| row.distance_lower).unwrap_or(0.0);
        let upper = row.and_then(|row| row.distance_upper);
        return bounds_interruption(py, cause, [lower, upper.unwrap_or(f64::INFINITY)]);
    }
    let known = row.filter(|_| question == Question::FirstContact);
    time_interruption(py, cause, known.and_then(|row| row.time))
}

/// Divides a path into ranges, as Python objects.
pub(crate) fn path_ranges<'py>(
    py: Python<'py>,
    solvers: &CellWithCachedSolvers,
    path: &Bound<'py, PyAny>,
    range_settings: RangeSettings,
    settings: Settings,
) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let cell = solvers.cell();
    let path = GivenPath::read(path, cell.robot())?;
    warn_of_question(py, &cell, &AskedPaths::Path(&path), settings.tolerance)?;
    let work = |stop: &Arc<_>| {
        solvers.ask(&settings.stopped_by(stop), |solver| match &path {
            GivenPath::Configurations(array) => {
                solver.clearance_ranges(&array.configurations(), range_settings)
            }
            GivenPath::Curve(curve) => solver.clearance_ranges(curve, range_settings),
        })
    };
    let (ranges, interruption) = run_interruptibly(py, work, |_| Ok(()))?;
    let ranges = ranges.map_err(input_error)?;
    let ranges = range_objects(py, &path, &ranges)?;
    match interruption {
        Ok(()) => Ok(ranges),
        Err(cause) => Err(interruption_error(py, cause, ranges)),
    }
}

fn range_objects<'py>(
    py: Python<'py>,
    path: &GivenPath,
    ranges: &[ClearanceRange],
) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let class = py.import("rigid_ccd")?.getattr("PathRange")?;
    // Times are rounded so that a reported range is within the proven one.
    let mut start = path.start_time();
    let ranges = ranges.iter().map(|range| {
        let (clearance, end) = match range.verdict {
            ClearanceVerdict::Kept => ("kept", path.time(range.to)),
            ClearanceVerdict::Violated => ("violated", path.time(range.to)),
            ClearanceVerdict::Unverified => ("unverified", path.latest_time(range.to)),
        };
        let from = std::mem::replace(&mut start, end);
        class.call1((from, end, clearance))
    });
    ranges.collect()
}
