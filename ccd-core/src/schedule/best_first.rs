//! Every pair has its own clock; the pair whose proof expires first is examined next.

use super::answer::answer;
use super::contract::Schedule;
use super::memory::Kept;
use super::meter::Meter;
use super::nodes::closer_look::CloserLook;
use super::nodes::common::Common;
use super::nodes::expand::expand;
use super::nodes::roots::keep_apart;
use super::nodes::siblings::{Next, Siblings};
use super::out_of_reach::out_of_reach;
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
    kept: Kept,
}

impl<O: DistanceOracle> Default for BestFirst<O> {
    fn default() -> Self {
        BestFirst {
            queue: Queue::default(),
            kept: None,
        }
    }
}

#[derive(Debug)]
enum Item<C> {
    Siblings(Siblings),
    Pieces(Pair<C>),
}

impl<C> Item<C> {
    fn rank(&self) -> Rank {
        match self {
            Item::Siblings(_) => Rank::Siblings,
            Item::Pieces(_) => Rank::PiecePair,
        }
    }
}

impl<O: DistanceOracle> Schedule<O> for BestFirst<O> {
    fn solve(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer {
        let mut kept = self.kept.take();
        let answer = answer(problem, oracle, &mut kept, |problem, oracle, meter| {
            self.queue.clear();
            let outcome = self.first_contact(problem, oracle, meter);
            let stats = &mut meter.stats;
            stats.peak_front = stats.peak_front.max(self.queue.peak());
            outcome
        });
        self.queue.clear();
        self.kept = kept;
        answer
    }
}

impl<O: DistanceOracle> BestFirst<O> {
    fn first_contact(
        &mut self,
        problem: &Problem<'_>,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> Outcome {
        if out_of_reach(problem) || keep_apart(problem) {
            let proven_gap = problem.proven_gap(f64::INFINITY);
            return Outcome::Free { proven_gap };
        }
        if self.open_roots(problem).is_err() {
            return unresolved(problem, 0.0, Limit::Budget);
        }
        let common = Common::new(problem);
        let mut proven = Proven::default();
        let mut look = CloserLook::new(problem);
        loop {
            let visit = self.visit(&common, &mut look, oracle, meter, &mut proven);
            if let ControlFlow::Break(outcome) = visit {
                return outcome;
            }
        }
    }

    /// Examines the pair of least clock: proves it apart for longer, or splits it.
    #[inline]
    fn visit(
        &mut self,
        common: &Common<'_>,
        look: &mut CloserLook,
        oracle: &mut O,
        meter: &mut Meter,
        proven: &mut Proven,
    ) -> ControlFlow<Outcome> {
        let problem = common.problem;
        let Some((s, item)) = self.queue.least() else {
            return ControlFlow::Break(proven.end(problem));
        };
        if s > 0.0
            && let Some(outcome) = proven.past_start(problem)
        {
            return ControlFlow::Break(outcome);
        }
        if let Err(limit) = meter.visit() {
            return ControlFlow::Break(unresolved(problem, s, limit));
        }
        let (next, rest) = match item {
            Item::Pieces(pair) => {
                let step = pair.advance(problem, oracle, meter, s);
                match proven.conclude(problem, oracle, meter, step, s)? {
                    clock if clock >= 1.0 => self.queue.remove(),
                    clock => self.queue.renew(clock, Rank::PiecePair),
                }
                return ControlFlow::Continue(());
            }
            Item::Siblings(siblings) => {
                if let Some((clock, alone)) = look.part(problem, siblings, s) {
                    let rest = siblings.clock();
                    return self.wait(problem, s, rest, (clock, Item::Siblings(alone)));
                }
                // The rest of the siblings wait for their own clocks.
                (siblings.take_least(problem, s), siblings.clock())
            }
        };
        let new = match next {
            Next::Split(split) => {
                let expansion = expand(common, &split, s);
                proven.keep(f64::from(expansion.bounds.kept));
                let mut siblings = Siblings::new(&expansion, split, s);
                look.finish(problem, &split, s, &mut siblings, meter);
                (siblings.clock(), Item::Siblings(siblings))
            }
            Next::Ask(a, b) => {
                let mut pair = Pair::new(a, b);
                let step = pair.advance(problem, oracle, meter, s);
                let clock = proven.conclude(problem, oracle, meter, step, s)?;
                (clock, Item::Pieces(pair))
            }
        };
        self.wait(problem, s, rest, new)
    }

    /// Lets the siblings of a pair and what became of it at clock `s` wait for their clocks, if these
    /// are before the end.
    #[inline(always)]
    fn wait(
        &mut self,
        problem: &Problem<'_>,
        s: f64,
        rest: f64,
        (clock, new): (f64, Item<O::Cache>),
    ) -> ControlFlow<Outcome> {
        // Written so that NaN is not the end.
        match (rest >= 1.0, clock >= 1.0) {
            (false, false) => {
                self.queue.postpone(rest);
                if let Err(Full) = self.queue.push(clock, new.rank(), new) {
                    return ControlFlow::Break(unresolved(problem, s, Limit::Budget));
                }
            }
            (false, true) => self.queue.postpone(rest),
            (true, false) => self.queue.replace(clock, new.rank(), new),
            (true, true) => self.queue.remove(),
        }
        ControlFlow::Continue(())
    }

    fn open_roots(&mut self, problem: &Problem<'_>) -> Result<(), Full> {
        let item = match Next::roots(problem) {
            Next::Ask(a, b) => Item::Pieces(Pair::new(a, b)),
            Next::Split(split) => Item::Siblings(Siblings::roots(split.body)),
        };
        self.queue.push(0.0, item.rank(), item)
    }
}

fn unresolved(problem: &Problem<'_>, s: f64, reason: Limit) -> Outcome {
    Outcome::Unresolved {
        safe_until: problem.time(s),
        reason,
    }
}

#[cfg(test)]
mod tests;
