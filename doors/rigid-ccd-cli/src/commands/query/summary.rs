//! The summary that a run prints after its last row.

#[cfg(test)]
mod tests;

use crate::rows::counts::StatusCounts;
use crate::rows::raised_tolerances::RaisedTolerances;
use crate::rows::time_histogram::TimeHistogram;
use ccd_core::Limit;
use ccd_tables::batch::TimedAnswer;
use ccd_tables::results::Status;
use std::fmt;

/// The counts of rows, the times and the counters of work that a run's summary prints. Its size does not depend on the
/// number of answers.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Summary {
    /// The number of rows of each status, including those of an earlier run.
    pub(super) counts: StatusCounts,
    /// The number of rows that an earlier run answered; only their status is known.
    earlier_row_count: usize,
    /// The times of the queries of this run, in microseconds.
    time_histogram: TimeHistogram,
    /// The number of pairs of nodes visited in all queries.
    pub(super) visited_node_pairs: u64,
    /// The number of calls of the distance backend in all queries.
    pub(super) oracle_calls: u64,
    /// The number of steps that advanced all pairs together, in all queries.
    pub(super) advancements: u64,
    /// The number of steps in the distance backend's searches, in all queries.
    pub(super) oracle_steps: u64,
    /// For each of the [`LIMITS`], the number of queries that the limit ended.
    limit_counts: [usize; LIMITS.len()],
    pub(super) raised_tolerances: RaisedTolerances,
}

/// The limits that may end a query, in the order in which the summary lists them.
const LIMITS: [Limit; 5] = [
    Limit::Budget,
    Limit::Deadline,
    Limit::Stalled,
    Limit::OracleGaveUp,
    Limit::OverlapUndecided,
];

impl Summary {
    /// Creates an empty summary of queries with the given tolerance.
    pub(super) fn new(tolerance: f64) -> Self {
        Summary {
            raised_tolerances: RaisedTolerances::new(tolerance),
            ..Summary::default()
        }
    }

    /// Returns the summary with the counts of an earlier run's rows.
    pub(super) fn with_earlier_counts(self, counts: StatusCounts) -> Self {
        Summary {
            counts,
            earlier_row_count: counts.row_count(),
            ..self
        }
    }

    /// Adds the time and the counters of an answer, and counts its status.
    pub(super) fn add(&mut self, status: Status, timed: &TimedAnswer) {
        let answer = &timed.answer;
        self.counts.add(status);
        for (count, limit) in self.limit_counts.iter_mut().zip(LIMITS) {
            *count += usize::from(answer.outcome.limit() == Some(limit));
        }
        self.visited_node_pairs += answer.stats.iterations;
        self.oracle_calls += answer.stats.oracle_calls;
        self.advancements += answer.stats.advancements;
        self.oracle_steps += answer.stats.oracle_effort.steps;
        self.raised_tolerances.add(answer.tolerance);
        self.time_histogram.add(timed.micros);
    }

    /// Returns the means of the counters as one line; `None` without answers.
    pub(super) fn describe_means(&self) -> Option<String> {
        let count = self.time_histogram.count();
        let mean = |total: u64| total as f64 / count as f64;
        (count > 0).then(|| {
            format!(
                "means: {:.1} advancements, {:.1} oracle calls, {:.1} oracle steps",
                mean(self.advancements),
                mean(self.oracle_calls),
                mean(self.oracle_steps)
            )
        })
    }
}

/// Returns the advice about a limit, with the names of options in place of settings.
fn advice_with_options(limit: Limit) -> String {
    let names = [
        ("larger tolerance", "larger --tolerance"),
        (
            "is_free with a margin",
            "--question is-free with a --margin",
        ),
        ("larger budget", "larger --budget"),
        ("later deadline", "later --deadline"),
        ("another one", "another --oracle"),
    ];
    let advice = limit.advice().to_owned();
    (names.iter()).fold(advice, |advice, (setting, option)| {
        advice.replace(setting, option)
    })
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rows = self.counts.row_count();
        write!(f, "{}", self.counts)?;
        if rows == 0 {
            return Ok(());
        }
        match rows - self.earlier_row_count {
            _ if self.earlier_row_count == 0 => {}
            0 => write!(f, "; 0 in this run")?,
            here => write!(f, "; {here} in this run")?,
        }
        if self.time_histogram.count() == 0 {
            return Ok(());
        }
        write!(
            f,
            "; median {:.1} µs, mean {:.1} µs; {} iterations, {} oracle calls",
            self.time_histogram.median(),
            self.time_histogram.mean(),
            self.visited_node_pairs,
            self.oracle_calls
        )?;
        for (count, limit) in self.limit_counts.iter().zip(LIMITS) {
            if *count > 0 {
                let advice = advice_with_options(limit);
                write!(f, "\n{count} unresolved: {advice}")?;
            }
        }
        self.raised_tolerances.fmt(f)
    }
}
