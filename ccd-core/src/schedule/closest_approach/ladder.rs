//! Lower bounds proven on the way, for a search that may end before its own is.
//!
//! A search for the least distance proves it for each pair in turn: it knows nothing of the bodies until its end.
//! Half of the distance is proven much sooner. A search that takes long stops now and then to do so, and climbs.

use crate::math::order::greater;
use crate::problem::Problem;

/// Parts of the least distance seen, proven one by one.
#[derive(Debug)]
pub(in crate::schedule) struct Ladder {
    /// The work at which the next rung is due.
    next: u64,
    /// The work at which the last one is: the rest of the budget is for it.
    last: u64,
    /// The part that is tried next.
    part: f64,
    /// The best bound of the distance at all times.
    pub(in crate::schedule) lower: f64,
}

/// A question for any contact, which may prove a lower bound.
#[derive(Clone, Copy, Debug)]
pub(in crate::schedule) struct Rung {
    pub(in crate::schedule) margin: f64,
    pub(in crate::schedule) tolerance: f64,
    /// The most work on it.
    pub(in crate::schedule) budget: u64,
}

impl Rung {
    /// Returns the problem that asks it.
    pub(in crate::schedule) fn problem<'a>(&self, problem: &Problem<'a>) -> Problem<'a> {
        let mut asking = problem.keeping(self.margin, self.tolerance);
        asking.budget = self.budget;
        asking
    }
}

/// The work after which the first rung is tried: most searches have ended before.
const FIRST: u64 = 1 << 17;

/// The same for searches that time may end.
const FIRST_TIMED: u64 = 1 << 14;

/// The most rungs at the end of a search that did not get to its answer.
pub(in crate::schedule) const LAST_RUNGS: usize = 8;

impl Ladder {
    /// Begins with a bound that is known, for a search with this budget.
    pub(in crate::schedule) fn new(lower: f64, budget: u64) -> Self {
        let last = budget - budget / 4;
        Ladder {
            next: FIRST.min(last),
            last,
            part: 0.5,
            // Written so that NaN is no bound.
            lower: if lower > 0.0 { lower } else { 0.0 },
        }
    }

    /// Returns the ladder for a search that time may end, or another thread.
    pub(in crate::schedule) fn timed(self) -> Self {
        Ladder {
            next: self.next.min(FIRST_TIMED),
            ..self
        }
    }

    /// Returns the next rung if it is due: it may take half as much work as was done before.
    #[inline]
    pub(in crate::schedule) fn due(&mut self, work: u64, upper: f64) -> Option<Rung> {
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

    /// Returns the next rung below a distance; none if that is not known, or nothing can be gained.
    pub(in crate::schedule) fn rung(&self, upper: f64, budget: u64) -> Option<Rung> {
        let level = self.part * upper;
        // The tolerance is room for proofs.
        let (margin, tolerance) = (0.75 * level, 0.25 * level);
        (margin > self.lower && level < f64::INFINITY && budget > 0).then_some(Rung {
            margin,
            tolerance,
            budget,
        })
    }

    /// Takes what came of a rung: the bound that is proven, if it is.
    pub(in crate::schedule) fn climb(&mut self, proven: Option<f64>) {
        match proven {
            Some(proven) => {
                self.lower = greater(self.lower, proven);
                self.part = 0.5 + 0.5 * self.part;
            }
            None => self.part *= 0.25,
        }
    }
}
