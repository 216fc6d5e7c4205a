//! Searches for the first contact in steps: the search stops at a given time, and continues later.

use super::along::contacts::first_contact;
use crate::answer::{Answer, Limit, Outcome};
use crate::distance::oracle::DistanceOracle;
use crate::engine::answer::{achieved_tolerance, problem_ignoring_start_contact};
use crate::engine::best_first::BestFirst;
use crate::engine::closer_look::BoundTightener;
use crate::engine::given_bodies::outcome_on_original_bodies;
use crate::engine::meter::Meter;
use crate::engine::proven::ProvenFacts;
use crate::engine::rounds::PeriodicSearch;
use crate::engine::search::{Search, SearchHandler};
use crate::engine::shortcuts::bounding_volumes::free_outcome_by_bounding_volumes;
use crate::error::InputError;
use crate::problem::Problem;
use crate::query::Query;
use crate::settings::StartPolicy;
use std::ops::ControlFlow;

/// A search for the first contact that can stop at any time and continue later.
///
/// It serves queries for the first contact among many pairs of bodies. No pair is proven further than the answer
/// needs: the pair that is proven least far continues next.
///
/// ```
/// use ccd_core::{schedule::{BestFirst, FirstContactSearch, Progress}, *};
/// # struct Balls;
/// # impl DistanceOracle for Balls {
/// #     type Cache = ();
/// #     fn separation(&mut self, pair: &PiecePair<'_>, _: &mut ()) -> Result<Claim, GiveUpReason> {
/// #         let axis = pair.b_to_a.transform_point(pair.b.points[0]) - pair.a.points[0];
/// #         Ok(Claim { axis, a: ConvexCombination::from_single_point(0), b: ConvexCombination::from_single_point(0) })
/// #     }
/// # }
/// let ball = Body::sphere(0.5)?;
/// let flying = Motion::new(Pose::at([-3.0, 0.0, 0.0])?, [1.0, 0.0, 0.0], [0.0; 3])?;
/// let query = Query::new((&ball, flying), (&ball, Motion::STILL), 4.0, &Settings::DEFAULT)?;
/// let mut search = FirstContactSearch::new(query, BestFirst::default());
/// let Progress::ApartUntil(time) = search.advance(&mut Balls, 0.5)? else { panic!("they are far apart") };
/// assert!(time >= 0.5 && time <= 2.0);
/// let Progress::Answered(answer) = search.advance(&mut Balls, 4.0)? else { panic!("all time is up") };
/// assert!(matches!(answer.outcome, Outcome::Contact { .. }));
/// # Ok::<(), InputError>(())
/// ```
pub struct FirstContactSearch<'a, O: DistanceOracle>(ResumableSearchKind<'a, O>);

#[allow(clippy::large_enum_variant, reason = "most searches go in steps")]
enum ResumableSearchKind<'a, O: DistanceOracle> {
    /// A search for bodies with constant velocities, which is done in steps.
    Stepwise(IncrementalSearch<'a, O>),
    /// A search for bodies on trajectories, which is done to its end in the first step.
    SingleStep {
        query: Query<'a>,
        search_engine: BestFirst<O>,
        answer: Option<Answer>,
    },
}

/// A search in steps, about two bodies with constant velocities.
struct IncrementalSearch<'a, O: DistanceOracle> {
    /// The problem that reports a contact at the start. A scene moves its searches, so that what few of them have lies
    /// beside them.
    problem: Problem<'a>,
    /// The problem that is searched once there was a contact at the start that is to be ignored.
    problem_after_start: Option<Box<Problem<'a>>>,
    /// The progress over the periods of repeating motions, and the periods that are searched at present; `None` if the
    /// motions do not repeat.
    periodic_search_and_problem: Option<Box<(PeriodicSearch<'a>, Problem<'a>)>>,
    /// The policy for a contact at the start, until it has been applied.
    start_policy: StartPolicy,
    schedule: BestFirst<O>,
    meter: Meter,
    /// The state of the search; `None` before the first step.
    state: Option<SearchState>,
    answer: Option<Answer>,
}

/// The state of a search between two steps, except for the waiting pairs.
#[derive(Debug)]
struct SearchState {
    bound_tightener: BoundTightener,
    proven_facts: ProvenFacts,
}

/// The progress of a search for the first contact: a certified time, or the answer.
#[allow(clippy::large_enum_variant, reason = "it is returned, not kept")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Progress {
    /// The bodies are certified apart until this time.
    ApartUntil(f64),
    /// The search is finished, with this answer.
    Answered(Answer),
}

impl<'a, O: DistanceOracle> FirstContactSearch<'a, O> {
    /// Creates the search for a query. It reuses the allocations of the schedule `memory`. The time until the
    /// [deadline](crate::Settings::deadline) starts now.
    pub fn new(mut query: Query<'a>, memory: BestFirst<O>) -> Self {
        FirstContactSearch(match query.constant_velocity_problem.take() {
            Some(problem) => ResumableSearchKind::Stepwise(IncrementalSearch::new(problem, memory)),
            None => ResumableSearchKind::SingleStep {
                query,
                search_engine: memory,
                answer: None,
            },
        })
    }

    /// Returns the schedule with its memory, for another search.
    pub fn into_schedule(self) -> BestFirst<O> {
        match self.0 {
            ResumableSearchKind::Stepwise(steps) => steps.into_schedule(),
            ResumableSearchKind::SingleStep {
                search_engine: memory,
                ..
            } => memory,
        }
    }

    /// Continues the search until the bodies are proven apart up to the time `until` or later, or there is an answer.
    /// Along trajectories other than [motions](crate::Motion), the search continues to the answer.
    ///
    /// # Guarantee
    /// [Never late](crate#guarantee); ends on every input. The answer has the same bits as that of [`BestFirst`],
    /// whatever the steps, unless a deadline ends the search.
    ///
    /// # Errors
    /// An [`InputError`] if a trajectory has no motion at some time, or one out of range.
    pub fn advance(&mut self, oracle: &mut O, until: f64) -> Result<Progress, InputError> {
        match &mut self.0 {
            ResumableSearchKind::Stepwise(steps) => Ok(steps.advance(oracle, until)),
            ResumableSearchKind::SingleStep {
                query,
                search_engine: memory,
                answer,
            } => {
                if answer.is_none() {
                    *answer = Some(first_contact(memory, query, oracle)?);
                }
                Ok(answer.map_or(Progress::ApartUntil(0.0), Progress::Answered))
            }
        }
    }
}

impl<'a, O: DistanceOracle> IncrementalSearch<'a, O> {
    fn new(mut problem: Problem<'a>, mut memory: BestFirst<O>) -> Self {
        let mut meter = Meter::new(&problem);
        meter.scratch = memory.scratch.take();
        memory.queue.clear();
        let start_policy = std::mem::replace(&mut problem.start_policy, StartPolicy::Report);
        IncrementalSearch {
            periodic_search_and_problem: start_periodic_search(&problem),
            start_policy,
            problem_after_start: None,
            problem,
            schedule: memory,
            meter,
            state: None,
            answer: None,
        }
    }

    fn into_schedule(mut self) -> BestFirst<O> {
        self.schedule.queue.clear();
        self.schedule.scratch = self.meter.scratch;
        self.schedule
    }

    fn advance(&mut self, oracle: &mut O, until: f64) -> Progress {
        if let Some(answer) = self.answer {
            return Progress::Answered(answer);
        }
        let before = oracle.effort();
        let found = self
            .search(oracle, until)
            .map_break(|(outcome, tolerance)| {
                let within = self.problem.margin + tolerance;
                let (problem, meter) = (&self.problem, &mut self.meter);
                let outcome =
                    outcome_on_original_bodies(problem, oracle, meter, outcome, |_| within);
                (outcome, tolerance)
            });
        let stats = &mut self.meter.stats;
        stats.oracle_effort = stats.oracle_effort + (oracle.effort() - before);
        match found {
            ControlFlow::Continue(time) => Progress::ApartUntil(time),
            ControlFlow::Break((outcome, tolerance)) => {
                Progress::Answered(*self.answer.insert(Answer {
                    outcome,
                    tolerance,
                    stats: *stats,
                }))
            }
        }
    }

    /// Continues the search for the first contact up to the time `until`, unless it is decided before. Returns the time
    /// that is reached, or the outcome with its tolerance.
    fn search(&mut self, oracle: &mut O, until: f64) -> ControlFlow<(Outcome, f64), f64> {
        loop {
            let outcome = match self.run(oracle, until) {
                ControlFlow::Continue(time) => return ControlFlow::Continue(time),
                ControlFlow::Break(outcome) => outcome,
            };
            let stats = &mut self.meter.stats;
            stats.peak_front = stats.peak_front.max(self.schedule.queue.peak_length());
            self.schedule.queue.clear();
            self.state = None;
            let outcome = match &mut self.periodic_search_and_problem {
                None => outcome,
                Some(periodic) => {
                    let (rounds, part) = &mut **periodic;
                    match rounds.start_next_round_or_finish(&outcome, &mut self.meter) {
                        ControlFlow::Break(outcome) => outcome,
                        ControlFlow::Continue(()) => {
                            *part = rounds.problem_of_round();
                            continue;
                        }
                    }
                }
            };
            let current = self.problem_after_start.as_deref();
            let current = current.unwrap_or(&self.problem);
            let parting = problem_ignoring_start_contact(
                current,
                self.start_policy,
                &outcome,
                oracle,
                &mut self.meter,
            );
            match parting {
                Some(parting) => {
                    self.periodic_search_and_problem = start_periodic_search(&parting);
                    self.problem_after_start = Some(Box::new(parting));
                    self.start_policy = StartPolicy::Report;
                }
                None => {
                    let parting = self.problem_after_start.as_deref();
                    let tolerance = parting.map_or(self.problem.tolerance, |parting| {
                        achieved_tolerance(parting, &outcome)
                    });
                    return ControlFlow::Break((outcome, tolerance));
                }
            }
        }
    }

    /// Searches the current problem up to the time `until`; for repeating motions, only the periods that are searched
    /// at present. Returns the time that is reached, or the outcome.
    fn run(&mut self, oracle: &mut O, until: f64) -> ControlFlow<Outcome, f64> {
        // The time of the clock that is reached is rounded down, but not to before the requested time.
        let (problem, until) = match &self.periodic_search_and_problem {
            Some(periodic) => (&periodic.1, until * (1.0 + 4.0 * f64::EPSILON)),
            None => {
                let current = self.problem_after_start.as_deref();
                (current.unwrap_or(&self.problem), until.next_up())
            }
        };
        let clock = problem.clock_of_time(until);
        let until = (clock * (1.0 + 4.0 * f64::EPSILON)).next_up();
        let mut search = Search::new(&mut self.schedule.queue, oracle, &mut self.meter);
        let SearchState {
            bound_tightener: look,
            proven_facts: proven,
        } = match &mut self.state {
            Some(state) => state,
            state => {
                if let Some(free) = free_outcome_by_bounding_volumes(problem) {
                    return ControlFlow::Break(free);
                }
                let mut proven = ProvenFacts::default();
                if search.push_roots(problem).is_err() {
                    return ControlFlow::Break(SearchHandler::<O>::on_limit(
                        &mut proven,
                        problem,
                        0.0,
                        Limit::Budget,
                    ));
                }
                let look = BoundTightener::new(problem);
                state.insert(SearchState {
                    bound_tightener: look,
                    proven_facts: proven,
                })
            }
        };
        let reached = search.run_until(problem, look, proven, until);
        reached.map_continue(|s| problem.time_of_clock(s))
    }
}

fn start_periodic_search<'a>(
    problem: &Problem<'a>,
) -> Option<Box<(PeriodicSearch<'a>, Problem<'a>)>> {
    let rounds = PeriodicSearch::for_problem(problem)?;
    let part = rounds.problem_of_round();
    Some(Box::new((rounds, part)))
}

#[cfg(test)]
mod tests;
