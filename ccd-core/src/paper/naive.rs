//! A slow and simple reference schedule: all pairs of pieces advance together, by the least of their steps. It is
//! Algorithm 1 of the paper.

use crate::answer::{Answer, Limit, Outcome};
use crate::distance::oracle::DistanceOracle;
use crate::engine::answer::{EngineSchedule, answer};
use crate::engine::capacity::clear_and_shrink;
use crate::engine::meter::Meter;
use crate::engine::pieces::pair::Pair;
use crate::engine::pieces::placed_pair::PlacedPair;
use crate::engine::proven::ProvenFacts;
use crate::engine::scratch::Scratch;
use crate::math::order::lesser;
use crate::motion::bound::VelocityBound;
use crate::problem::{BodyWithPath, Problem};
use crate::settings::Shortcut;
use std::ops::ControlFlow;

/// A schedule that advances all pairs of pieces together by the least of their free times. It is Algorithm 1 of the
/// paper `[FAST06]`. A free time is the pair's distance, divided by a [bound](VelocityBound) of its rate of approach.
///
/// Every step costs one distance for each pair of pieces. Grazing passes, fast turning and bodies that are let go
/// from flush contact cost many steps. This schedule suits only bodies of few pieces, and checks of the other
/// schedules.
///
/// # Guarantee
/// The guarantee of [`Schedule::first_contact`](crate::Schedule::first_contact) with [`VelocityBound::Sound`]; with
/// [`VelocityBound::Published`] times may be late.
#[derive(Debug)]
pub struct Naive<O: DistanceOracle> {
    velocity_bound: VelocityBound,
    pairs: Vec<Pair<O::Cache>>,
    scratch: Scratch,
}

impl<O: DistanceOracle> Naive<O> {
    /// Creates a schedule that divides distances by the given bound of the rate of approach.
    pub fn new(bound: VelocityBound) -> Self {
        Naive {
            velocity_bound: bound,
            pairs: Vec::new(),
            scratch: None,
        }
    }
}

impl<O: DistanceOracle> Default for Naive<O> {
    fn default() -> Self {
        Naive::new(VelocityBound::default())
    }
}

impl<O: DistanceOracle> EngineSchedule<O> for Naive<O> {
    fn handles_accelerations(&self) -> bool {
        false
    }

    fn scratch(&mut self) -> &mut Scratch {
        &mut self.scratch
    }

    fn answer_first_contact(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer {
        let mut scratch = self.scratch.take();
        // The reference searches all periods of repeating motions.
        let mut problem = problem.clone();
        problem.shortcuts = problem.shortcuts.without(Shortcut::Rounds);
        let answer = answer(&problem, oracle, &mut scratch, |problem, oracle, meter| {
            let outcome = self.search(problem, oracle, meter);
            meter.stats.peak_front = self.pairs.len() as u64;
            outcome
        });
        self.scratch = scratch;
        answer
    }
}

impl<O: DistanceOracle> Naive<O> {
    fn search(&mut self, problem: &Problem<'_>, oracle: &mut O, meter: &mut Meter) -> Outcome {
        let (a, b) = (problem.a.body.pieces().len(), problem.b.body.pieces().len());
        let unresolved = |s: f64, reason| Outcome::unresolved(problem.time_of_clock(s), reason);
        clear_and_shrink(&mut self.pairs);
        let all = a as u64 * b as u64;
        if all > problem.budget {
            return unresolved(0.0, Limit::Budget);
        }
        let pairs = (0..a as u32).flat_map(|i| (0..b as u32).map(move |j| Pair::new(i, j)));
        self.pairs.extend(pairs);
        let reaches = [&problem.a, &problem.b].map(axis_distances_by_piece);
        let mut proven = ProvenFacts::default();
        let mut s = 0.0;
        while s < 1.0 {
            meter.stats.advancements += 1;
            let mut next = f64::INFINITY;
            let placed = PlacedPair::new(problem, [0, 0], s);
            for pair in &mut self.pairs {
                if let Err(limit) = meter.count_visit_and_check_limits(problem) {
                    return unresolved(s, limit);
                }
                let placed = placed.with_pieces(problem.pieces([pair.a, pair.b]));
                let reaches = [reaches[0][pair.a as usize], reaches[1][pair.b as usize]];
                let step =
                    pair.advance_with_free_time(&placed, oracle, meter, |placed, checked, kept| {
                        placed.free_time_along_axis(checked, kept, self.velocity_bound, reaches)
                    });
                match proven.free_time_or_outcome(problem, oracle, meter, step, s) {
                    ControlFlow::Continue(free) => next = lesser(next, free.clock_after(s)),
                    ControlFlow::Break(outcome) => return outcome,
                }
            }
            if let Some(outcome) = proven.check_containment_once_apart(problem) {
                return outcome;
            }
            s = next;
        }
        proven.final_outcome(problem)
    }
}

/// Returns for each piece the largest distance of its points from its body's axis of rotation.
fn axis_distances_by_piece(side: &BodyWithPath<'_>) -> Vec<f64> {
    let pieces = side.body.pieces().iter();
    pieces
        .map(|piece| side.path.max_distance_from_axis(piece.points))
        .collect()
}
