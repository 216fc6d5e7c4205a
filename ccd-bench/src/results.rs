//! The table of results: answers in, CSV out.

#[cfg(test)]
mod tests;

use ccd_core::glam::DVec3;
use ccd_core::{Answer, Contact, Outcome, Overlap, Stats};
use serde::Serialize;
use std::io;

/// The columns, in order.
pub const COLUMNS: [&str; 19] = [
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
];

/// The columns that follow where counters are asked for, in order.
pub const COUNTER_COLUMNS: [&str; 5] = [
    "advancements",
    "oracle_steps",
    "cycles",
    "fallbacks",
    "front",
];

/// Which columns a table has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Extent {
    /// [`COLUMNS`].
    #[default]
    Results,
    /// These, and [`COUNTER_COLUMNS`].
    WithCounters,
}

/// One answer as the table holds it, in the order of [`COLUMNS`]; what does not apply is an empty
/// cell.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ResultRow {
    /// As in the table of motions.
    pub id: String,
    /// What happens.
    pub status: Status,
    /// When: certified that nothing touches before, unless by a bound that is not. The duration when free.
    pub time: f64,
    /// A lower bound of the distance at `time`; when free, at all times.
    pub distance_lower: Option<f64>,
    /// An upper bound of the distance at `time`.
    pub distance_upper: Option<f64>,
    /// From A to B, in the world's frame.
    pub normal: [Option<f64>; 3],
    /// The nearest point of A, in the world's frame at `time`.
    pub witness_a: [Option<f64>; 3],
    /// The nearest point of B, in the world's frame at `time`.
    pub witness_b: [Option<f64>; 3],
    /// The feature of A's mesh that touches.
    pub feature_a: Option<String>,
    /// The feature of B's mesh that touches.
    pub feature_b: Option<String>,
    /// Pairs of nodes visited.
    pub iterations: u64,
    /// How often the oracle was asked.
    pub oracle_calls: u64,
    /// How long that query alone took, in microseconds.
    pub micros: f64,
    /// What else was counted.
    #[serde(skip)]
    pub counters: Counters,
}

/// What is counted beside the visits and the calls, in the order of [`COUNTER_COLUMNS`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counters {
    /// How often all pairs were advanced together.
    pub advancements: u64,
    /// Steps of the oracle's search; 0 of oracles that do not count them.
    pub oracle_steps: u64,
    /// How often the search came back to where it had been.
    pub cycles: u64,
    /// How often an oracle gave up and another one was asked.
    pub fallbacks: u64,
    /// The most pairs that waited at one time.
    pub front: u64,
}

impl From<&Stats> for Counters {
    fn from(stats: &Stats) -> Self {
        Counters {
            advancements: stats.advancements,
            oracle_steps: stats.effort.steps,
            cycles: stats.effort.cycles,
            fallbacks: stats.effort.fallbacks,
            front: stats.peak_front,
        }
    }
}

/// An [`Outcome`], without what goes with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// They touch.
    Contact,
    /// They never do.
    Free,
    /// They touch at the start.
    Touching,
    /// They overlap at the start.
    Overlapping,
    /// A limit came first.
    Unresolved,
}

impl Status {
    /// All of them, in the order in which they are reported.
    pub const ALL: [Status; 5] = [
        Status::Contact,
        Status::Free,
        Status::Touching,
        Status::Overlapping,
        Status::Unresolved,
    ];

    /// As the table spells it.
    pub fn name(self) -> &'static str {
        match self {
            Status::Contact => "contact",
            Status::Free => "free",
            Status::Touching => "touching",
            Status::Overlapping => "overlapping",
            Status::Unresolved => "unresolved",
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

/// Until when an outcome says that nothing touches.
pub fn safe_time(outcome: &Outcome, duration: f64) -> f64 {
    match *outcome {
        Outcome::Contact { time, .. } => time,
        Outcome::Free { .. } => duration,
        Outcome::Touching { .. } | Outcome::Overlapping { .. } => 0.0,
        Outcome::Unresolved { safe_until, .. } => safe_until,
    }
}

impl ResultRow {
    /// What the table says of an answer.
    pub fn new(id: &str, duration: f64, answer: &Answer, micros: f64) -> Self {
        let row = ResultRow {
            id: id.to_owned(),
            status: Status::from(&answer.outcome),
            time: safe_time(&answer.outcome, duration),
            distance_lower: None,
            distance_upper: None,
            normal: [None; 3],
            witness_a: [None; 3],
            witness_b: [None; 3],
            feature_a: None,
            feature_b: None,
            iterations: answer.stats.node_visits,
            oracle_calls: answer.stats.oracle_calls,
            micros,
            counters: Counters::from(&answer.stats),
        };
        match answer.outcome {
            Outcome::Contact { contact, .. }
            | Outcome::Touching { contact }
            | Outcome::Overlapping {
                overlap: Overlap::Pieces(contact),
            } => row.with_contact(&contact),
            // The one point belongs to both solids.
            Outcome::Overlapping {
                overlap: Overlap::AInsideB(point) | Overlap::BInsideA(point),
            } => ResultRow {
                witness_a: cells(point),
                witness_b: cells(point),
                ..row
            },
            Outcome::Free { clearance } => ResultRow {
                distance_lower: Some(clearance),
                ..row
            },
            Outcome::Unresolved { .. } => row,
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

/// Writes a table; numbers read back to the same bits.
///
/// # Errors
/// When `output` cannot be written to.
pub fn write<'r>(
    output: impl io::Write,
    extent: Extent,
    rows: impl IntoIterator<Item = &'r ResultRow>,
) -> Result<(), csv::Error> {
    let mut writer = csv::WriterBuilder::new()
        .has_headers(false)
        .from_writer(output);
    match extent {
        Extent::Results => writer.write_record(COLUMNS)?,
        Extent::WithCounters => writer.write_record(COLUMNS.iter().chain(&COUNTER_COLUMNS))?,
    }
    for row in rows {
        match extent {
            Extent::Results => writer.serialize(row)?,
            Extent::WithCounters => writer.serialize((row, row.counters))?,
        }
    }
    writer.flush()?;
    Ok(())
}

fn cells(v: DVec3) -> [Option<f64>; 3] {
    v.to_array().map(Some)
}
