//! What many answers come to.

#[cfg(test)]
mod tests;

use crate::query::{Timed, median};
use crate::results::Status;
use ccd_core::order::greater;
use ccd_core::{Limit, Outcome};
use std::fmt;

/// What ends a query early, and what to do about it.
const LIMITS: [(Limit, &str); 5] = [
    (Limit::Budget, "the budget was spent; --budget raises it"),
    (
        Limit::Deadline,
        "the deadline was passed; --deadline gives more time",
    ),
    (
        Limit::Stalled,
        "no step forward could be certified; a larger --tolerance may help",
    ),
    (
        Limit::OracleGaveUp,
        "the oracle gave up; another --oracle may not",
    ),
    (
        Limit::Undecided,
        "at the start it cannot be told whether the bodies overlap; move one of them a little",
    ),
];

/// Counts and times of many answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// How many of each status, in the order of [`Status::ALL`].
    counts: [usize; Status::ALL.len()],
    /// Median time of a query, in microseconds; NaN of none, as the two below.
    pub median_micros: f64,
    /// Mean time of a query, in microseconds.
    pub mean_micros: f64,
    /// The time that 95 of 100 queries stay within, in microseconds.
    pub p95_micros: f64,
    /// Pairs of nodes visited, all queries together.
    pub node_visits: u64,
    /// How often the oracle was asked, all queries together.
    pub oracle_calls: u64,
    /// How often all pairs were advanced together, all queries together.
    pub advancements: u64,
    /// Steps of the oracle's search, all queries together.
    pub oracle_steps: u64,
    /// The tolerance asked for.
    asked: f64,
    /// How many answers were ended by each limit, in the order of [`LIMITS`].
    limits: [usize; LIMITS.len()],
    /// How many answers had to keep a larger tolerance.
    pub raised: usize,
    /// The largest tolerance kept.
    pub largest_tolerance: f64,
}

impl Summary {
    /// Sums up answers to queries with that tolerance.
    pub fn new<'t>(answers: impl IntoIterator<Item = &'t Timed>, tolerance: f64) -> Self {
        let mut summary = Summary {
            counts: [0; Status::ALL.len()],
            median_micros: f64::NAN,
            mean_micros: f64::NAN,
            p95_micros: f64::NAN,
            node_visits: 0,
            oracle_calls: 0,
            advancements: 0,
            oracle_steps: 0,
            asked: tolerance,
            limits: [0; LIMITS.len()],
            raised: 0,
            largest_tolerance: tolerance,
        };
        let mut micros = Vec::new();
        for timed in answers {
            let answer = &timed.answer;
            summary.counts[Status::from(&answer.outcome) as usize] += 1;
            if let Outcome::Unresolved { reason, .. } = answer.outcome {
                let limit = LIMITS.iter().position(|&(limit, _)| limit == reason);
                limit.into_iter().for_each(|k| summary.limits[k] += 1);
            }
            summary.node_visits += answer.stats.node_visits;
            summary.oracle_calls += answer.stats.oracle_calls;
            summary.advancements += answer.stats.advancements;
            summary.oracle_steps += answer.stats.effort.steps;
            summary.raised += usize::from(answer.tolerance > tolerance);
            summary.largest_tolerance = greater(summary.largest_tolerance, answer.tolerance);
            micros.push(timed.micros);
        }
        summary.median_micros = median(&mut micros);
        summary.mean_micros = micros.iter().sum::<f64>() / micros.len() as f64;
        summary.p95_micros = percentile(&micros, 0.95);
        summary
    }

    /// How many there are of a status.
    pub fn count(&self, status: Status) -> usize {
        self.counts[status as usize]
    }

    /// The means of what is counted, as one line; none of no rows.
    pub fn means(&self) -> Option<String> {
        let mean = |total: u64| total as f64 / self.rows() as f64;
        (self.rows() > 0).then(|| {
            format!(
                "means: {:.1} advancements, {:.1} oracle calls, {:.1} oracle steps",
                mean(self.advancements),
                mean(self.oracle_calls),
                mean(self.oracle_steps)
            )
        })
    }

    /// How many there are.
    pub fn rows(&self) -> usize {
        self.counts.iter().sum()
    }
}

/// What such a share of values stays within, of values sorted from the least; NaN of none.
pub fn percentile(sorted: &[f64], share: f64) -> f64 {
    let within = (share * sorted.len() as f64).ceil() as usize;
    within.checked_sub(1).map_or(f64::NAN, |k| sorted[k])
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let seen = Status::ALL.into_iter().filter(|&s| self.count(s) > 0);
        let counts: Vec<String> = seen
            .map(|s| format!("{} {}", self.count(s), s.name()))
            .collect();
        let plural = if self.rows() == 1 { "" } else { "s" };
        write!(f, "{} row{plural}", self.rows())?;
        if counts.is_empty() {
            return Ok(());
        }
        write!(
            f,
            ": {}; median {:.1} µs, mean {:.1} µs; {} node visits, {} oracle calls",
            counts.join(", "),
            self.median_micros,
            self.mean_micros,
            self.node_visits,
            self.oracle_calls
        )?;
        for (count, (_, advice)) in self.limits.iter().zip(LIMITS) {
            if *count > 0 {
                write!(f, "\n{count} unresolved: {advice}")?;
            }
        }
        if self.raised > 0 {
            write!(
                f,
                "\ntolerance {:e} cannot be certified at these coordinates: raised in {} rows, to \
                 at most {:.2e}",
                self.asked, self.raised, self.largest_tolerance
            )?;
        }
        Ok(())
    }
}
