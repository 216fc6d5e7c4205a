//! Answers about paths in a cell: as objects, and as rows of a table.

use crate::errors::input_error;
use crate::settings::{CONTACT_SETTING_NAMES, DISTANCE_QUERY_SETTING_NAMES};
use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray, UInt64Array};
use arrow_schema::ArrowError;
use pyo3::prelude::*;
use rigid_ccd::Error;
use rigid_ccd::answer::Limit;
use rigid_ccd::glam::DVec3;
use rigid_ccd_robot::{CellSolver, PathContact, PathError, PathOutcome, PathPoint};
use std::sync::Arc;

/// A question about many paths.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum PathQuestion {
    IsFree,
    FirstContact,
    ClosestApproach,
}

/// The answer about a path.
pub(crate) struct PathRow {
    status: &'static str,
    /// Where the contact or the nearest pair is, or up to where the path is free: the segment, and the share of it.
    pub(crate) at: Option<(usize, f64)>,
    /// The names of the pair that touches or is nearest.
    between: Option<[String; 2]>,
    witnesses: Option<[DVec3; 2]>,
    pub(crate) lower: f64,
    pub(crate) upper: f64,
    /// The limit that ended the search.
    pub(crate) limit: Option<Limit>,
    /// What is wrong with the path.
    error: Option<String>,
}

impl PathQuestion {
    pub(crate) fn from_name(name: &str) -> PyResult<Self> {
        match name {
            "is-free" => Ok(PathQuestion::IsFree),
            "first-contact" => Ok(PathQuestion::FirstContact),
            "closest-approach" => Ok(PathQuestion::ClosestApproach),
            _ => Err(input_error(format!(
                "ask: '{name}' is not is-free, first-contact or closest-approach"
            ))),
        }
    }

    pub(crate) fn allowed_setting_names(self) -> &'static [&'static str] {
        match self {
            PathQuestion::IsFree | PathQuestion::FirstContact => CONTACT_SETTING_NAMES,
            PathQuestion::ClosestApproach => DISTANCE_QUERY_SETTING_NAMES,
        }
    }

    /// Answers the question.
    pub(crate) fn ask(
        self,
        solver: &mut CellSolver<'_>,
        path: &[&[f64]],
    ) -> Result<PathRow, PathError> {
        match self {
            PathQuestion::IsFree => solver.is_free(path).map(PathRow::from_is_free),
            PathQuestion::FirstContact => PathRow::first_contact(solver, path),
            PathQuestion::ClosestApproach => PathRow::closest_approach(solver, path),
        }
    }

    /// Answers the question; an error becomes a row.
    pub(crate) fn answer(self, solver: &mut CellSolver<'_>, path: &[&[f64]]) -> PathRow {
        let row = self.ask(solver, path);
        row.unwrap_or_else(|error| match error {
            PathError::Query(Error::Unresolved(known)) => PathRow {
                limit: Some(known.limit),
                ..PathRow::from_status("unresolved")
            },
            error => PathRow {
                error: Some(error.to_string()),
                ..PathRow::from_status("error")
            },
        })
    }
}

impl PathRow {
    fn from_status(status: &'static str) -> Self {
        PathRow {
            status,
            at: None,
            between: None,
            witnesses: None,
            lower: f64::NAN,
            upper: f64::NAN,
            limit: None,
            error: None,
        }
    }

    fn from_is_free(is_free: bool) -> Self {
        PathRow::from_status(if is_free { "free" } else { "contact" })
    }

    pub(crate) fn is_free(&self) -> bool {
        self.status == "free"
    }

    fn first_contact(solver: &mut CellSolver<'_>, path: &[&[f64]]) -> Result<Self, PathError> {
        Ok(match solver.first_contact(path)? {
            PathOutcome::Free => PathRow::from_status("free"),
            PathOutcome::Contact(contact) => PathRow::from_status("contact").with_pair(&contact),
            PathOutcome::Unresolved { free_until, limit } => {
                let PathPoint { segment, share } = free_until;
                PathRow {
                    at: Some((segment, share)),
                    limit: Some(limit),
                    ..PathRow::from_status("unresolved")
                }
            }
        })
    }

    fn closest_approach(solver: &mut CellSolver<'_>, path: &[&[f64]]) -> Result<Self, PathError> {
        let found = solver.closest_approach(path)?;
        let status = match found.limit {
            Some(_) => "unresolved",
            // As for two bodies: what may touch counts as contact.
            None if found.lower > 0.0 => "apart",
            None => "contact",
        };
        let row = PathRow {
            lower: found.lower,
            upper: found.upper,
            limit: found.limit,
            ..PathRow::from_status(status)
        };
        Ok(match &found.nearest {
            Some(nearest) => row.with_pair(nearest),
            None => row,
        })
    }

    fn with_pair(self, contact: &PathContact<'_>) -> Self {
        PathRow {
            at: Some((contact.at.segment, contact.at.share)),
            between: Some(contact.items.map(|item| item.name().to_owned())),
            witnesses: Some(contact.witnesses),
            ..self
        }
    }

    /// Returns the pair as an object of Python; `None` without one.
    pub(crate) fn contact<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let (Some(at), Some([a, b]), Some(witnesses)) = (self.at, &self.between, self.witnesses)
        else {
            return Ok(None);
        };
        let class = py.import("rigid_ccd")?.getattr("PathContact")?;
        let [wa, wb] = witnesses.map(|point| (point.x, point.y, point.z));
        class.call1((at.0, at.1, a, b, wa, wb)).map(Some)
    }
}

/// Returns the answers to a question as a table.
pub(crate) fn path_table(rows: &[PathRow], ask: PathQuestion) -> Result<RecordBatch, ArrowError> {
    let status: StringArray = rows.iter().map(|row| Some(row.status)).collect();
    let mut columns: Vec<(&str, ArrayRef)> = vec![("status", Arc::new(status))];
    if ask != PathQuestion::IsFree {
        let segments: UInt64Array = rows
            .iter()
            .map(|row| row.at.map(|(segment, _)| segment as u64))
            .collect();
        columns.push(("segment", Arc::new(segments)));
        columns.push(("share", numbers(rows, |row| row.at.map(|(_, share)| share))));
        for (k, column) in ["a", "b"].into_iter().enumerate() {
            let names: StringArray = rows
                .iter()
                .map(|row| row.between.as_ref().map(|between| between[k].as_str()))
                .collect();
            columns.push((column, Arc::new(names)));
        }
    }
    if ask == PathQuestion::ClosestApproach {
        let known = |number: f64| (!number.is_nan()).then_some(number);
        columns.push(("lower", numbers(rows, |row| known(row.lower))));
        columns.push(("upper", numbers(rows, |row| known(row.upper))));
    }
    if ask != PathQuestion::IsFree {
        let witnesses = ["wa_x", "wa_y", "wa_z", "wb_x", "wb_y", "wb_z"];
        for (k, column) in witnesses.into_iter().enumerate() {
            let coordinate = |row: &PathRow| row.witnesses.map(|points| points[k / 3][k % 3]);
            columns.push((column, numbers(rows, coordinate)));
        }
    }
    let errors: StringArray = rows
        .iter()
        .map(|row| match (&row.error, row.limit) {
            (Some(error), _) => Some(error.clone()),
            (None, Some(limit)) => Some(format!("a limit was reached: {limit}")),
            (None, None) => None,
        })
        .collect();
    columns.push(("error", Arc::new(errors)));
    RecordBatch::try_from_iter_with_nullable(
        columns
            .into_iter()
            .map(|(name, column)| (name, column, true)),
    )
}

fn numbers(rows: &[PathRow], number: impl Fn(&PathRow) -> Option<f64>) -> ArrayRef {
    let numbers: Float64Array = rows.iter().map(number).collect();
    Arc::new(numbers)
}
