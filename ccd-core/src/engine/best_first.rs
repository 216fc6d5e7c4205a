//! Best-first search: always examines the pair with the least clock, the time until which the pair is proven apart. A
//! search for the first contact may stop at any time and continue later.

use super::answer::EngineSchedule;
use super::closer_look::BoundTightener;
use super::meter::Meter;
use super::proven::ProvenFacts;
use super::queue::Queue;
use super::scratch::Scratch;
use super::search::{AdvanceResult, Search, SearchHandler, WaitingItem};
use super::shortcuts::bounding_volumes::free_outcome_by_bounding_volumes;
use super::subproblems::{OutcomeWithTolerance, Subproblems};
use crate::answer::{Answer, Limit, Outcome};
use crate::distance::oracle::DistanceOracle;
use crate::motion::free_time::FreeTime;
use crate::problem::Problem;
use std::borrow::Cow;
use std::ops::ControlFlow::{self, Break, Continue};

/// The default schedule: a best-first search in order of time.
///
/// A pair of nodes carries the clock until which it is proven apart. The pair of least clock is split at the pose of
/// that clock, and its children are proven apart further, eight at once. The first pair of pieces found within the
/// tolerance is the answer: every other pair is certified beyond its time. No step visits all pairs, and distances
/// are computed between pieces only.
///
/// Keep the value between queries: it owns the queue's memory.
///
/// ```
/// use ccd_core::{glam::DVec3, schedule::BestFirst, *};
/// # struct Balls;
/// # impl DistanceOracle for Balls {
/// #     type Cache = ();
/// #     fn separation(&mut self, pair: &PiecePair<'_>, _: &mut ()) -> Result<Claim, GiveUpReason> {
/// #         let axis = pair.b_to_a.transform_point(pair.b.points[0]) - pair.a.points[0];
/// #         Ok(Claim { axis, a: ConvexCombination::from_single_point(0), b: ConvexCombination::from_single_point(0) })
/// #     }
/// # }
/// let ball = Body::sphere(0.5)?;
/// let mut schedule = BestFirst::default();
/// for speed in [1.0, 2.0] {
///     let flying = Motion::new(Pose::at(-3.0 * DVec3::X)?, speed * DVec3::X, DVec3::ZERO)?;
///     let query = Query::new((&ball, flying), (&ball, Motion::STILL), 4.0, &Settings::DEFAULT)?;
///     let outcome = schedule.first_contact(&query, &mut Balls)?.outcome;
///     assert!(matches!(outcome, Outcome::Contact { time, .. } if (time - 2.0 / speed).abs() < 1e-3));
/// }
/// # Ok::<(), InputError>(())
/// ```
#[derive(Debug)]
pub struct BestFirst<O: DistanceOracle> {
    pub(crate) queue: Queue<WaitingItem<O::Cache>>,
    pub(crate) scratch: Scratch,
}

impl<O: DistanceOracle> Default for BestFirst<O> {
    fn default() -> Self {
        BestFirst {
            queue: Queue::default(),
            scratch: None,
        }
    }
}

impl<O: DistanceOracle> EngineSchedule<O> for BestFirst<O> {
    fn handles_accelerations(&self) -> bool {
        true
    }

    fn scratch(&mut self) -> &mut Scratch {
        &mut self.scratch
    }

    fn answer_first_contact(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer {
        let mut search = BestFirstSearch::new(Cow::Borrowed(problem), std::mem::take(self));
        let progress = search.advance(oracle, f64::INFINITY);
        *self = search.into_schedule();
        match progress {
            Progress::Answered(answer) => answer,
            Progress::ApartUntil(_) => unreachable!("no pair waits for an infinite time"),
        }
    }
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

/// A search for the first contact of two bodies with constant velocities. It stops at any time, and continues later.
pub(crate) struct BestFirstSearch<'p, 'a, O: DistanceOracle> {
    subproblems: Subproblems<'p, 'a>,
    /// The queue of waiting pairs. The meter has the scratch memory.
    schedule: BestFirst<O>,
    pub(crate) meter: Meter,
    /// The state of the search of the current problem; `None` before its first step.
    state: Option<SearchState>,
    answer: Option<Answer>,
}

/// The state of the search of one problem between two steps, except for the waiting pairs.
#[derive(Debug)]
struct SearchState {
    bound_tightener: BoundTightener,
    first_contact: FirstContact,
}

impl<'p, 'a, O: DistanceOracle> BestFirstSearch<'p, 'a, O> {
    pub(crate) fn new(problem: Cow<'p, Problem<'a>>, mut memory: BestFirst<O>) -> Self {
        let mut meter = Meter::new(&problem);
        meter.scratch = memory.scratch.take();
        memory.queue.clear();
        BestFirstSearch {
            subproblems: Subproblems::new(problem),
            schedule: memory,
            meter,
            state: None,
            answer: None,
        }
    }

    /// Returns the schedule with its memory, for another search.
    pub(crate) fn into_schedule(mut self) -> BestFirst<O> {
        self.schedule.queue.clear();
        self.schedule.scratch = self.meter.scratch;
        self.schedule
    }

    /// Searches until the bodies are proven apart up to the time `until` or later, or there is an answer.
    pub(crate) fn advance(&mut self, oracle: &mut O, until: f64) -> Progress {
        if let Some(answer) = self.answer {
            return Progress::Answered(answer);
        }
        let before = oracle.effort();
        let found = loop {
            match self.search_problem(oracle, until) {
                Continue(time) => break Continue(time),
                Break(outcome) => {
                    if let Break(found) = self.finish_problem(outcome, oracle) {
                        break Break(found);
                    }
                }
            }
        };
        let stats = &mut self.meter.stats;
        stats.oracle_effort = stats.oracle_effort + (oracle.effort() - before);
        match found {
            Continue(time) => Progress::ApartUntil(time),
            Break((outcome, tolerance)) => Progress::Answered(*self.answer.insert(Answer {
                outcome,
                tolerance,
                stats: *stats,
            })),
        }
    }

    /// Searches the current problem up to the time `until`. Returns the time that is reached, or the problem's outcome.
    fn search_problem(&mut self, oracle: &mut O, until: f64) -> ControlFlow<Outcome, f64> {
        let problem = &*self.subproblems.current();
        let until = self.subproblems.clock_not_before(problem, until);
        let mut search = Search::new(&mut self.schedule.queue, oracle, &mut self.meter);
        let state = match &mut self.state {
            Some(state) => state,
            state => {
                if let Some(free) = free_outcome_by_bounding_volumes(problem) {
                    return Break(free);
                }
                if search.push_roots(problem).is_err() {
                    return Break(Outcome::unresolved(
                        problem.time_of_clock(0.0),
                        Limit::Budget,
                    ));
                }
                state.insert(SearchState {
                    bound_tightener: BoundTightener::new(problem),
                    first_contact: FirstContact::default(),
                })
            }
        };
        state.first_contact.until = until;
        search
            .resume(
                problem,
                &mut state.bound_tightener,
                &mut state.first_contact,
            )
            .map_continue(|s| problem.time_of_clock(s))
    }

    /// Turns to the next problem after the outcome of the current one. Breaks with the outcome of the query if there is
    /// no other.
    fn finish_problem(
        &mut self,
        outcome: Outcome,
        oracle: &mut O,
    ) -> ControlFlow<OutcomeWithTolerance> {
        let (queue, stats) = (&mut self.schedule.queue, &mut self.meter.stats);
        stats.peak_front = stats.peak_front.max(queue.peak_length());
        queue.clear();
        self.state = None;
        self.subproblems
            .next_problem_or_outcome(outcome, oracle, &mut self.meter)
    }
}

/// The question for the first contact up to a clock. All pairs are proven apart until the clock of the next one.
#[derive(Debug, Default)]
struct FirstContact {
    proven_facts: ProvenFacts,
    until: f64,
}

impl<O: DistanceOracle> SearchHandler<O> for FirstContact {
    /// The outcome, or the clock of the next pair if that is not before the requested clock.
    type Conclusion = ControlFlow<Outcome, f64>;

    #[inline]
    fn stop_before_clock(
        &mut self,
        problem: &Problem<'_>,
        s: f64,
    ) -> ControlFlow<Self::Conclusion> {
        if s > 0.0
            && let Some(inside) = self.proven_facts.check_containment_once_apart(problem)
        {
            return Break(Break(inside));
        }
        if s >= self.until {
            return Break(Continue(s));
        }
        Continue(())
    }

    fn on_advance(
        &mut self,
        problem: &Problem<'_>,
        oracle: &mut O,
        meter: &mut Meter,
        advance: AdvanceResult,
    ) -> ControlFlow<Self::Conclusion, FreeTime> {
        let AdvanceResult {
            clock,
            step_outcome: step,
            ..
        } = advance;
        self.proven_facts
            .free_time_or_outcome(problem, oracle, meter, step, clock)
            .map_break(Break)
    }

    fn on_limit(&mut self, problem: &Problem<'_>, s: f64, reason: Limit) -> Self::Conclusion {
        Break(Outcome::unresolved(problem.time_of_clock(s), reason))
    }

    fn on_end(&mut self, problem: &Problem<'_>) -> Self::Conclusion {
        Break(self.proven_facts.final_outcome(problem))
    }
}

#[cfg(test)]
mod tests;
