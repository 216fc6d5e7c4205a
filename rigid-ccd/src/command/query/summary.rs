//! What many answers come to.

#[cfg(test)]
mod tests;

use super::limits::Reached;
use crate::batch::Timed;
use crate::table::results::Status;
use ccd_core::Outcome;
use ccd_core::order::greater;
use std::collections::BTreeMap;
use std::fmt;

/// Counts and times of many answers, of which none is kept.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Summary {
    /// How many of each status, in the order of [`Status::ALL`].
    counts: [usize; Status::ALL.len()],
    /// How many of them an earlier run answered: nothing else is known of these.
    earlier: usize,
    times: Times,
    /// Pairs of nodes visited, all queries together.
    pub(super) iterations: u64,
    /// How often the oracle was asked, all queries together.
    pub(super) oracle_calls: u64,
    /// How often all pairs were advanced together, all queries together.
    pub(super) advancements: u64,
    /// Steps of the oracle's search, all queries together.
    pub(super) oracle_steps: u64,
    /// The tolerance asked for.
    asked: f64,
    limits: Reached,
    /// How many answers had to keep a larger tolerance.
    pub(super) raised: usize,
    /// The largest tolerance kept.
    pub(super) largest_tolerance: f64,
}

impl Summary {
    /// Of no answers yet, to queries with that tolerance.
    pub(super) fn new(tolerance: f64) -> Self {
        Summary {
            counts: [0; Status::ALL.len()],
            earlier: 0,
            times: Times::default(),
            iterations: 0,
            oracle_calls: 0,
            advancements: 0,
            oracle_steps: 0,
            asked: tolerance,
            limits: Reached::default(),
            raised: 0,
            largest_tolerance: tolerance,
        }
    }

    /// With the rows of an earlier run, so many of each status in the order of [`Status::ALL`].
    pub(super) fn going_on(mut self, counts: [usize; Status::ALL.len()]) -> Self {
        for (count, more) in self.counts.iter_mut().zip(counts) {
            *count += more;
        }
        self.earlier += counts.iter().sum::<usize>();
        self
    }

    /// One more answer.
    pub(super) fn add(&mut self, timed: &Timed) {
        let answer = &timed.answer;
        self.counts[Status::from(&answer.outcome) as usize] += 1;
        if let Outcome::Unresolved { reason, .. } = answer.outcome {
            self.limits.add(reason);
        }
        self.iterations += answer.stats.iterations;
        self.oracle_calls += answer.stats.oracle_calls;
        self.advancements += answer.stats.advancements;
        self.oracle_steps += answer.stats.effort.steps;
        self.raised += usize::from(answer.tolerance > self.asked);
        self.largest_tolerance = greater(self.largest_tolerance, answer.tolerance);
        self.times.add(timed.micros);
    }

    /// One more row that could not be asked.
    pub(super) fn add_error(&mut self) {
        self.counts[Status::Error as usize] += 1;
    }

    /// How many were answered here.
    fn answered(&self) -> u64 {
        self.times.count
    }

    /// How many there are of each status, in the order of [`Status::ALL`].
    pub(super) fn counts(&self) -> [usize; Status::ALL.len()] {
        self.counts
    }

    /// Median time of a query, in microseconds, to a thousandth; NaN of none, as the mean.
    pub(super) fn median_micros(&self) -> f64 {
        self.times.median()
    }

    /// Mean time of a query, in microseconds.
    pub(super) fn mean_micros(&self) -> f64 {
        self.times.total / self.times.count as f64
    }

    /// How many there are of a status.
    pub(super) fn count(&self, status: Status) -> usize {
        self.counts[status as usize]
    }

    /// The means of what is counted, as one line; none of no rows.
    pub(super) fn means(&self) -> Option<String> {
        let mean = |total: u64| total as f64 / self.answered() as f64;
        (self.answered() > 0).then(|| {
            format!(
                "means: {:.1} advancements, {:.1} oracle calls, {:.1} oracle steps",
                mean(self.advancements),
                mean(self.oracle_calls),
                mean(self.oracle_steps)
            )
        })
    }

    /// How many there are.
    pub(super) fn rows(&self) -> usize {
        self.counts.iter().sum()
    }
}

/// How many times there are of each size, to a thousandth: as small for many as for few.
#[derive(Clone, Debug, Default, PartialEq)]
struct Times {
    /// By the leading bits of the time, which are in the order of the times.
    counts: BTreeMap<u64, u64>,
    count: u64,
    total: f64,
}

/// The bits of a time that are not kept: all but 10 of its fraction.
const DROPPED: u32 = f64::MANTISSA_DIGITS - 1 - 10;

impl Times {
    fn add(&mut self, micros: f64) {
        *self.counts.entry(micros.to_bits() >> DROPPED).or_default() += 1;
        self.count += 1;
        self.total += micros;
    }

    fn median(&self) -> f64 {
        0.5 * (self.nth(self.count.saturating_sub(1) / 2) + self.nth(self.count / 2))
    }

    /// The one that so many are not greater than, itself left out.
    fn nth(&self, before: u64) -> f64 {
        let mut passed = 0;
        for (&bits, &count) in &self.counts {
            passed += count;
            if passed > before {
                return f64::from_bits(bits << DROPPED);
            }
        }
        f64::NAN
    }
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
        write!(f, ": {}", counts.join(", "))?;
        match self.rows() - self.earlier {
            _ if self.earlier == 0 => {}
            0 => write!(f, "; none of them in this run")?,
            here => write!(f, "; {here} of them in this run")?,
        }
        if self.answered() == 0 {
            return Ok(());
        }
        write!(
            f,
            "; median {:.1} µs, mean {:.1} µs; {} node visits, {} oracle calls",
            self.median_micros(),
            self.mean_micros(),
            self.iterations,
            self.oracle_calls
        )?;
        for (count, advice) in self.limits.advice() {
            write!(f, "\n{count} unresolved: {advice}")?;
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
