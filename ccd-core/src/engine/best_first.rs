//! Best-first search: always examines the pair with the least clock, the time until which the pair is proven apart.

use super::answer::{EngineSchedule, answer, search_by_period};
use super::meter::Meter;
use super::proven::ProvenFacts;
use super::queue::Queue;
use super::scratch::Scratch;
use super::search::{AdvanceResult, Search, SearchHandler, WaitingItem};
use crate::answer::{Answer, Limit, Outcome};
use crate::distance::oracle::DistanceOracle;
use crate::engine::shortcuts::bounding_volumes::free_outcome_by_bounding_volumes;
use crate::problem::Problem;
use std::ops::ControlFlow;

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
        let mut scratch = self.scratch.take();
        let answer = answer(problem, oracle, &mut scratch, |problem, oracle, meter| {
            search_by_period(problem, meter, |problem, meter| {
                self.queue.clear();
                let outcome = self.search(problem, oracle, meter);
                let stats = &mut meter.stats;
                stats.peak_front = stats.peak_front.max(self.queue.peak_length());
                outcome
            })
        });
        self.queue.clear();
        self.scratch = scratch;
        answer
    }
}

impl<O: DistanceOracle> BestFirst<O> {
    fn search(&mut self, problem: &Problem<'_>, oracle: &mut O, meter: &mut Meter) -> Outcome {
        if let Some(free) = free_outcome_by_bounding_volumes(problem) {
            return free;
        }
        let mut search = Search::new(&mut self.queue, oracle, meter);
        search.run(problem, &mut ProvenFacts::default())
    }
}

/// The search for the first contact. All pairs are proven apart until the clock of the next one.
impl<O: DistanceOracle> SearchHandler<O> for ProvenFacts {
    type Conclusion = Outcome;

    #[inline]
    fn stop_before_clock(&mut self, problem: &Problem<'_>, s: f64) -> ControlFlow<Outcome> {
        if s > 0.0
            && let Some(inside) = self.check_containment_once_apart(problem)
        {
            return ControlFlow::Break(inside);
        }
        ControlFlow::Continue(())
    }

    fn on_advance(
        &mut self,
        problem: &Problem<'_>,
        oracle: &mut O,
        meter: &mut Meter,
        advance: AdvanceResult,
    ) -> ControlFlow<Outcome, f64> {
        let AdvanceResult {
            clock,
            step_outcome: step,
            ..
        } = advance;
        ProvenFacts::next_clock_or_outcome(self, problem, oracle, meter, step, clock)
    }

    fn on_limit(&mut self, problem: &Problem<'_>, s: f64, reason: Limit) -> Outcome {
        Outcome::unresolved(problem.time_of_clock(s), reason)
    }

    fn on_end(&mut self, problem: &Problem<'_>) -> Outcome {
        self.final_outcome(problem)
    }
}

#[cfg(test)]
mod tests;
