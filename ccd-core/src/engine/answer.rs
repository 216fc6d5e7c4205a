//! Runs a search, and treats contacts at the start as the query's policy says.

use super::meter::Meter;
use super::scratch::Scratch;
use super::start::search_contact_at_start;
use crate::answer::{Answer, Outcome, Stats};
use crate::distance::oracle::DistanceOracle;
use crate::engine::given_bodies::{convert_contact_to_given_bodies, outcome_on_original_bodies};
use crate::engine::rounds::PeriodicSearch;
use crate::math::order::greater;
use crate::problem::Problem;
use crate::settings::StartPolicy;
use crate::touching_plane::TouchingPlane;

/// Runs a search that examines pairs in order of time, under the query's policy for contacts at the start.
///
/// Bodies that begin in contact, under the policy `StartPolicy::Leave`, are searched again at half the gap that they
/// began with. Pairs that part or slide keep more than that gap; pairs that approach do not. If there is no useful
/// gap, each pair of pieces that rest on each other is let go by itself.
///
/// A search adds its work to the meter, which lends it the memory.
pub(crate) fn answer<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    scratch: &mut Scratch,
    search: impl FnMut(&Problem<'_>, &mut O, &mut Meter) -> Outcome,
) -> Answer {
    let as_found = |_: &Problem<'_>, _: &mut O, _: &mut Meter| None;
    answer_under_start_policy(problem, oracle, scratch, as_found, search)
}

/// Like [`answer`], for a search that need not examine pairs in order of time. Such a search may pass over a contact at
/// the start. If contacts at the start are to be ignored, the start is therefore examined first.
pub(crate) fn answer_by_unordered_search<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    scratch: &mut Scratch,
    search: impl FnMut(&Problem<'_>, &mut O, &mut Meter) -> Outcome,
) -> Answer {
    let at_start = |problem: &Problem<'_>, oracle: &mut O, meter: &mut Meter| {
        let beyond = problem.contact_distance().next_up();
        search_contact_at_start(problem, beyond, oracle, meter)
    };
    answer_under_start_policy(problem, oracle, scratch, at_start, search)
}

/// Runs a search under the query's policy for contacts at the start; `look` examines the start before the search. It is
/// called only if contacts at the start are to be ignored, and may return the outcome.
fn answer_under_start_policy<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    scratch: &mut Scratch,
    look: impl FnOnce(&Problem<'_>, &mut O, &mut Meter) -> Option<Outcome>,
    mut search: impl FnMut(&Problem<'_>, &mut O, &mut Meter) -> Outcome,
) -> Answer {
    run_metered(problem, oracle, scratch, |oracle, meter| {
        let outcome = match problem.start_policy {
            StartPolicy::Report => search(problem, oracle, meter),
            StartPolicy::Leave => {
                let problem = problem.reporting_start_contact();
                let seen = look(&problem, oracle, meter);
                seen.unwrap_or_else(|| search(&problem, oracle, meter))
            }
        };
        let parting =
            problem_ignoring_start_contact(problem, problem.start_policy, &outcome, oracle, meter);
        let (outcome, tolerance) = match parting {
            Some(problem) => {
                let outcome = search(&problem, oracle, meter);
                (outcome, achieved_tolerance(&problem, &outcome))
            }
            None => (outcome, problem.tolerance),
        };
        let within = problem.margin + tolerance;
        (
            outcome_on_original_bodies(problem, oracle, meter, outcome, |_| within),
            tolerance,
        )
    })
    .answer()
}

/// Runs a search in [`PeriodicSearch`] if the relative motion is periodic, and once over the whole time otherwise.
#[inline]
pub(crate) fn search_by_period(
    problem: &Problem<'_>,
    meter: &mut Meter,
    mut search: impl FnMut(&Problem<'_>, &mut Meter) -> Outcome,
) -> Outcome {
    match PeriodicSearch::for_problem(problem) {
        Some(rounds) => rounds.run(meter, search),
        None => search(problem, meter),
    }
}

/// Returns the problem in which the contact at the start is ignored, if the policy asks for that and the bodies touch;
/// `None` otherwise.
pub(crate) fn problem_ignoring_start_contact<'a, O: DistanceOracle>(
    problem: &Problem<'a>,
    start: StartPolicy,
    outcome: &Outcome,
    oracle: &mut O,
    meter: &mut Meter,
) -> Option<Problem<'a>> {
    match (start, outcome) {
        (StartPolicy::Leave, Outcome::Touching { contact }) => {
            let (within, at_start) = (problem.contact_distance(), problem.time_of_clock(0.0));
            // The normal is needed here. That of two pieces alone may be arbitrary.
            let contact =
                convert_contact_to_given_bodies(problem, oracle, meter, *contact, within, at_start);
            let gap = contact.separation.lower - problem.margin;
            let plane = TouchingPlane::from_contact(problem, &contact, oracle, meter);
            Some(problem.ignoring_start_contact(gap, plane))
        }
        _ => None,
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

/// Returns the tolerance that an outcome under `StartPolicy::Leave` achieves. Pieces that rest on each other count as
/// in contact again once they cannot be proven apart. Their distance may then be known less exactly than the least
/// tolerance.
pub(crate) fn achieved_tolerance(problem: &Problem<'_>, outcome: &Outcome) -> f64 {
    match outcome {
        Outcome::Contact { contact, .. } => {
            let shown = (contact.separation.upper - problem.margin).next_up();
            greater(problem.tolerance, shown)
        }
        _ => problem.tolerance,
    }
}

/// A schedule that answers queries in normalised units.
pub(crate) trait EngineSchedule<O: DistanceOracle> {
    /// Returns whether the schedule handles accelerations of the bodies' centres. Otherwise they count as deviations
    /// from a straight path.
    fn handles_accelerations(&self) -> bool;

    /// Answers a query about the first contact of moving bodies.
    fn answer_first_contact(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer;

    /// Returns the scratch memory that is kept between queries.
    fn scratch(&mut self) -> &mut Scratch;
}
