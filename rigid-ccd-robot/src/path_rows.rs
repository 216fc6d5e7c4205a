//! Answers about paths as rows of tables, for the command and the Python package. No stable interface.

use crate::error::PathError;
use crate::path::Path;
use crate::path_point::PathPoint;
use crate::solver::{CellSolver, PathContact, PathOutcome};
use rigid_ccd::Error;
use rigid_ccd::answer::{ClearanceVerdict, Limit};
use rigid_ccd::batch::Question;
use rigid_ccd::table::results::{COLUMNS, Column, ITEM_COLUMNS, ResultRow, Status};

/// A question about a path, chosen at run time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PathQuestion {
    /// Is the path free?
    #[default]
    IsFree,
    /// What touches first, and where?
    FirstContact,
    /// How near does any pair come to touching?
    ClosestApproach,
}

/// The answer about a path.
#[derive(Clone, Debug)]
pub struct PathAnswer {
    /// The answer as a row, without an id. Its time is [`Path::time`].
    pub row: ResultRow,
    /// Where the pair of the row is, or up to where the path is free.
    pub at: Option<PathPoint>,
    /// The limit that ended the search.
    pub limit: Option<Limit>,
    /// The [tolerance](CellSolver::met_tolerance) that the answer meets.
    pub tolerance: f64,
}

impl PathQuestion {
    /// All questions, in the order of the command's help.
    pub const ALL: [PathQuestion; 3] = [
        PathQuestion::IsFree,
        PathQuestion::FirstContact,
        PathQuestion::ClosestApproach,
    ];

    /// Returns the name of the question, as of the same one about two bodies.
    pub fn name(self) -> &'static str {
        let question = match self {
            PathQuestion::IsFree => Question::IsFree,
            PathQuestion::FirstContact => Question::FirstContact,
            PathQuestion::ClosestApproach => Question::ClosestApproach,
        };
        question.name()
    }

    /// Returns the columns of a table of answers.
    pub fn columns(self) -> Vec<Column> {
        let is_in_table = |name: &str| match name {
            "id" | "status" | "micros" | "reason" => true,
            "time" | "distance_lower" | "distance_upper" => self != PathQuestion::IsFree,
            _ if name.starts_with("witness_") || name.starts_with("feature_") => {
                self != PathQuestion::IsFree
            }
            _ => false,
        };
        let mut columns = COLUMNS.to_vec();
        columns.retain(|Column(name, _)| is_in_table(name));
        if self != PathQuestion::IsFree {
            let after_time = columns.iter().position(|Column(name, _)| *name == "time");
            let after_time = after_time.map_or(0, |time| time + 1);
            columns.splice(after_time..after_time, ITEM_COLUMNS);
        }
        columns
    }

    /// Asks a solver this question about a path. With a clearance, the status of a closest approach says whether it is
    /// kept.
    ///
    /// # Errors
    /// [`PathError`].
    pub fn ask<P: Path + ?Sized>(
        self,
        solver: &mut CellSolver<'_>,
        path: &P,
        clearance: Option<f64>,
    ) -> Result<PathAnswer, PathError> {
        let answer = match self {
            PathQuestion::IsFree => {
                let is_free = solver.is_free(path)?;
                let status = if is_free {
                    Status::Free
                } else {
                    Status::Contact
                };
                PathAnswer::from_status(status)
            }
            PathQuestion::FirstContact => PathAnswer::first_contact(solver, path)?,
            PathQuestion::ClosestApproach => PathAnswer::closest_approach(solver, path, clearance)?,
        };
        Ok(PathAnswer {
            tolerance: solver.met_tolerance(),
            ..answer
        })
    }

    /// Answers the question; an error becomes a row.
    pub fn answer<P: Path + ?Sized>(
        self,
        solver: &mut CellSolver<'_>,
        path: &P,
        clearance: Option<f64>,
    ) -> ResultRow {
        match self.ask(solver, path, clearance) {
            Ok(answer) => answer.row,
            Err(PathError::Query(Error::Unresolved(known))) => {
                PathAnswer::from_status(Status::Unresolved)
                    .with_limit(known.limit)
                    .row
            }
            Err(error) => ResultRow {
                reason: Some(error.to_string()),
                ..ResultRow::default()
            },
        }
    }
}

impl PathAnswer {
    fn from_status(status: Status) -> Self {
        let row = ResultRow {
            status,
            ..ResultRow::default()
        };
        PathAnswer {
            row,
            at: None,
            limit: None,
            tolerance: f64::NAN,
        }
    }

    fn first_contact<P: Path + ?Sized>(
        solver: &mut CellSolver<'_>,
        path: &P,
    ) -> Result<Self, PathError> {
        Ok(match solver.first_contact(path)? {
            PathOutcome::Free => {
                let mut answer = PathAnswer::from_status(Status::Free);
                answer.row.time = Some(end_time(path));
                answer
            }
            PathOutcome::Contact(contact) => {
                let [lower, upper] = contact.distance_bounds;
                let overlaps = upper == 0.0 && contact.at.time() == 0.0;
                let status = if overlaps {
                    Status::Overlapping
                } else {
                    Status::Contact
                };
                let mut answer = PathAnswer::from_status(status).with_contact(path, &contact);
                answer.row.distance_lower = Some(lower);
                answer.row.distance_upper = Some(upper).filter(|upper| upper.is_finite());
                answer
            }
            PathOutcome::Unresolved { free_until, limit } => {
                PathAnswer::from_status(Status::Unresolved)
                    .with_limit(limit)
                    .with_point(path, free_until)
            }
        })
    }

    fn closest_approach<P: Path + ?Sized>(
        solver: &mut CellSolver<'_>,
        path: &P,
        clearance: Option<f64>,
    ) -> Result<Self, PathError> {
        let found = solver.closest_approach(path)?;
        let verdict = clearance.map(|clearance| found.clearance_verdict(clearance));
        let status = match (verdict, found.limit) {
            (Some(ClearanceVerdict::Kept), _) => Status::Kept,
            (Some(ClearanceVerdict::Violated), _) => Status::Violated,
            (_, Some(_)) => Status::Unresolved,
            (Some(ClearanceVerdict::Unverified), None) => Status::Unverified,
            (None, None) => Status::Measured,
        };
        let mut answer = PathAnswer::from_status(status);
        answer.row.distance_lower = Some(found.lower);
        answer.row.distance_upper = Some(found.upper).filter(|upper| upper.is_finite());
        if let Some(limit) = found.limit {
            answer = answer.with_limit(limit);
        } else if status == Status::Unverified {
            let reason = "the clearance is within the bounds of the distance; a smaller tolerance may decide";
            answer.row.reason = Some(reason.to_owned());
        }
        Ok(match &found.nearest {
            Some(nearest) => answer.with_contact(path, nearest),
            None => answer,
        })
    }

    fn with_limit(mut self, limit: Limit) -> Self {
        self.row.reason = Some(limit.to_string());
        self.limit = Some(limit);
        self
    }

    fn with_point<P: Path + ?Sized>(mut self, path: &P, at: PathPoint) -> Self {
        self.row.time = Some(path.time(at));
        self.at = Some(at);
        self
    }

    fn with_contact<P: Path + ?Sized>(mut self, path: &P, contact: &PathContact<'_>) -> Self {
        let [a, b] = contact.items.map(|item| Some(item.name().to_owned()));
        (self.row.item_a, self.row.item_b) = (a, b);
        if let Some(witnesses) = contact.witnesses {
            let [a, b] = witnesses.map(|point| point.to_array().map(Some));
            (self.row.witness_a, self.row.witness_b) = (a, b);
        }
        let [a, b] = contact
            .features
            .map(|feature| feature.map(|feature| feature.to_string()));
        (self.row.feature_a, self.row.feature_b) = (a, b);
        self.with_point(path, contact.at)
    }
}

/// Returns the time of the end of a path.
fn end_time<P: Path + ?Sized>(path: &P) -> f64 {
    path.time(PathPoint::from_path_position(
        path.segment_count() as f64,
        path.segment_count(),
    ))
}

#[cfg(test)]
mod tests;
