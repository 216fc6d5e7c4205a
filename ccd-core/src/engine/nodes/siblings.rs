//! The pairs that one split creates: they wait in the queue together, and are removed one by one.

use super::bounds::EightPairFreeTimes;
use super::free_times::FreeTimes;
use super::split::Split;
use crate::body::tree::{LANES, NodeId};
use crate::math::order::greater;
use crate::motion::free_time::FreeTime;
use crate::problem::{BodyWithPath, Problem, WhichBody};
use crate::rounding::UNIT_ROUNDOFF_F64;

/// Up to eight waiting pairs: the children of a split node, each with the same node of the other body.
#[derive(Debug)]
pub(crate) struct Siblings {
    /// For each pair, how long after `start_clock` it is certified apart; infinite for a finished pair.
    pub(super) free_times: FreeTimes,
    start_clock: f64,
    /// The split that created the pairs.
    split: Split,
    pub(super) first_child: NodeId,
    /// The children that are to be split before the other node, as bits.
    split_child_mask: u8,
    /// True if the other node is a single piece, and cannot be split.
    other_is_piece: bool,
    /// The pairs for which a second visit is better than a split, as bits.
    revisit_mask: u8,
    /// The number of times that the pair was advanced since it was removed from the pairs of its split; 0 before that.
    advance_count: u8,
}

/// The next step for a pair whose clock has run out.
#[derive(Clone, Copy, Debug)]
pub(crate) enum NextStep {
    /// Two pieces, of A and of B, whose distance the oracle computes next.
    MeasurePieces(u32, u32),
    /// One of the two nodes is split next.
    Split(Split),
}

impl NextStep {
    /// Returns the first step of a search, for the pair of both roots. If both can be split, the smaller one is, as a
    /// large node is best kept whole as long as possible.
    pub(crate) fn roots(problem: &Problem<'_>) -> Self {
        if problem.have_one_piece_each() {
            return NextStep::MeasurePieces(0, 0);
        }
        let (a, b) = (problem.a.body.tree(), problem.b.body.tree());
        let body = match (a.piece(0), b.piece(0)) {
            (None, None) if !(b.radius() < a.radius()) => WhichBody::A,
            (None, Some(_)) => WhichBody::A,
            _ => WhichBody::B,
        };
        NextStep::Split(Split::with_all_children(body, 0, 0))
    }
}

impl Siblings {
    /// Creates the pair of both roots, of which the root of `body` is split first.
    pub(crate) fn roots(body: WhichBody) -> Self {
        Siblings {
            free_times: FreeTimes::single_in_lane(0),
            start_clock: 0.0,
            split: Split::with_all_children(body, 0, 0),
            first_child: 0,
            split_child_mask: 1,
            other_is_piece: false,
            revisit_mask: 0,
            advance_count: 0,
        }
    }

    /// Creates the pairs of the children of a node that is split at clock `s`, from their bounds.
    #[inline(always)]
    pub(crate) fn new(
        bounds: &EightPairFreeTimes,
        first_child: NodeId,
        split: Split,
        s: f64,
    ) -> Self {
        Siblings {
            free_times: bounds.free_times,
            start_clock: s,
            split,
            first_child,
            split_child_mask: bounds.split_child_mask,
            other_is_piece: bounds.other_is_piece,
            revisit_mask: bounds.revisit_mask,
            advance_count: 0,
        }
    }

    /// Returns the pairs with the clock 0 at the start and without second visits, which would give the same result:
    /// their free times are distances.
    pub(crate) fn with_free_times_as_distances(self) -> Self {
        Siblings {
            start_clock: 0.0,
            revisit_mask: 0,
            ..self
        }
    }

    /// Returns the least clock of the pairs, rounded down; infinite if all are finished.
    #[inline]
    pub(crate) fn clock(&self) -> f64 {
        let sum = self.start_clock + f64::from(self.free_times.least_time());
        // One step down undoes the rounding of the sum. This product is that step; the sum of numbers so small that it
        // is not has no rounding.
        greater(self.start_clock, sum * (1.0 - UNIT_ROUNDOFF_F64))
    }

    /// Returns the nodes of A and of B that are proven apart for the shortest time.
    #[inline]
    pub(crate) fn least_pair(&self) -> [NodeId; 2] {
        self.node_pair_of_lane(self.free_times.least_lane())
    }

    fn node_pair_of_lane(&self, lane: usize) -> [NodeId; 2] {
        let child = self.first_child + lane as NodeId;
        match self.split.body {
            WhichBody::A => [child, self.split.other_node],
            WhichBody::B => [self.split.other_node, child],
        }
    }

    /// Marks the pairs with a free time up to the end as finished. A pair with a shorter one will be split and not
    /// visited again: most of its children stay apart. A pair without a free time is left as it is.
    pub(crate) fn finish_proven_pairs(
        &mut self,
        mut free_time: impl FnMut([NodeId; 2]) -> Option<FreeTime>,
    ) {
        let horizon = (1.0 - self.start_clock) as f32;
        for lane in 0..LANES {
            // The other pairs are already certified to the end.
            if self.free_times.time_of_lane(lane) < horizon {
                match free_time(self.node_pair_of_lane(lane)) {
                    Some(FreeTime::ToEnd) => self.free_times.finish_lane(lane),
                    Some(FreeTime::AtLeast(_)) => self.revisit_mask &= !(1 << lane),
                    None => {}
                }
            }
        }
    }

    /// Returns how many times the pair was advanced since it was removed from the pairs of its split; 0 before that.
    #[inline]
    pub(crate) fn advance_count(&self) -> usize {
        usize::from(self.advance_count)
    }

    /// Removes the pair with the least clock, and returns it as a group of one pair, whose clock is `clock`.
    pub(crate) fn remove_least_pair(&mut self, clock: f64) -> Self {
        Siblings {
            free_times: FreeTimes::single_in_lane(self.free_times.finish_least_lane()),
            start_clock: clock,
            advance_count: self.advance_count.saturating_add(1),
            ..*self
        }
    }

    /// Removes the pair with the least clock `s`, and returns its next step.
    // In the search's loop: a larger program, such as Python's module, would call it, and take 1 % more time.
    #[inline(always)]
    pub(crate) fn take_next_step(&mut self, problem: &Problem<'_>, s: f64) -> NextStep {
        let advanced = s > self.start_clock;
        let lane = self.free_times.finish_least_lane();
        let Split {
            body,
            node,
            other_node: other,
            ..
        } = self.split;
        let child = self.first_child + lane as NodeId;
        // A second visit at the same instant would give the same result.
        if advanced && self.revisit_mask >> lane & 1 == 1 {
            return NextStep::Split(Split {
                lane_mask: 1 << lane,
                ..Split::with_all_children(body, node, other)
            });
        }
        let split_child = self.split_child_mask >> lane & 1 == 1;
        if self.other_is_piece && !split_child {
            return step_to_measure_pieces(problem, self.node_pair_of_lane(lane));
        }
        // The choice has no branch, since none could be predicted.
        let (nodes, bodies) = ([other, child], [body.other(), body]);
        let k = usize::from(split_child);
        NextStep::Split(Split::with_all_children(bodies[k], nodes[k], nodes[1 - k]))
    }
}

/// Returns the step that measures two nodes of a single piece each.
fn step_to_measure_pieces(problem: &Problem<'_>, [a, b]: [NodeId; 2]) -> NextStep {
    let piece = |side: &BodyWithPath<'_>, node| side.body.tree().piece(node);
    match (piece(&problem.a, a), piece(&problem.b, b)) {
        (Some(a), Some(b)) => NextStep::MeasurePieces(a, b),
        _ => unreachable!("only single pieces are thin beside a single piece"),
    }
}
