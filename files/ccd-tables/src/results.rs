//! The rows of the table of results, which are written as CSV.

#[cfg(test)]
mod tests;

mod answers;
mod columns;
mod status;

pub use answers::{ANSWERS, QuestionAnswers};
pub use columns::{
    COLUMNS, COUNTER_COLUMNS, CellGetter, Column, ITEM_COLUMNS, Line, names, reordered_columns,
};
pub use status::Status;

use crate::motions::RowProblem;
use crate::movements::Movements;
use ccd_core::glam::DVec3;
use ccd_core::{Answer, Contact, HitKind, Outcome, Overlap, Question, Stats};
use serde::Deserialize;
use std::io;

/// Returns the columns of the answers to a question, without counters.
pub fn columns(question: Question) -> Vec<Column> {
    let more_columns = QuestionAnswers::of(question).more_columns;
    COLUMNS
        .into_iter()
        .chain(more_columns.iter().copied())
        .collect()
}

/// The clearance that distances are compared with, and by how much the measured bodies exceed their shapes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ClearanceAndExcess {
    /// The required distance of the bodies, if one is given.
    pub clearance: Option<f64>,
    /// The sum of both bodies' [excess](ccd_core::Body::with_excess) over their shapes; named in a reason, never added
    /// to a distance.
    pub excess: f64,
}

impl ClearanceAndExcess {
    /// Returns the reason why a clearance is proven neither kept nor violated.
    fn reason_clearance_undecided(&self) -> String {
        let bounds = "--clearance is within the bounds of the distance";
        match self.clearance {
            _ if self.excess > 0.0 => format!(
                "{bounds}, which are wider by the excess of the bodies over their shapes: up to {:.3e} together",
                self.excess
            ),
            // A clearance of 0 is never violated, and only bodies that are proven apart keep it.
            Some(0.0) => format!("{bounds}: the bodies may touch"),
            _ => format!("{bounds}; a smaller --tolerance may decide"),
        }
    }
}

/// One row of the table of results, in the order of [`COLUMNS`]; cells that do not apply are empty.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
pub struct ResultRow {
    /// The id in the table of motions.
    pub id: String,
    /// The kind of the answer, or [`Status::Error`] for a row that is not a valid query.
    pub status: Status,
    /// The time before which there is no contact; for a distance, the time at which the bodies are nearest. A free row
    /// has the end of the motions. The time is certified unless the bound is the published one.
    pub time: Option<f64>,
    /// A lower bound of the distance at `time`; for a closest approach, at all times. Empty when free: the bodies are
    /// proven to keep the margin, but their distance is not known.
    pub distance_lower: Option<f64>,
    /// An upper bound of the distance at `time`. For a question about a distance, it bounds the distance of the
    /// shapes; for a contact, the distance of the bodies, which may [exceed](ccd_core::Body::with_excess) the shapes.
    pub distance_upper: Option<f64>,
    /// The unit normal from A to B at `time`, in the world frame.
    pub normal: [Option<f64>; 3],
    /// The nearest point of A, in the world frame at `time`.
    pub witness_a: [Option<f64>; 3],
    /// The nearest point of B, in the world frame at `time`.
    pub witness_b: [Option<f64>; 3],
    /// The mesh feature of A in contact, such as `v7`.
    pub feature_a: Option<String>,
    /// The mesh feature of B in contact, such as `e3`.
    pub feature_b: Option<String>,
    /// The number of pairs of nodes visited.
    pub iterations: Option<u64>,
    /// The number of calls of the distance backend.
    pub oracle_calls: Option<u64>,
    /// The time of this query alone, in microseconds.
    pub micros: Option<f64>,
    /// The problem of a row of status `error`, the limit that ended a query, or the reason why a clearance is
    /// unverified.
    pub reason: Option<String>,
    /// The time after which there is no contact.
    #[serde(skip)]
    pub last_time: Option<f64>,
    /// The name of A in a scene or a cell: a body, a link, or an object that is attached to a link.
    #[serde(skip)]
    pub item_a: Option<String>,
    /// The name of B in a scene or a cell.
    #[serde(skip)]
    pub item_b: Option<String>,
    /// The counters of the work that the query took.
    #[serde(skip)]
    pub stats: Option<Stats>,
}

impl ResultRow {
    /// Creates the row of an invalid query.
    pub fn error(id: &str, why: &RowProblem) -> Self {
        ResultRow {
            id: id.to_owned(),
            reason: Some(why.to_string()),
            ..ResultRow::default()
        }
    }

    /// Creates the row of a contact; its id and its counts stay empty.
    pub fn from_hit(hit: &ccd_core::Hit) -> Self {
        let row = ResultRow {
            status: Status::from(&hit.kind),
            ..ResultRow::default()
        };
        row.with_time(hit.time).with_hit(&hit.kind)
    }

    /// Creates the row of two features in contact; its status and its counts have their defaults.
    pub fn from_feature_pair(id: &str, time: f64, pair: &Contact) -> Self {
        let row = ResultRow {
            id: id.to_owned(),
            ..ResultRow::default()
        };
        row.with_time(time).with_contact(pair)
    }

    /// Creates the row of an answer to a question.
    pub fn new(
        movements: &Movements,
        (question, answer): (Question, &Answer),
        micros: f64,
        clearance_and_excess: ClearanceAndExcess,
    ) -> Self {
        let outcome = &answer.outcome;
        let status = Status::of(question, outcome, clearance_and_excess.clearance);
        let row = ResultRow {
            iterations: Some(answer.stats.iterations),
            oracle_calls: Some(answer.stats.oracle_calls),
            micros: Some(micros),
            reason: match (outcome.limit(), status) {
                (Some(limit), _) => Some(limit.to_string()),
                (None, Status::Unverified) => {
                    Some(clearance_and_excess.reason_clearance_undecided())
                }
                (None, _) => None,
            },
            stats: Some(answer.stats),
            id: movements.id().to_owned(),
            status,
            ..ResultRow::default()
        };
        let row = if question.is_for_a_distance() {
            row.with_distance(outcome, movements.duration())
        } else {
            row.with_contact_outcome(outcome, movements.duration())
        };
        ResultRow {
            time: row.time.map(|time| movements.table_time_rounded_down(time)),
            last_time: row
                .last_time
                .map(|time| movements.table_time_rounded_up(time)),
            ..row
        }
    }

    /// Returns the row with the time and the contact of an outcome filled in.
    fn with_contact_outcome(self, outcome: &Outcome, duration: f64) -> Self {
        match *outcome {
            Outcome::Free { .. } => self.with_time(duration),
            Outcome::Contact { time, contact } => self.with_time(time).with_contact(&contact),
            Outcome::Touching { contact } => self.with_time(0.0).with_contact(&contact),
            Outcome::Overlapping { overlap, .. } => self.with_time(0.0).with_overlap(&overlap),
            Outcome::Interval { first, last } => ResultRow {
                last_time: Some(last.time),
                ..self.with_time(first.time).with_hit(&first.kind)
            },
            Outcome::Unresolved(unresolved) => ResultRow {
                last_time: Some(unresolved.safe_from).filter(|time| time.is_finite()),
                ..self.with_time(unresolved.safe_until)
            },
            Outcome::LeastDistance { .. } => self,
        }
    }

    /// Returns the row with the time, the distance and the nearest points of an outcome filled in.
    fn with_distance(self, outcome: &Outcome, duration: f64) -> Self {
        let row = match *outcome {
            Outcome::Overlapping { overlap, upper } => {
                let row = self.with_time(0.0).with_overlap(&overlap);
                // If one body is inside the other, `upper` is the only upper bound.
                let exceeds = Some(upper).filter(|upper| *upper > 0.0);
                return ResultRow {
                    distance_upper: row.distance_upper.or(exceeds),
                    ..row
                };
            }
            Outcome::Free { .. } => self.with_time(duration),
            _ => match outcome.nearest_contact() {
                Some((time, contact)) => self.with_time(time).with_contact(&contact),
                None => self,
            },
        };
        ResultRow {
            distance_lower: Some(outcome.lower()),
            distance_upper: Some(outcome.upper()).filter(|upper| upper.is_finite()),
            ..row
        }
    }

    fn with_hit(self, kind: &HitKind) -> Self {
        match kind {
            HitKind::Contact(contact) | HitKind::Touching(contact) => self.with_contact(contact),
            HitKind::Overlapping(overlap) => self.with_overlap(overlap),
        }
    }

    fn with_time(self, time: f64) -> Self {
        ResultRow {
            time: Some(time),
            ..self
        }
    }

    fn with_overlap(self, overlap: &Overlap) -> Self {
        match overlap {
            Overlap::Pieces(contact) => self.with_contact(contact),
            // The common point lies in both bodies.
            Overlap::AInsideB(point) | Overlap::BInsideA(point) => ResultRow {
                witness_a: vector_cells(*point),
                witness_b: vector_cells(*point),
                ..self
            },
        }
    }

    fn with_contact(self, contact: &Contact) -> Self {
        let separation = &contact.separation;
        ResultRow {
            distance_lower: Some(separation.lower),
            distance_upper: Some(separation.upper),
            normal: vector_cells(separation.normal),
            witness_a: vector_cells(separation.witness_a),
            witness_b: vector_cells(separation.witness_b),
            feature_a: Some(contact.feature_a.to_string()),
            feature_b: Some(contact.feature_b.to_string()),
            ..self
        }
    }
}

/// Reads a table of results; the columns after [`COLUMNS`] are not read.
///
/// # Errors
/// If it is no such table.
pub fn read(input: impl io::Read) -> Result<Vec<ResultRow>, csv::Error> {
    let mut reader = csv::Reader::from_reader(input);
    let header = reader.headers()?;
    let names = names(&COLUMNS);
    if !header.iter().take(names.len()).eq(names.iter().copied()) {
        let message = format!(
            "its columns are not the columns of results, {}",
            names.join(",")
        );
        return Err(io::Error::new(io::ErrorKind::InvalidData, message).into());
    }
    let rows = reader.records().map(|record| record?.deserialize(None));
    rows.collect()
}

fn vector_cells(v: DVec3) -> [Option<f64>; 3] {
    v.to_array().map(Some)
}
