//! The table of results: answers, written as CSV.

#[cfg(test)]
mod tests;

use crate::table::motions::RowProblem;
use ccd_core::glam::DVec3;
use ccd_core::{Answer, Contact, Outcome, Overlap, Stats};
use serde::Serialize;
use std::io;

/// The columns, in order.
pub(crate) const COLUMNS: [&str; 20] = [
    "id",
    "status",
    "time",
    "distance_lower",
    "distance_upper",
    "normal_x",
    "normal_y",
    "normal_z",
    "witness_a_x",
    "witness_a_y",
    "witness_a_z",
    "witness_b_x",
    "witness_b_y",
    "witness_b_z",
    "feature_a",
    "feature_b",
    "iterations",
    "oracle_calls",
    "micros",
    "reason",
];

/// The columns of the counters, in order; they follow [`COLUMNS`].
pub(crate) const COUNTER_COLUMNS: [&str; 5] = [
    "advancements",
    "oracle_steps",
    "cycles",
    "fallbacks",
    "front",
];

/// The set of columns of a table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Extent {
    /// [`COLUMNS`].
    #[default]
    Results,
    /// [`COLUMNS`] and [`COUNTER_COLUMNS`].
    WithCounters,
}

/// One row, in the order of [`COLUMNS`]; cells that do not apply are empty.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct ResultRow {
    /// The id in the table of motions.
    pub(crate) id: String,
    /// The status.
    pub(crate) status: Status,
    /// The time before which there is no contact, certified unless the bound is the published one; the
    /// duration when free.
    pub(crate) time: Option<f64>,
    /// A lower bound of the distance at `time`; when free, at all times.
    pub(crate) distance_lower: Option<f64>,
    /// An upper bound of the distance at `time`.
    pub(crate) distance_upper: Option<f64>,
    /// The unit vector from A to B, in the world frame.
    pub(crate) normal: [Option<f64>; 3],
    /// The nearest point of A, in the world frame at `time`.
    pub(crate) witness_a: [Option<f64>; 3],
    /// The nearest point of B, in the world frame at `time`.
    pub(crate) witness_b: [Option<f64>; 3],
    /// The feature of A in contact.
    pub(crate) feature_a: Option<String>,
    /// The feature of B in contact.
    pub(crate) feature_b: Option<String>,
    /// The number of pairs of nodes visited.
    pub(crate) iterations: Option<u64>,
    /// The number of calls of the distance backend.
    pub(crate) oracle_calls: Option<u64>,
    /// The time of this query alone, in microseconds.
    pub(crate) micros: Option<f64>,
    /// The problem of an error, or the limit of an unresolved query.
    pub(crate) reason: Option<String>,
    /// The counters.
    #[serde(skip)]
    pub(crate) counters: Counters,
}

/// More counters of a query, in the order of [`COUNTER_COLUMNS`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub(crate) struct Counters {
    /// The number of steps that advanced all pairs together.
    pub(crate) advancements: Option<u64>,
    /// The number of steps of the distance backend's search; 0 where it does not count them.
    pub(crate) oracle_steps: Option<u64>,
    /// The number of returns of the search to an earlier step.
    pub(crate) cycles: Option<u64>,
    /// The number of pairs that a distance backend gave up on and another one answered.
    pub(crate) fallbacks: Option<u64>,
    /// The largest number of pairs that waited at one time.
    pub(crate) front: Option<u64>,
}

impl From<&Stats> for Counters {
    fn from(stats: &Stats) -> Self {
        Counters {
            advancements: Some(stats.advancements),
            oracle_steps: Some(stats.effort.steps),
            cycles: Some(stats.effort.cycles),
            fallbacks: Some(stats.effort.fallbacks),
            front: Some(stats.peak_front),
        }
    }
}

/// The kind of an [`Outcome`], or an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Status {
    /// The bodies come into contact.
    Contact,
    /// The bodies stay apart.
    Free,
    /// The bodies touch at the start.
    Touching,
    /// The bodies overlap at the start.
    Overlapping,
    /// A limit was reached first.
    Unresolved,
    /// The row is not a valid query.
    Error,
}

impl Status {
    /// All statuses, in the order in which they are reported.
    pub(crate) const ALL: [Status; 6] = [
        Status::Contact,
        Status::Free,
        Status::Touching,
        Status::Overlapping,
        Status::Unresolved,
        Status::Error,
    ];

    /// Returns the name in the table.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Status::Contact => "contact",
            Status::Free => "free",
            Status::Touching => "touching",
            Status::Overlapping => "overlapping",
            Status::Unresolved => "unresolved",
            Status::Error => "error",
        }
    }
}

impl From<&Outcome> for Status {
    fn from(outcome: &Outcome) -> Self {
        match outcome {
            Outcome::Contact { .. } => Status::Contact,
            Outcome::Free { .. } => Status::Free,
            Outcome::Touching { .. } => Status::Touching,
            Outcome::Overlapping { .. } => Status::Overlapping,
            Outcome::Unresolved { .. } => Status::Unresolved,
        }
    }
}

/// Returns the time before which there is no contact.
fn safe_time(outcome: &Outcome, duration: f64) -> f64 {
    match *outcome {
        Outcome::Contact { time, .. } => time,
        Outcome::Free { .. } => duration,
        Outcome::Touching { .. } | Outcome::Overlapping { .. } => 0.0,
        Outcome::Unresolved { safe_until, .. } => safe_until,
    }
}

impl ResultRow {
    /// Creates the row of an invalid query.
    pub(crate) fn error(id: &str, why: &RowProblem) -> Self {
        ResultRow {
            reason: Some(why.to_string()),
            ..ResultRow::empty(id, Status::Error)
        }
    }

    /// Creates a row of empty cells, except for the first two.
    fn empty(id: &str, status: Status) -> Self {
        ResultRow {
            id: id.to_owned(),
            status,
            time: None,
            distance_lower: None,
            distance_upper: None,
            normal: [None; 3],
            witness_a: [None; 3],
            witness_b: [None; 3],
            feature_a: None,
            feature_b: None,
            iterations: None,
            oracle_calls: None,
            micros: None,
            reason: None,
            counters: Counters::default(),
        }
    }

    /// Creates the row of an answer.
    pub(crate) fn new(id: &str, duration: f64, answer: &Answer, micros: f64) -> Self {
        let row = ResultRow {
            time: Some(safe_time(&answer.outcome, duration)),
            iterations: Some(answer.stats.iterations),
            oracle_calls: Some(answer.stats.oracle_calls),
            micros: Some(micros),
            counters: Counters::from(&answer.stats),
            ..ResultRow::empty(id, Status::from(&answer.outcome))
        };
        match answer.outcome {
            Outcome::Contact { contact, .. }
            | Outcome::Touching { contact }
            | Outcome::Overlapping {
                overlap: Overlap::Pieces(contact),
            } => row.with_contact(&contact),
            // The point lies in both bodies.
            Outcome::Overlapping {
                overlap: Overlap::AInsideB(point) | Overlap::BInsideA(point),
            } => ResultRow {
                witness_a: cells(point),
                witness_b: cells(point),
                ..row
            },
            Outcome::Free { proven_gap } => ResultRow {
                distance_lower: Some(proven_gap),
                ..row
            },
            Outcome::Unresolved { reason, .. } => ResultRow {
                reason: Some(reason.to_string()),
                ..row
            },
        }
    }

    fn with_contact(self, contact: &Contact) -> Self {
        let separation = &contact.separation;
        ResultRow {
            distance_lower: Some(separation.lower),
            distance_upper: Some(separation.upper),
            normal: cells(separation.normal),
            witness_a: cells(separation.witness_a),
            witness_b: cells(separation.witness_b),
            feature_a: Some(contact.feature_a.to_string()),
            feature_b: Some(contact.feature_b.to_string()),
            ..self
        }
    }
}

/// Returns the columns of a table.
pub(crate) fn columns(extent: Extent) -> Vec<&'static str> {
    let more: &[&str] = match extent {
        Extent::Results => &[],
        Extent::WithCounters => &COUNTER_COLUMNS,
    };
    [&COLUMNS, more].concat()
}

/// Writes a row; numbers read back to the same bits.
///
/// # Errors
/// The writer's output cannot be written to.
pub(crate) fn write(
    writer: &mut csv::Writer<impl io::Write>,
    extent: Extent,
    row: &ResultRow,
) -> Result<(), csv::Error> {
    match extent {
        Extent::Results => writer.serialize(row),
        Extent::WithCounters => writer.serialize((row, row.counters)),
    }
}

fn cells(v: DVec3) -> [Option<f64>; 3] {
    v.to_array().map(Some)
}
