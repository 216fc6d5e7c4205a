//! Answers about paths of robots as rows of tables.

use crate::results::{COLUMNS, Column, ITEM_COLUMNS, ResultRow, Status};
use rigid_ccd::answer::{ClearanceVerdict, Limit};
use rigid_ccd::{Error, Question};
use rigid_ccd_robot::{
    CellSolver, Path, PathAnswer, PathContact, PathError, PathOutcome, PathPoint,
};

/// A question about a path, and the clearance that its answers are compared with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathQuestion {
    /// The question, one of [`CellSolver::QUESTIONS`]. For any contact, rows have only a status.
    pub question: Question,
    /// The clearance that a least distance is compared with. The status of a row says whether the path keeps it.
    pub clearance: Option<f64>,
}

/// The answer about a path as a row.
#[derive(Clone, Debug)]
pub struct PathRow {
    /// The row, without an id. Its time is [`Path::time`].
    pub row: ResultRow,
    /// The point of the path of the contact or the least distance, or up to which the path is free.
    pub at: Option<PathPoint>,
    /// The limit that ended the search.
    pub limit: Option<Limit>,
    /// The [tolerance](PathAnswer::tolerance) that the answer meets.
    pub tolerance: f64,
}

impl From<ResultRow> for PathRow {
    /// Creates the answer for a row without a search, such as a bad row.
    fn from(row: ResultRow) -> Self {
        PathRow {
            row,
            at: None,
            limit: None,
            tolerance: f64::NAN,
        }
    }
}

/// Returns the columns of a table of answers to a question about paths.
pub fn columns(question: Question) -> Vec<Column> {
    let has_pairs = question != Question::AnyContact;
    let is_in_table = |name: &str| match name {
        "id" | "status" | "micros" | "reason" => true,
        "time" | "distance_lower" | "distance_upper" => has_pairs,
        _ if name.starts_with("witness_") || name.starts_with("feature_") => has_pairs,
        _ => false,
    };
    let mut columns = COLUMNS.to_vec();
    columns.retain(|Column(name, _)| is_in_table(name));
    if has_pairs {
        let after_time = columns.iter().position(|Column(name, _)| *name == "time");
        let after_time = after_time.map_or(0, |time| time + 1);
        columns.splice(after_time..after_time, ITEM_COLUMNS);
    }
    columns
}

impl PathQuestion {
    /// Asks a solver this question about a path.
    ///
    /// # Errors
    /// [`PathError`].
    pub fn ask<P: Path + ?Sized>(
        self,
        solver: &mut CellSolver<'_>,
        path: &P,
    ) -> Result<PathRow, PathError> {
        if self.question != Question::AnyContact {
            let answer = solver.answer(self.question, path)?;
            return Ok(PathRow::from_answer(self, &answer, path));
        }
        // The search stops at any contact, and measures nothing.
        let (status, limit) = match solver.is_free(path) {
            Ok(true) => (Status::Free, None),
            Ok(false) => (Status::Contact, None),
            Err(PathError::Query(Error::Unresolved(known))) => {
                (Status::Unresolved, Some(known.limit))
            }
            Err(error) => return Err(error),
        };
        let row = PathRow::new(status, limit, solver.met_tolerance());
        Ok(match limit {
            // Nothing is known after the start.
            Some(_) => row.with_point(path, PathPoint::START),
            None => row,
        })
    }

    /// Returns the status of the row of an outcome.
    fn status(self, outcome: &PathOutcome<'_>) -> Status {
        match outcome {
            PathOutcome::Free => Status::Free,
            PathOutcome::Contact(contact) => {
                let overlaps = contact.distance_bounds[1] == 0.0 && contact.at.time() == 0.0;
                if overlaps {
                    Status::Overlapping
                } else {
                    Status::Contact
                }
            }
            PathOutcome::LeastDistance { .. } | PathOutcome::Unresolved(_) => {
                let verdict = self
                    .clearance
                    .map(|required| outcome.clearance_verdict(required));
                match (verdict, outcome.limit()) {
                    (Some(ClearanceVerdict::Kept), _) => Status::Kept,
                    (Some(ClearanceVerdict::Violated), _) => Status::Violated,
                    (_, Some(_)) => Status::Unresolved,
                    (Some(ClearanceVerdict::Unverified), None) => Status::Unverified,
                    (None, None) => Status::Measured,
                }
            }
        }
    }

    /// Answers the question; an error becomes a row.
    pub fn answer<P: Path + ?Sized>(self, solver: &mut CellSolver<'_>, path: &P) -> PathRow {
        self.ask(solver, path).unwrap_or_else(|error| {
            PathRow::from(ResultRow {
                reason: Some(error.to_string()),
                ..ResultRow::default()
            })
        })
    }
}

impl PathRow {
    fn new(status: Status, limit: Option<Limit>, tolerance: f64) -> Self {
        let row = ResultRow {
            status,
            reason: limit.map(|limit| limit.to_string()),
            ..ResultRow::default()
        };
        PathRow {
            limit,
            tolerance,
            ..PathRow::from(row)
        }
    }

    fn from_answer<P: Path + ?Sized>(
        question: PathQuestion,
        answer: &PathAnswer<'_>,
        path: &P,
    ) -> Self {
        let outcome = &answer.outcome;
        let status = question.status(outcome);
        let mut row = PathRow::new(status, outcome.limit(), answer.tolerance);
        if status == Status::Unverified {
            let reason = "the clearance is within the bounds of the distance; a smaller tolerance may decide";
            row.row.reason = Some(reason.to_owned());
        }
        let is_distance = question.question.is_for_a_distance();
        let bounds = match outcome {
            PathOutcome::Contact(contact) => Some(contact.distance_bounds),
            _ => is_distance.then(|| [outcome.lower(), outcome.upper()]),
        };
        if let Some([lower, upper]) = bounds {
            row.row.distance_lower = Some(lower);
            row.row.distance_upper = Some(upper).filter(|upper| upper.is_finite());
        }
        match outcome.nearest() {
            Some(nearest) => row.with_contact(path, &nearest),
            None if is_distance => row,
            None => row.with_point(path, answer.free_until),
        }
    }

    fn with_point<P: Path + ?Sized>(mut self, path: &P, point: PathPoint) -> Self {
        self.row.time = Some(path.time(point));
        self.at = Some(point);
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

#[cfg(test)]
mod tests;
