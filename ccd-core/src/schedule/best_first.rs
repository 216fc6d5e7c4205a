//! Every pair has its own clock; the pair whose proof expires first is examined next.

use super::answer::answer;
use super::contract::Schedule;
use super::meter::Meter;
use super::nodes::expand::{Split, expand};
use super::nodes::siblings::{Next, Siblings};
use super::pieces::pair::Pair;
use super::proven::Proven;
use super::queue::{Full, Queue, Rank};
use crate::distance::oracle::DistanceOracle;
use crate::outcome::{Answer, Limit, Outcome};
use crate::problem::Problem;
use std::ops::ControlFlow;

/// Best-first search by time, the default.
///
/// A pair of nodes carries the time until which it is proven apart. The pair of least clock is
/// split at the pose of that time, and its children are proven apart further, eight at once. The
/// first pair of pieces found within the tolerance is the answer: every other pair is certified
/// beyond its time. There is never a pass over all pairs, and distances are computed between pieces
/// only.
///
/// Keep it between queries: it owns the queue's memory.
///
/// ```
/// use ccd_core::{glam::DVec3, schedule::BestFirst, *};
/// # struct Balls;
/// # impl DistanceOracle for Balls {
/// #     type Cache = ();
/// #     fn separation(&mut self, pair: &PiecePair<'_>, _: &mut ()) -> Result<Claim, GiveUp> {
/// #         let axis = pair.b_to_a.point(pair.b.points[0]) - pair.a.points[0];
/// #         Ok(Claim { axis, a: Combination::point(0), b: Combination::point(0) })
/// #     }
/// # }
/// let ball = Body::ball(0.5)?;
/// let mut schedule = BestFirst::default();
/// for speed in [1.0, 2.0] {
///     let flying = Motion::new(Pose::at(-3.0 * DVec3::X)?, speed * DVec3::X, DVec3::ZERO)?;
///     let problem = Problem::new((&ball, flying), (&ball, Motion::STILL), 4.0, &Config::default())?;
///     let outcome = schedule.solve(&problem, &mut Balls).outcome;
///     assert!(matches!(outcome, Outcome::Contact { time, .. } if (time - 2.0 / speed).abs() < 1e-3));
/// }
/// # Ok::<(), InputError>(())
/// ```
#[derive(Debug)]
pub struct BestFirst<O: DistanceOracle> {
    queue: Queue<Item<O::Cache>>,
}

impl<O: DistanceOracle> Default for BestFirst<O> {
    fn default() -> Self {
        BestFirst {
            queue: Queue::default(),
        }
    }
}

#[derive(Debug)]
enum Item<C> {
    Siblings(Siblings),
    Pieces(Pair<C>),
}

/// The next item to examine: a pair of pieces, or a pair of nodes with one to be split.
enum Found<C> {
    Pieces(Pair<C>),
    Split(Split),
}

impl<O: DistanceOracle> Schedule<O> for BestFirst<O> {
    fn solve(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer {
        answer(problem, oracle, |problem, oracle, meter| {
            self.queue.clear();
            let outcome = self.first_contact(problem, oracle, meter);
            let stats = &mut meter.stats;
            stats.peak_front = stats.peak_front.max(self.queue.peak());
            outcome
        })
    }
}

impl<O: DistanceOracle> BestFirst<O> {
    fn first_contact(
        &mut self,
        problem: &Problem<'_>,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> Outcome {
        let mut proven = Proven::default();
        let unresolved = |s: f64, reason| Outcome::Unresolved {
            safe_until: problem.time(s),
            reason,
        };
        if self.open_roots(problem).is_err() {
            return unresolved(0.0, Limit::Budget);
        }
        while let Some((s, found)) = self.next(problem) {
            if s > 0.0
                && let Some(outcome) = proven.past_start(problem)
            {
                return outcome;
            }
            if let Err(limit) = meter.visit() {
                return unresolved(s, limit);
            }
            let pushed = match found {
                Found::Split(split) => {
                    let expansion = expand(problem, &split, s);
                    proven.keep(f64::from(expansion.bounds.kept));
                    self.push_siblings(Siblings::new(problem, &expansion, split, s))
                }
                Found::Pieces(mut pair) => {
                    let step = pair.advance(problem, oracle, meter, s);
                    match proven.conclude(problem, oracle, meter, step, s) {
                        ControlFlow::Continue(clock) => self.push_pair(clock, pair),
                        ControlFlow::Break(outcome) => return outcome,
                    }
                }
            };
            if pushed.is_err() {
                return unresolved(s, Limit::Budget);
            }
        }
        proven.end(problem)
    }

    fn open_roots(&mut self, problem: &Problem<'_>) -> Result<(), Full> {
        match Next::roots(problem) {
            Next::Ask(a, b) => self.push_pair(0.0, Pair::new(a, b)),
            Next::Split(split) => self.push_siblings(Siblings::roots(split.body)),
        }
    }

    /// Takes out the pair of least clock; the rest of its siblings wait for their own clocks.
    fn next(&mut self, problem: &Problem<'_>) -> Option<(f64, Found<O::Cache>)> {
        let visit = self.queue.visit()?;
        let s = visit.clock;
        let found = match visit.item {
            Item::Pieces(pair) => {
                let found = Found::Pieces(pair.clone());
                visit.remove();
                found
            }
            Item::Siblings(siblings) => {
                let next = siblings.take_least(problem);
                match siblings.clock() {
                    clock if clock < 1.0 => visit.postpone(clock),
                    _ => visit.remove(),
                }
                match next {
                    Next::Ask(a, b) => Found::Pieces(Pair::new(a, b)),
                    Next::Split(split) => Found::Split(split),
                }
            }
        };
        Some((s, found))
    }

    fn push_siblings(&mut self, siblings: Siblings) -> Result<(), Full> {
        let clock = siblings.clock();
        if clock < 1.0 {
            self.queue
                .push(clock, Rank::Siblings, Item::Siblings(siblings))?;
        }
        Ok(())
    }

    fn push_pair(&mut self, clock: f64, pair: Pair<O::Cache>) -> Result<(), Full> {
        if clock < 1.0 {
            self.queue
                .push(clock, Rank::PiecePair, Item::Pieces(pair))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
