//! Answers queries by schedules that search a whole problem at once, and counts the work.

use super::meter::Meter;
use super::scratch::Scratch;
use super::subproblems::{OutcomeWithTolerance, Subproblems};
use crate::answer::{Answer, Outcome, Stats};
use crate::distance::oracle::DistanceOracle;
use crate::problem::Problem;
use std::borrow::Cow;
use std::ops::ControlFlow;

/// Answers a query by a search that examines pairs in order of time.
///
/// A search adds its work to the meter, which lends it the memory.
pub(crate) fn answer<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    scratch: &mut Scratch,
    search: impl FnMut(&Problem<'_>, &mut O, &mut Meter) -> Outcome,
) -> Answer {
    run_metered(problem, oracle, scratch, |oracle, meter| {
        let subproblems = Subproblems::new(Cow::Borrowed(problem));
        search_subproblems(subproblems, oracle, meter, search)
    })
    .answer()
}

/// Like [`answer`], for a search that need not examine pairs in order of time.
pub(crate) fn answer_by_unordered_search<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    scratch: &mut Scratch,
    search: impl FnMut(&Problem<'_>, &mut O, &mut Meter) -> Outcome,
) -> Answer {
    run_metered(problem, oracle, scratch, |oracle, meter| {
        let mut subproblems = Subproblems::new(Cow::Borrowed(problem));
        match subproblems.examine_start(oracle, meter) {
            ControlFlow::Continue(()) => search_subproblems(subproblems, oracle, meter, search),
            ControlFlow::Break(found) => found,
        }
    })
    .answer()
}

fn search_subproblems<O: DistanceOracle>(
    mut subproblems: Subproblems<'_, '_>,
    oracle: &mut O,
    meter: &mut Meter,
    mut search: impl FnMut(&Problem<'_>, &mut O, &mut Meter) -> Outcome,
) -> OutcomeWithTolerance {
    loop {
        let outcome = search(&subproblems.current(), oracle, meter);
        if let ControlFlow::Break(found) =
            subproblems.next_problem_or_outcome(outcome, oracle, meter)
        {
            return found;
        }
    }
}

/// The result of a search, with the achieved tolerance and the counted work.
pub(crate) struct SearchResult<T> {
    pub(crate) result: T,
    pub(crate) tolerance: f64,
    pub(crate) stats: Stats,
}

impl SearchResult<Outcome> {
    pub(crate) fn answer(self) -> Answer {
        Answer {
            outcome: self.result,
            tolerance: self.tolerance,
            stats: self.stats,
        }
    }
}

/// Runs a search and counts its work. The search returns its result and the tolerance.
pub(crate) fn run_metered<O: DistanceOracle, T>(
    problem: &Problem<'_>,
    oracle: &mut O,
    scratch: &mut Scratch,
    solve: impl FnOnce(&mut O, &mut Meter) -> (T, f64),
) -> SearchResult<T> {
    let before = oracle.effort();
    let mut meter = Meter::new(problem);
    meter.scratch = scratch.take();
    let (found, tolerance) = solve(oracle, &mut meter);
    *scratch = meter.scratch.take();
    SearchResult {
        result: found,
        tolerance,
        stats: Stats {
            oracle_effort: oracle.effort() - before,
            ..meter.stats
        },
    }
}

/// A schedule that answers queries in normalised units.
pub(crate) trait EngineSchedule<O: DistanceOracle> {
    /// Returns whether the schedule handles accelerations of the bodies' centers. Otherwise they count as deviations
    /// from a straight path.
    fn handles_accelerations(&self) -> bool;

    /// Answers a query about the first contact of moving bodies.
    fn answer_first_contact(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer;

    /// Returns the scratch memory that is kept between queries.
    fn scratch(&mut self) -> &mut Scratch;
}
