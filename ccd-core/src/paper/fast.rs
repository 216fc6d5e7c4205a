//! The schedule FAST of the paper: all pairs of a front of the bounding volume traversal tree advance by one common
//! time step.

mod descent;
mod hull_pair;
mod reach;
mod traversal_tree;

use crate::answer::{Answer, Limit, Outcome};
use crate::distance::oracle::DistanceOracle;
use crate::engine::answer::{EngineSchedule, answer};
use crate::engine::best_first::BestFirst;
use crate::engine::meter::Meter;
use crate::engine::proven::ProvenFacts;
use crate::engine::scratch::Scratch;
use crate::motion::bound::VelocityBound;
use crate::problem::Problem;
use descent::Descent;
use hull_pair::HullTreePair;
use reach::AxisDistanceCache;
use std::ops::ControlFlow;
use traversal_tree::TraversalTree;

/// Hierarchical conservative advancement over [hull trees](crate::HullTree), as published. It is Algorithm 2 of the
/// paper `[FAST06]`.
///
/// A descent through pairs of nodes computes the distance of the bodies `[FAST06 Alg. 3]`. The pairs at which it stops,
/// the *front*, cover all pairs of pieces. Each pair stays apart for its distance, divided by a [bound](VelocityBound)
/// of its rate of approach. All pairs are advanced by the least of these times, and the distance is computed again,
/// until it is within the tolerance. The next descent starts from the front of the last one `[SWIFT01]`. That front
/// contains the pieces that were nearest, so that the distance is bounded before anything is split, and the nearest
/// pair is always split first. Pairs that have become far are joined again.
///
/// The paper measures the distance of the bodies whatever their motion. Here a pair that the bound keeps apart to the
/// end of the duration is neither split nor visited again. Large nodes that overlap deeply are split unmeasured.
///
/// This schedule is for comparison: [`BestFirst`] needs no common step.
///
/// Bodies of one piece need no tree. If another body has [none](crate::Body::hull_tree),
/// [`BestFirst`] answers the query.
///
/// # Guarantee
/// The guarantee of [`Schedule::first_contact`](crate::Schedule::first_contact) with [`VelocityBound::Sound`]; with
/// [`VelocityBound::Published`] times may be late and contacts missed.
///
/// The bodies come nearer by a share of their distance in every step. Grazing passes and fast
/// turning therefore cost many steps. Bodies that are [let go](crate::StartPolicy::Leave) from
/// flush contact and turn may cost the whole budget, where [`BestFirst`] follows the points' paths.
#[derive(Debug)]
pub struct Fast<O: DistanceOracle> {
    velocity_bound: VelocityBound,
    traversal_tree: TraversalTree<O::Cache>,
    axis_distance_cache: AxisDistanceCache,
    best_first_schedule: BestFirst<O>,
    scratch: Scratch,
}

impl<O: DistanceOracle> Fast<O> {
    /// Creates a schedule whose steps are distances divided by the given bound of the velocity.
    pub fn new(bound: VelocityBound) -> Self {
        Fast {
            velocity_bound: bound,
            traversal_tree: TraversalTree::default(),
            axis_distance_cache: AxisDistanceCache::default(),
            best_first_schedule: BestFirst::default(),
            scratch: None,
        }
    }
}

impl<O: DistanceOracle> Default for Fast<O> {
    fn default() -> Self {
        Fast::new(VelocityBound::default())
    }
}

impl<O: DistanceOracle> EngineSchedule<O> for Fast<O> {
    fn handles_accelerations(&self) -> bool {
        false
    }

    fn scratch(&mut self) -> &mut Scratch {
        &mut self.scratch
    }

    fn answer_first_contact(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer {
        let Some(hulls) = HullTreePair::from_problem(problem) else {
            return self
                .best_first_schedule
                .answer_first_contact(problem, oracle);
        };
        self.axis_distance_cache.invalidate();
        let mut scratch = self.scratch.take();
        let answer = answer(problem, oracle, &mut scratch, |problem, oracle, meter| {
            self.advance(problem, hulls, oracle, meter)
        });
        self.scratch = scratch;
        answer
    }
}

impl<O: DistanceOracle> Fast<O> {
    /// Computes the distance of the bodies repeatedly, and advances both by a time for which they stay apart. This is
    /// Algorithm 2 of the paper.
    fn advance(
        &mut self,
        problem: &Problem<'_>,
        hulls: HullTreePair<'_>,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> Outcome {
        let mut proven = ProvenFacts::default();
        self.traversal_tree.reset(hulls);
        let mut s = 0.0;
        while s < 1.0 {
            meter.stats.advancements += 1;
            let mut descent = Descent {
                problem,
                hulls,
                velocity_bound: self.velocity_bound,
                traversal_tree: &mut self.traversal_tree,
                axis_distance_cache: &mut self.axis_distance_cache,
                proven_facts: &proven,
                oracle,
                meter,
            };
            let next = descent.step(s);
            let stats = &mut meter.stats;
            stats.peak_front = stats.peak_front.max(self.traversal_tree.peak_leaf_count());
            let next = match next {
                ControlFlow::Continue(next) => next,
                ControlFlow::Break(outcome) => return outcome,
            };
            if let Some(outcome) = proven.check_containment_once_apart(problem) {
                return outcome;
            }
            if !(next > s) {
                return Outcome::unresolved(problem.time_of_clock(s), Limit::Stalled);
            }
            s = next;
        }
        proven.final_outcome(problem)
    }
}

#[cfg(test)]
mod tests;
