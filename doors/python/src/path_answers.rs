//! Converts names of questions about paths, and answers to Python objects.

use crate::errors::{input_error, path_limit_error};
use ccd_tables::path_rows::PathRow;
use ccd_tables::results::Status;
use pyo3::prelude::*;
use rigid_ccd::Question;
use rigid_ccd::answer::Limit;
use rigid_ccd_robot::{CellSolver, PathError};

/// Returns the question about paths with a name.
pub(crate) fn question_named(name: &str) -> PyResult<Question> {
    let found = Question::from_name(name).filter(|found| CellSolver::QUESTIONS.contains(found));
    found.ok_or_else(|| {
        input_error(format!(
            "question: '{name}' is not is-free, first-contact or closest-approach"
        ))
    })
}

/// Returns the pair of an answer as a Python `PathContact`, or `None` if the answer has no pair.
pub(crate) fn contact_object<'py>(
    py: Python<'py>,
    answer: &PathRow,
) -> PyResult<Option<Bound<'py, PyAny>>> {
    let row = &answer.row;
    let (Some(at), Some(_)) = (answer.at, &row.item_a) else {
        return Ok(None);
    };
    // There are no witness points if the deadline passed before they were found.
    let point =
        |point: [Option<f64>; 3]| <(f64, f64, f64)>::from(point.map(|x| x.unwrap_or(f64::NAN)));
    let (witness_a, witness_b) = (point(row.witness_a), point(row.witness_b));
    let class = py.import("rigid_ccd")?.getattr("PathContact")?;
    let (a, b) = (&row.item_a, &row.item_b);
    let time = row.time;
    let features = (&row.feature_a, &row.feature_b);
    let values = (
        at.segment,
        at.fraction,
        time,
        a,
        b,
        witness_a,
        witness_b,
        features.0,
        features.1,
        answer.tolerance,
    );
    class.call1(values).map(Some)
}

/// Checks that a question about contacts was answered before any limit.
///
/// # Errors
/// `UnresolvedError` if a limit was reached.
pub(crate) fn check_resolved(answer: &PathRow) -> PyResult<()> {
    let Some(limit) = answer.limit else {
        return Ok(());
    };
    Err(path_limit_error(limit, answer.row.time.unwrap_or(0.0)))
}

/// Returns the bounds of a least distance as a Python `PathDistance`. With a clearance, it tells whether it is kept.
pub(crate) fn approach_object<'py>(
    py: Python<'py>,
    answer: &PathRow,
    clearance: Option<f64>,
) -> PyResult<Bound<'py, PyAny>> {
    let row = &answer.row;
    let verdict = clearance.map(|_| match row.status {
        decided @ (Status::Kept | Status::Violated) => decided.name(),
        _ => Status::Unverified.name(),
    });
    let lower = row.distance_lower.unwrap_or(0.0);
    let upper = row.distance_upper.unwrap_or(f64::INFINITY);
    let limit = answer.limit.map(|limit| limit.to_string());
    let class = py.import("rigid_ccd")?.getattr("PathDistance")?;
    let nearest = contact_object(py, answer)?;
    class.call1((lower, upper, nearest, limit, answer.tolerance, verdict))
}

/// Returns whether a deadline ended a question, or the search for witness points of its contact.
pub(crate) fn ended_by_deadline(found: &Result<PathRow, PathError>) -> bool {
    found.as_ref().is_ok_and(|answer| {
        let lacks_witnesses = answer.row.item_a.is_some() && answer.row.witness_a[0].is_none();
        lacks_witnesses || answer.limit == Some(Limit::Deadline)
    })
}
