//! Lower bounds of the distance, for a search that may reach a limit before it has its answer.
//!
//! A search for the least distance proves it pair by pair, and has no bound for the whole bodies until its end. Half
//! of the distance is proven much sooner. A long search therefore stops now and then, to prove such a part: a *rung*
//! of the ladder.

use crate::math::order::greater;
use crate::problem::Problem;

/// Parts of the least distance seen, proven one by one.
#[derive(Debug)]
pub(crate) struct Ladder {
    /// The work at which the next rung is due.
    next: u64,
    /// The work at which the last rung is due. The rest of the budget is reserved for it.
    last: u64,
    /// The part of the distance to prove next.
    part: f64,
    /// The best lower bound of the distance at all times.
    pub(crate) lower: f64,
}

/// A query for any contact. If there is none, a lower bound is proven.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rung {
    pub(crate) margin: f64,
    pub(crate) tolerance: f64,
    /// The most work on the rung.
    pub(crate) budget: u64,
}

impl Rung {
    /// Returns the problem of this rung.
    pub(crate) fn problem<'a>(&self, problem: &Problem<'a>) -> Problem<'a> {
        let mut asking = problem.keeping(self.margin, self.tolerance);
        asking.budget = self.budget;
        asking
    }
}

/// The work after which the first rung is tried. Most searches end sooner.
const FIRST: u64 = 1 << 17;

/// The work after which the first rung is tried in a search with a deadline or a stop flag.
const FIRST_TIMED: u64 = 1 << 14;

/// The most rungs at the end of a search that reached a limit.
pub(crate) const LAST_RUNGS: usize = 8;

impl Ladder {
    /// Creates the ladder with a known lower bound, for a search with this budget.
    pub(crate) fn new(lower: f64, budget: u64) -> Self {
        let last = budget - budget / 4;
        Ladder {
            next: FIRST.min(last),
            last,
            part: 0.5,
            // Written so that NaN is no bound.
            lower: if lower > 0.0 { lower } else { 0.0 },
        }
    }

    /// Returns the ladder for a search that a deadline or another thread may end.
    pub(crate) fn timed(self) -> Self {
        Ladder {
            next: self.next.min(FIRST_TIMED),
            ..self
        }
    }

    /// Returns the next rung if it is due. The rung may take half as much work as was done before.
    #[inline]
    pub(crate) fn due(&mut self, work: u64, upper: f64) -> Option<Rung> {
        if work < self.next {
            return None;
        }
        self.next = if work < self.last {
            work.saturating_mul(8).min(self.last)
        } else {
            u64::MAX
        };
        self.rung(upper, work / 2)
    }

    /// Returns the next rung below a distance; `None` if the distance is unknown, or nothing can be gained.
    pub(crate) fn rung(&self, upper: f64, budget: u64) -> Option<Rung> {
        let level = self.part * upper;
        // The tolerance leaves room for proofs.
        let (margin, tolerance) = (0.75 * level, 0.25 * level);
        (margin > self.lower && level < f64::INFINITY && budget > 0).then_some(Rung {
            margin,
            tolerance,
            budget,
        })
    }

    /// Records the result of a rung: the proven bound, or `None`.
    pub(crate) fn climb(&mut self, proven: Option<f64>) {
        match proven {
            Some(proven) => {
                self.lower = greater(self.lower, proven);
                self.part = 0.5 + 0.5 * self.part;
            }
            None => self.part *= 0.25,
        }
    }
}
