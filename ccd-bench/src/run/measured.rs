//! Defines the rows of both tables of measurements: cells, which the charts show, and trials, which the cells
//! summarise.

use crate::method::guarded::QueryOutcome;
use crate::run::verdict::Judgement;
use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};
use std::io::Write;
use std::path::Path;
use std::time::Duration;

/// The measurements of one method on one scene at one tolerance: a row of `chart.csv`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasurementCell {
    /// The name of the scene.
    pub scene: String,
    /// The name of the method.
    pub method: String,
    /// The tolerance of the queries, in the scene's unit of length.
    pub tolerance: f64,
    /// The number of queries that the method was asked.
    pub rows: usize,
    /// The median time of a query, in microseconds.
    pub median_us: f64,
    /// The mean time of a query, in microseconds.
    pub mean_us: f64,
    /// The 95th percentile of the queries' times, in microseconds.
    pub p95_us: f64,
    /// The number of contacts reported after the exact first one.
    pub late: usize,
    /// The number of contacts that the method missed, because it reported that there is none.
    pub missed: usize,
    /// The number of contacts reported although the bodies never come within the tolerance.
    #[serde(rename = "false")]
    pub false_contacts: usize,
    /// The number of queries without a complete answer, including those cut off.
    pub unresolved: usize,
    /// The mean error of the times of contact, as a fraction of the duration; `None` without a contact to compare.
    pub mean_error: Option<f64>,
    /// The largest error of a time of contact, as a fraction of the duration; `None` without a contact to compare.
    pub max_error: Option<f64>,
    /// The number of contacts reported while the bodies are farther apart than the tolerance.
    pub early: usize,
    /// The number of queries that exceeded the time limit and were stopped, or at which the peer died.
    pub cut_off: usize,
    /// The number of queries whose exact answer is not known well enough to judge the method's answer.
    pub undecided: usize,
    /// The mean number of steps in time of a query, as the method counts them.
    pub mean_steps: f64,
}

/// The measurement of one query: a row of `trials.csv`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// The name of the scene.
    pub scene: String,
    /// The name of the method.
    pub method: String,
    /// The tolerance of the query, in the scene's unit of length.
    pub tolerance: f64,
    /// The index of the query in its scene, from 0.
    pub row: usize,
    /// The name of the query in the table of motions.
    pub id: String,
    /// The time that the method took for this query, in microseconds: the time limit if the query was stopped, NaN if
    /// the process ended.
    pub micros: f64,
    /// The number of steps in time that the method took; 0 without an answer.
    pub steps: u64,
    /// The verdict on the method's claim.
    pub verdict: String,
    /// The error of the time of contact, as a fraction of the duration; `None` without a time.
    pub error: Option<f64>,
    /// The time of the claimed contact, or the time until which there is none.
    pub time: Option<f64>,
    /// The method's remark about its answer: a raised tolerance, or the reason for an incomplete answer.
    #[serde(default)]
    pub note: String,
}

impl Trial {
    /// Creates the trial of a query from the outcome, its judgement, and a remark.
    pub fn new(
        (scene, method, tolerance): (&str, &str, f64),
        (row, id): (usize, &str),
        (outcome, patience): (&QueryOutcome, Duration),
        (judged, note): (Judgement, String),
    ) -> Self {
        let reply = outcome.reply();
        Trial {
            scene: scene.to_owned(),
            method: method.to_owned(),
            tolerance,
            row,
            id: id.to_owned(),
            micros: match outcome {
                QueryOutcome::Answered(timed) => timed.micros,
                QueryOutcome::CutOff => patience.as_secs_f64() * 1e6,
                QueryOutcome::Crashed => f64::NAN,
            },
            steps: reply.map_or(0, |reply| reply.steps),
            verdict: judged.verdict.to_string(),
            error: judged.time_error,
            time: reply
                .and_then(|reply| reply.claim.contact_or_safe_time())
                .filter(|time| !time.is_nan()),
            note,
        }
    }
}

impl MeasurementCell {
    /// Returns true if some contact was reported too late, or not at all.
    pub fn has_unsafe_answers(&self) -> bool {
        self.late + self.missed > 0
    }
}

/// Writes rows as a CSV table with a header.
///
/// # Errors
/// If the file cannot be written.
pub fn write<T: Serialize>(path: &Path, rows: &[T]) -> Result<()> {
    let write = |out: &mut dyn Write| {
        let mut writer = csv::Writer::from_writer(out);
        for row in rows {
            writer.serialize(row)?;
        }
        writer.flush()
    };
    ccd_file::write(path, write).with_context(|| path.display().to_string())
}
