//! Implements C2A, which advances both bodies by the shortest time that is safe for all pairs of swept-sphere nodes.

use super::patience::WorkLimit;
use super::swept_spheres::{GapBound, PairChildren, RssNodePair, RssTreePair, TriangleIndexPair};
use super::{Placement, RivalMotion};
use crate::method::solver::{ContactClaim, Reply, Solver};
use ccd_core::order::lesser;
use ccd_decomp::TriangleMesh;
use ccd_tables::motions::Motions;
use closing::ClosingSpeedBounder;

mod closing;
#[cfg(test)]
mod tests;

/// A solver by controlled conservative advancement \[C2A09\], with the trees of both bodies and reused memory.
///
/// Every step descends both trees as a distance query does. The step is the least (distance) /
/// (bound of the closing speed) over the pairs of nodes and triangles at which the descent stops.
/// It stops at pairs that are farther apart than the nearest triangles found, or that allow a step
/// of all the remaining time. In the first steps, far from contact, it also stops at pairs that are
/// nearly as far apart. The triangles that were nearest at the last step are measured first.
///
/// # Guarantee
/// No contact is missed or late. At a reported time the bodies are within the tolerance, a length.
///
/// # Choices
/// The authors' program skips the step of a pair of triangles farther apart than the nearest ones,
/// and stops at short steps as well as at short distances. Either may make a contact late or early.
/// Here no pair is skipped, and distance alone decides. Speeds of both bodies along a direction are
/// summed before they are bounded from below by zero. Pure translations are no special case.
#[derive(Clone, Debug)]
pub struct C2a {
    trees: RssTreePair,
    work_limit: WorkLimit,
    closing_speed_bounder: ClosingSpeedBounder,
    pair_stack: Vec<CandidatePair>,
}

/// A pair of nodes on the stack of a descent, with its distance and its safe step.
#[derive(Clone, Copy, Debug)]
struct CandidatePair {
    node_pair: RssNodePair,
    distance_bound: f64,
    /// A time from now during which the nodes do not touch.
    safe_step: f64,
}

/// The nearest triangles and the safe step that a descent of both trees has found so far.
#[derive(Clone, Copy, Debug)]
struct DescentResult {
    /// The distance of the nearest triangles.
    distance: f64,
    /// The nearest triangles; `None` before any are found.
    nearest_triangles: Option<(TriangleIndexPair, RssNodePair)>,
    /// The least of the safe steps of all pairs at which the descent has stopped so far.
    safe_step: f64,
}

/// The fixed inputs of a descent: the placement of the bodies and the limits.
struct DescentSetup<'a> {
    /// The placement of body B in the frame of body A at the current time.
    placement: &'a Placement,
    /// The time from now to the end of the motions.
    remaining_time: f64,
    /// The distance within which two triangles count as touching.
    tolerance: f64,
    /// The allowed relative excess of the distance that the descent finds over the true distance.
    max_relative_excess: f64,
}

/// How a descent of both trees ended.
enum DescentOutcome {
    /// The descent ended with the nearest triangles and a safe step.
    Done(DescentResult),
    /// The descent found triangles within the tolerance.
    WithinTolerance,
    /// The work limit was reached, or a computed distance was NaN.
    LimitReached,
}

impl C2a {
    /// Builds the trees of both meshes.
    pub fn new(a: &TriangleMesh, b: &TriangleMesh) -> Self {
        let trees = RssTreePair::new(a, b);
        C2a {
            closing_speed_bounder: ClosingSpeedBounder::new(&trees),
            trees,
            work_limit: WorkLimit::default(),
            pair_stack: Vec::new(),
        }
    }
}

impl Solver for C2a {
    fn answer(&mut self, query: &Motions, tolerance: f64) -> Reply {
        let (a, b) = (RivalMotion::new(&query.a), RivalMotion::new(&query.b));
        self.closing_speed_bounder.set_motions(&a, &b);
        let mut pairs_left = self.work_limit.max_pairs;
        let mut time = 0.0;
        let mut last = None;
        for steps in 1..=self.work_limit.max_steps {
            let frame = a.placement_at(time);
            let setup = DescentSetup {
                placement: &b.placement_at(time).relative_to(&frame),
                remaining_time: query.duration - time,
                max_relative_excess: max_relative_excess(
                    steps,
                    last.as_ref(),
                    query.duration,
                    tolerance,
                ),
                tolerance,
            };
            self.closing_speed_bounder.set_placement_a(&frame);
            let found = match self.descend(&setup, last.as_ref(), &mut pairs_left) {
                DescentOutcome::Done(found) => found,
                DescentOutcome::WithinTolerance => {
                    return Reply::new(ContactClaim::Contact { time }, steps);
                }
                DescentOutcome::LimitReached => {
                    return Reply::new(ContactClaim::Unresolved { safe_until: time }, steps);
                }
            };
            if found.safe_step >= setup.remaining_time {
                return Reply::new(ContactClaim::NoContact, steps);
            }
            let next = time + found.safe_step;
            // Stop at NaN, and at a step below the resolution of time.
            if !(next > time) {
                return Reply::new(ContactClaim::Unresolved { safe_until: time }, steps);
            }
            time = next;
            last = Some(found);
        }
        Reply::new(
            ContactClaim::Unresolved { safe_until: time },
            self.work_limit.max_steps,
        )
    }
}

impl C2a {
    /// Descends both trees once, nearest pairs first, to find the nearest triangles and a safe step.
    fn descend(
        &mut self,
        setup: &DescentSetup<'_>,
        last: Option<&DescentResult>,
        pairs_left: &mut u64,
    ) -> DescentOutcome {
        let mut found = DescentResult {
            distance: f64::INFINITY,
            nearest_triangles: None,
            safe_step: f64::INFINITY,
        };
        if let Some((leaves, pair)) = last.and_then(|last| last.nearest_triangles) {
            self.measure_triangle_pair(&mut found, setup, leaves, pair);
        }
        let Some(roots) = self.trees.root_pair(setup.placement) else {
            return DescentOutcome::Done(found);
        };
        self.pair_stack.clear();
        let roots = self.candidate_pair(roots);
        self.pair_stack.push(roots);
        loop {
            if found.distance <= setup.tolerance {
                return DescentOutcome::WithinTolerance;
            }
            let Some(candidate) = self.pair_stack.pop() else {
                return DescentOutcome::Done(found);
            };
            if candidate.try_stop_descent(&mut found, setup) {
                continue;
            }
            if *pairs_left == 0 || found.distance.is_nan() {
                return DescentOutcome::LimitReached;
            }
            *pairs_left -= 1;
            match self.trees.children(&candidate.node_pair) {
                PairChildren::Triangles(leaves) => {
                    self.measure_triangle_pair(&mut found, setup, leaves, candidate.node_pair);
                }
                PairChildren::Pairs([first, second]) => {
                    let (first, second) = (self.candidate_pair(first), self.candidate_pair(second));
                    let ordered = if first.distance_bound < second.distance_bound {
                        [second, first]
                    } else {
                        [first, second]
                    };
                    self.pair_stack.extend(ordered);
                }
            }
        }
    }

    #[inline]
    fn candidate_pair(&mut self, pair: RssNodePair) -> CandidatePair {
        let gap = self.trees.gap_bound(&pair);
        CandidatePair {
            safe_step: self
                .closing_speed_bounder
                .safe_step(&self.trees, &pair, &gap),
            node_pair: pair,
            distance_bound: gap.distance_bound,
        }
    }

    /// Measures the distance and the safe step of two triangles, and keeps each in `found` if it is the least so far.
    fn measure_triangle_pair(
        &mut self,
        found: &mut DescentResult,
        setup: &DescentSetup<'_>,
        leaves: TriangleIndexPair,
        pair: RssNodePair,
    ) {
        let between = self
            .trees
            .nearest_triangle_points(leaves, setup.placement)
            .vector_from_a_to_b();
        let distance = between.length();
        let gap = GapBound {
            distance_bound: distance,
            gap_direction: between / distance,
        };
        let step = self
            .closing_speed_bounder
            .safe_step(&self.trees, &pair, &gap);
        // NaN counts as nearer.
        if !(step >= found.safe_step) {
            found.safe_step = step;
        }
        if !(distance >= found.distance) {
            found.distance = distance;
            found.nearest_triangles = Some((leaves, pair));
        }
    }
}

impl CandidatePair {
    /// Returns true if the descent need not go below this pair; the step in `found` is then at most that of the pair.
    #[inline]
    fn try_stop_descent(&self, found: &mut DescentResult, setup: &DescentSetup<'_>) -> bool {
        if self.safe_step >= lesser(found.safe_step, setup.remaining_time) {
            return true;
        }
        let far = self.distance_bound * (1.0 + setup.max_relative_excess) >= found.distance;
        if far {
            found.safe_step = self.safe_step;
        }
        far
    }
}

/// Returns the allowed relative excess of the distance in a step: large in the first steps, and 0 near a contact.
fn max_relative_excess(
    step: u64,
    last: Option<&DescentResult>,
    duration: f64,
    tolerance: f64,
) -> f64 {
    /// The number of coarse steps at the start, and the excess that they are allowed.
    const COARSE_STEP_COUNT_AND_EXCESS: (u64, f64) = (3, 3.0);
    /// The number of the last finer step, after which all steps are exact, and the excess that the finer steps are
    /// allowed.
    const LAST_INEXACT_STEP_AND_EXCESS: (u64, f64) = (6, 0.5);
    /// After a step of at most this fraction of the duration, the next step computes the exact distance.
    const EXACT_BELOW_STEP_FRACTION: f64 = 0.005;
    /// After a distance of at most this many tolerances, the next step computes the exact distance.
    const EXACT_BELOW_DISTANCE_IN_TOLERANCES: f64 = 16.0;

    let exact = last.is_some_and(|last| {
        !(last.safe_step > EXACT_BELOW_STEP_FRACTION * duration
            && last.distance > EXACT_BELOW_DISTANCE_IN_TOLERANCES * tolerance)
    });
    match step {
        _ if exact => 0.0,
        _ if step <= COARSE_STEP_COUNT_AND_EXCESS.0 => COARSE_STEP_COUNT_AND_EXCESS.1,
        _ if step <= LAST_INEXACT_STEP_AND_EXCESS.0 => LAST_INEXACT_STEP_AND_EXCESS.1,
        _ => 0.0,
    }
}
