//! Computes bounds of the least distance of two bodies over the duration of a query, and the time at which it occurs.

mod follow;
pub(crate) mod guess;
pub(crate) mod ladder;
mod nearing;
pub(crate) mod required;

use crate::answer::{Answer, Contact, Limit, Outcome, Unresolved};
use crate::distance::oracle::DistanceOracle;
use crate::engine::answer::{SearchResult, run_metered};
use crate::engine::closer_look::BoundTightener;
use crate::engine::given_bodies::outcome_on_original_bodies;
use crate::engine::meter::Meter;
use crate::engine::nodes::common::NodeContext;
use crate::engine::proven::ProvenFacts;
use crate::engine::rounds::RepresentativePeriod;
use crate::engine::search::Search;
use crate::engine::shortcuts::bounding_volumes::least_distance;
use crate::engine::start::search_contact_at_start;
use crate::error::InputError;
use crate::math::order::greater;
use crate::problem::Problem;
use crate::query::Query;
use crate::questions::depth_first::DepthFirst;
use guess::estimate_nearest_pair;
use ladder::LowerBoundAttempts;
use nearing::LeastDistanceSearch;
use required::RequiredClearance;
use std::convert::Infallible;
use std::ops::ControlFlow;

impl<O: DistanceOracle> DepthFirst<O> {
    /// Computes bounds of the least distance of the bodies over the duration, which differ by at most the tolerance. If
    /// a [clearance](crate::Settings::clearance) is required of bodies that move, decides whether they keep it instead.
    ///
    /// The margin and the [policy](crate::StartPolicy) for the start play no role.
    ///
    /// # Guarantee
    /// The guarantee of [`Outcome`]; ends on every input; the same call gives the same bits, unless a
    /// [deadline](crate::Settings::deadline) or a [flag](crate::Settings::stop) stops it. Of bodies that overlap at the
    /// start, and come within the tolerance later too, either may then be the answer.
    ///
    /// # Errors
    /// An [`InputError`] if a trajectory has no motion at some time, or one out of range.
    pub fn closest_approach(
        &mut self,
        query: &Query<'_>,
        oracle: &mut O,
    ) -> Result<Answer, InputError> {
        match &query.constant_velocity_problem {
            Some(problem) => Ok(self.closest_approach_of(problem, oracle)),
            None => self.closest_approach_along(query, oracle),
        }
    }

    /// Computes bounds of the least distance of the two bodies of a problem, or decides whether they keep a required
    /// clearance.
    pub(crate) fn closest_approach_of(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer {
        let answer = match problem.clearance.filter(|_| moves(problem)) {
            Some(distance) => self.decide_clearance(problem, distance, oracle),
            None => self.search_least_distance_of_bodies(problem, oracle),
        };
        answer.widened_by_excess(problem.body_excess_sum())
    }

    /// Computes bounds of the least distance of the bodies, without a correction for their excess over the shapes.
    pub(crate) fn search_least_distance_of_bodies(
        &mut self,
        problem: &Problem<'_>,
        oracle: &mut O,
    ) -> Answer {
        let answer =
            self.search_least_distance_then(problem, f64::INFINITY, oracle, check_start_overlap);
        let found = answer.result;
        Answer {
            outcome: found.unwrap_or_else(|FartherThanCutoff { lower }| {
                unresolved_outcome(lower, Limit::OracleGaveUp)
            }),
            tolerance: answer.tolerance,
            stats: answer.stats,
        }
    }

    /// Decides whether the bodies stay at least `distance` apart, or their shapes come nearer than `distance`.
    fn decide_clearance(&mut self, problem: &Problem<'_>, distance: f64, oracle: &mut O) -> Answer {
        let required = RequiredClearance {
            distance,
            tolerance: problem.tolerance,
            budget: problem.budget,
            deadline: problem.deadline,
            body_excess: problem.body_excess_sum(),
        };
        let answer = required.decide(|margin_query, deadline| {
            let mut problem = margin_query.problem(&problem.for_distances());
            problem.deadline = deadline;
            Ok::<_, Infallible>(self.any_contact_of(&problem, oracle))
        });
        answer.unwrap_or_else(|never| match never {})
    }

    /// Computes bounds of the least distance of the bodies if it is below `beyond`, or returns that it is not. If the
    /// bodies meet, the answer does not say whether they overlap at the start.
    pub(crate) fn search_least_distance_below(
        &mut self,
        problem: &Problem<'_>,
        beyond: f64,
        oracle: &mut O,
    ) -> SearchResult<Result<Outcome, FartherThanCutoff>> {
        self.search_least_distance_then(problem, beyond, oracle, |_, _, _, found| found)
    }

    /// Searches for the least distance of the bodies if it is below `beyond`, and applies `last_look` to the outcome.
    fn search_least_distance_then(
        &mut self,
        problem: &Problem<'_>,
        beyond: f64,
        oracle: &mut O,
        last_look: impl FnOnce(&Problem<'_>, &mut O, &mut Meter, Outcome) -> Outcome,
    ) -> SearchResult<Result<Outcome, FartherThanCutoff>> {
        let mut scratch = self.scratch.take();
        let answer = run_metered(problem, oracle, &mut scratch, |oracle, meter| {
            let problem = problem.for_distances();
            let sample = RepresentativePeriod::for_problem(&problem);
            let searched = sample
                .as_ref()
                .map_or(&problem, |sample| &sample.period_subproblem);
            self.stack.clear();
            let found = self.search(searched, beyond, oracle, meter);
            let stats = &mut meter.stats;
            stats.peak_front = stats.peak_front.max(self.stack.peak_length());
            self.stack.clear();
            let found = match &sample {
                Some(sample) => outcome_for_all_periods(sample, found),
                None => found,
            };
            let told = found.map(|found| {
                let found = last_look(&problem, oracle, meter, found);
                outcome_on_original_bodies(&problem, oracle, meter, found, |contact| {
                    contact.separation.upper
                })
            });
            let width = told
                .as_ref()
                .map_or(0.0, Outcome::least_distance_bracket_width);
            // Distances may not be known to the requested tolerance.
            (told, greater(problem.tolerance, width))
        });
        self.scratch = scratch;
        answer
    }

    fn search(
        &mut self,
        problem: &Problem<'_>,
        beyond: f64,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> Result<Outcome, FartherThanCutoff> {
        if !moves(problem) {
            return measure_at_rest(problem, beyond, oracle, meter);
        }
        let best = match estimate_nearest_pair(problem, beyond, oracle, meter) {
            ControlFlow::Continue(best) => best,
            ControlFlow::Break(found) => return Ok(found),
        };
        let mut nearing = LeastDistanceSearch {
            nearest_pair: best,
            cutoff_distance: beyond,
            proven_facts: ProvenFacts::default(),
            first_failure: None,
            lower_bound_attempts: LowerBoundAttempts::new(least_distance(problem), problem.budget)
                .with_earlier_first_attempt_if_timed(
                    problem.deadline.is_some() || problem.stop_flag.is_some(),
                ),
        };
        let mut search = Search::new(&mut self.stack, oracle, meter);
        if search.push_roots(problem).is_err() {
            return Ok(nearing.unresolved_outcome(problem, Limit::Budget));
        }
        // Pairs that keep the least distance also keep any smaller one.
        loop {
            let upper = nearing.upper();
            let below = problem.for_distances_below(upper);
            // Written so that NaN is the end.
            if !(upper > problem.tolerance && upper > below.contact_distance()) {
                return nearing.least_distance_outcome(problem, 0.0);
            }
            let common = NodeContext::new(&below);
            let mut look = BoundTightener::new(&below);
            while nearing.upper() == upper {
                if let Some(attempt) = nearing
                    .lower_bound_attempts
                    .next_attempt_if_due(search.meter.stats.budgeted_work(), upper)
                {
                    if let ControlFlow::Break(found) =
                        nearing.try_lower_bound(problem, attempt, search.oracle, search.meter)
                    {
                        return Ok(found);
                    }
                    look = BoundTightener::new(&below);
                    continue;
                }
                if let ControlFlow::Break(found) =
                    search.visit_next_pair(&common, &mut look, &mut nearing)
                {
                    return nearing.final_outcome(problem, found, search.oracle, search.meter);
                }
            }
        }
    }
}

/// Converts the outcome for one period of repeating motions to an outcome for the whole duration.
fn outcome_for_all_periods(
    sample: &RepresentativePeriod<'_>,
    found: Result<Outcome, FartherThanCutoff>,
) -> Result<Outcome, FartherThanCutoff> {
    let found = found.map_err(|FartherThanCutoff { lower }| FartherThanCutoff {
        lower: sample.whole_duration_lower_bound(lower),
    })?;
    let mut outcome = found.map_contacts(|contact, _| sample.widen_distance_bounds(contact));
    match &mut outcome {
        Outcome::LeastDistance { lower, .. } => *lower = sample.whole_duration_lower_bound(*lower),
        Outcome::Unresolved(known) => {
            known.lower = greater(0.0, sample.whole_duration_lower_bound(known.lower));
        }
        _ => return Ok(found),
    }
    Ok(outcome)
}

/// Returns `found`, or the outcome that the bodies overlap if they overlap at the start.
fn check_start_overlap<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    meter: &mut Meter,
    found: Outcome,
) -> Outcome {
    if !is_contact_after_start(&found, problem.tolerance) {
        return found;
    }
    match search_contact_at_start(problem, f64::MIN_POSITIVE, oracle, meter) {
        Some(overlapping @ Outcome::Overlapping { .. }) => overlapping,
        _ => found,
    }
}

/// Measures the distance of two bodies that are both at rest.
fn measure_at_rest<O: DistanceOracle>(
    problem: &Problem<'_>,
    beyond: f64,
    oracle: &mut O,
    meter: &mut Meter,
) -> Result<Outcome, FartherThanCutoff> {
    Ok(
        match search_contact_at_start(problem, beyond, oracle, meter) {
            Some(Outcome::Touching { contact }) => Outcome::LeastDistance {
                lower: greater(0.0, contact.separation.lower),
                time: 0.0,
                contact,
            },
            Some(overlapping @ Outcome::Overlapping { .. }) => overlapping,
            Some(Outcome::Unresolved(known)) => {
                unresolved_outcome(greater(0.0, least_distance(problem)), known.limit)
            }
            _ => return Err(FartherThanCutoff { lower: beyond }),
        },
    )
}

/// The result that the bodies never come nearer than the cutoff distance of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FartherThanCutoff {
    /// A lower bound of the distance of the bodies at all times.
    pub(crate) lower: f64,
}

fn moves(problem: &Problem<'_>) -> bool {
    problem.a.path.moves() || problem.b.path.moves()
}

fn unresolved_outcome(lower: f64, limit: Limit) -> Outcome {
    Outcome::Unresolved(Unresolved::for_least_distance(lower, None, limit))
}

/// Returns whether the bodies come within the tolerance after the start, and not at the start.
pub(crate) fn is_contact_after_start(found: &Outcome, tolerance: f64) -> bool {
    match *found {
        Outcome::LeastDistance { time, contact, .. } => {
            time > 0.0 && contact.separation.upper <= tolerance
        }
        _ => false,
    }
}

/// The nearest two pieces found so far, with the clock at which they were measured.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearestPair {
    time: f64,
    /// The indices of the nearest pieces: of the problem's body A, and of its body B.
    pieces: [u32; 2],
    pub(crate) contact: Contact,
}

impl NearestPair {
    /// Returns the time of the measurement, and the contact with a lower bound of at most `lower`.
    fn time_and_contact(self, problem: &Problem<'_>, lower: f64) -> (f64, Contact) {
        let time = problem.time_of_clock(self.time);
        (time, self.contact.cap_lower_bound(lower))
    }
}

#[cfg(test)]
mod tests;
