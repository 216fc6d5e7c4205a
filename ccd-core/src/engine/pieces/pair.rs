//! Advances one pair of pieces: checks the oracle's claim, and computes a new clock.

use super::contact_rule::{ContactRule, ExaminedPair, PairStep};
use super::placed_pair::PlacedPair;
use crate::distance::oracle::DistanceOracle;
use crate::distance::separation::CheckedClaim;
use crate::engine::meter::Meter;
use crate::motion::free_time::FreeTime;
use crate::problem::Problem;
use std::ops::ControlFlow;

/// A pair of pieces with a clock of its own.
#[derive(Clone, Debug)]
pub(crate) struct Pair<C> {
    pub(crate) a: u32,
    pub(crate) b: u32,
    contact_rule: ContactRule,
    /// Whether the pair has been advanced before. The first time uses [`PlacedPair::first_visit_free_time`].
    was_advanced: bool,
    /// What the oracle remembers for its next call on this pair.
    cache: C,
}

impl<C: Default + Clone> Pair<C> {
    pub(crate) fn new(a: u32, b: u32) -> Self {
        Pair {
            a,
            b,
            contact_rule: ContactRule::ApartAtStart,
            was_advanced: false,
            cache: C::default(),
        }
    }

    /// Examines the pair at clock `s`, up to which it is certified apart, and certifies it further.
    pub(crate) fn advance<O: DistanceOracle<Cache = C>>(
        &mut self,
        problem: &Problem<'_>,
        oracle: &mut O,
        meter: &mut Meter,
        s: f64,
    ) -> PairStep {
        let placed = PlacedPair::new(problem, [self.a, self.b], s);
        let known = std::mem::replace(&mut self.was_advanced, true);
        self.advance_with_free_time(&placed, oracle, meter, |placed, checked, kept| {
            if known {
                placed.free_time(checked, kept)
            } else {
                placed.first_visit_free_time(checked, kept)
            }
        })
    }

    /// Like [`Pair::advance`], with the pieces placed and another function for the free time. Pairs in contact at the
    /// start use the usual free time.
    pub(crate) fn advance_with_free_time<O: DistanceOracle<Cache = C>>(
        &mut self,
        placed: &PlacedPair<'_>,
        oracle: &mut O,
        meter: &mut Meter,
        free_time: impl FnOnce(&PlacedPair<'_>, &CheckedClaim, f64) -> FreeTime,
    ) -> PairStep {
        let Some(checked) = placed.query_oracle(oracle, &mut self.cache, meter) else {
            return PairStep::GaveUp;
        };
        let examined = ExaminedPair {
            placed,
            ids: [self.a, self.b],
            checked: &checked,
        };
        if let ControlFlow::Break(found) = self.contact_rule.choose(examined, oracle, meter) {
            return found;
        }
        let step = self.contact_rule.step(examined, free_time);
        meter.stats.point_evaluations += placed.height_evaluation_count.get();
        step
    }
}

#[cfg(test)]
mod tests;
