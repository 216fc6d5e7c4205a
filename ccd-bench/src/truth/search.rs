//! Searches for the first contact of two surfaces by halving time. Time is halved, earliest first, and each half starts
//! from the pairs of nodes that could not be excluded over the whole.

use super::snapshot::{IntervalMaps, LinearizedMotions, TimeSpan};
use super::surface::{Node, NodeContent, Surface, Triangle};
use super::track::EnclosedMotion;
use super::triangle::{gap_along, nearest_points, separating_axis_candidates};
use super::{Truth, TruthSolver};
use ccd_core::order::{greater, lesser};
use ccd_tables::motions::Motions;
use std::rc::Rc;

/// A pair of nodes: an index in A's tree, and an index in B's tree.
pub(super) type NodePair = [u32; 2];

/// A search for the first contact in one query: the surfaces, their motions and the remaining budget.
pub(super) struct Search<'a> {
    surfaces: [&'a Surface; 2],
    pub(super) motions: [EnclosedMotion; 2],
    max_distances_from_origin: [f64; 2],
    duration: f64,
    /// The number of pairs of nodes that may still be tested.
    pub(super) remaining_budget: u64,
}

/// The number of tested pairs of nodes after which a query is left undecided. It would take minutes, while a hard query
/// takes a second.
const MAX_TESTED_PAIRS: u64 = 30_000_000;
/// The shortest interval of time that is halved, as a fraction of the duration: 2⁻⁴⁶, 1.4e-14.
const SHORTEST_SPAN_SHARE: f64 = 1.0 / (1_u64 << 46) as f64;
/// The largest number of times that the step is doubled in the search for a proven contact after an undecided time. The
/// last step is about a thousandth of the duration.
const MAX_STEP_DOUBLINGS: u32 = 36;
/// The number of doublings after which all triangles are tested, not only the pairs that were near at the undecided
/// time.
const DOUBLINGS_PER_FULL_TEST: u32 = 6;
/// The size of a node, as a multiple of the pair's relative displacement in the interval, up to which the node is not
/// split.
const MAX_UNSPLIT_SIZE_PER_TRAVEL: f64 = 1.0;
/// The size of triangles, as a fraction of their relative displacement, below which only their boxes are tested.
const MAX_BOX_TEST_SIZE_PER_TRAVEL: f64 = 0.25;

/// The number of face normals, which come first among the candidate separating axes of two triangles.
const FACE_NORMAL_COUNT: usize = 2;
/// The distance of two triangles, as a fraction of their edge lengths, below which cross products of edges are tested
/// too.
const MAX_RELATIVE_DISTANCE_FOR_EDGE_NORMALS: f64 = 1e-3;

impl<'a> Search<'a> {
    pub(super) fn new(referee: &TruthSolver<'a>, query: &Motions) -> Self {
        let surfaces = [referee.a, referee.b];
        Search {
            surfaces,
            motions: [
                EnclosedMotion::new(&query.a, referee.a),
                EnclosedMotion::new(&query.b, referee.b),
            ],
            max_distances_from_origin: surfaces.map(Surface::max_distance_from_origin),
            duration: query.duration,
            remaining_budget: MAX_TESTED_PAIRS,
        }
    }

    /// Returns the pair of both trees' roots; `None` if a body has no triangles.
    pub(super) fn root_pair(&self) -> Option<NodePair> {
        let [a, b] = self.surfaces;
        Some([a.root()?, b.root()?])
    }

    pub(super) fn run(mut self) -> Truth {
        let Some(roots) = self.root_pair() else {
            return Truth::Free;
        };
        if !(self.duration >= 0.0 && self.duration.is_finite()) {
            return Truth::Undecided { lo: 0.0 };
        }
        match self.decide_touch_at(roots, 0.0, TouchCriterion::UnlessProvenApart) {
            TouchDecision::NotTouching => self.bisect_time(roots),
            TouchDecision::Touching => Truth::ContactAtStart,
            TouchDecision::BudgetSpent => Truth::Undecided { lo: 0.0 },
        }
    }

    /// Brackets the first contact by halving intervals of time, the earlier half first.
    fn bisect_time(&mut self, roots: NodePair) -> Truth {
        let whole = TimeSpan {
            start: 0.0,
            end: self.duration,
        };
        let shortest = SHORTEST_SPAN_SHARE * self.duration;
        let mut pending = vec![(whole, Rc::new(vec![roots]))];
        let mut undecided = UndecidedTimes::default();
        while let Some((span, pairs)) = pending.pop() {
            let Some(span) = span.clipped_from(undecided.skipped_until) else {
                continue;
            };
            let snapshot = self.linearize_motions(span);
            let Some(left) = self.pairs_that_may_meet(&snapshot, &pairs) else {
                let lo = undecided.first_undecided_time.unwrap_or(span.start);
                return Truth::Undecided { lo };
            };
            if left.is_empty() {
                continue;
            }
            let middle = span.start.midpoint(span.end);
            if span.end - span.start > shortest && span.start < middle && middle < span.end {
                let left = Rc::new(left);
                let halves = [(span.start, middle), (middle, span.end)];
                let [early, late] = halves.map(|(start, end)| TimeSpan { start, end });
                pending.push((late, Rc::clone(&left)));
                pending.push((early, left));
                continue;
            }
            let lo = *undecided.first_undecided_time.get_or_insert(span.start);
            if let Some(hi) =
                self.find_contact_after(span.start, roots, &left, undecided.undecided_count)
            {
                return Truth::Hit { lo, hi };
            }
            undecided.skip_after(span, shortest);
        }
        match undecided.first_undecided_time {
            None => Truth::Free,
            Some(lo) => Truth::Graze { lo },
        }
    }

    pub(super) fn linearize_motions(&self, span: TimeSpan) -> LinearizedMotions {
        let [a, b] = &self.motions;
        LinearizedMotions::new([a, b], self.max_distances_from_origin, span)
    }

    /// Returns the pairs of nodes that may meet within the interval; nodes larger than their displacement are split
    /// first. `None` if the budget of tests was used up before all pairs were tested.
    fn pairs_that_may_meet(
        &mut self,
        snapshot: &LinearizedMotions,
        pairs: &[NodePair],
    ) -> Option<Vec<NodePair>> {
        let mut left = Vec::new();
        if snapshot.are_bodies_far_apart() {
            return Some(left);
        }
        let mut stack = pairs.to_vec();
        while let Some(pair) = stack.pop() {
            if self.remaining_budget == 0 {
                return None;
            }
            self.remaining_budget -= 1;
            let [a, b] = self.node_pair(pair);
            let Some(travel) = snapshot.travel_bound_unless_apart(a, b) else {
                continue;
            };
            let may_meet = match self.expand_larger_node(pair) {
                OpenedPair::Children(larger, pairs)
                    if larger.half_diagonal > MAX_UNSPLIT_SIZE_PER_TRAVEL * travel =>
                {
                    stack.extend(pairs);
                    false
                }
                OpenedPair::Children(..) => true,
                OpenedPair::Triangles(triangles) => {
                    let size = greater(a.half_diagonal, b.half_diagonal);
                    size < MAX_BOX_TEST_SIZE_PER_TRAVEL * travel
                        || !Self::are_triangles_apart(snapshot, triangles)
                }
            };
            if may_meet {
                left.push(pair);
            }
        }
        Some(left)
    }

    /// Returns true if the triangles of two leaves certainly stay apart within the interval.
    fn are_triangles_apart(snapshot: &LinearizedMotions, [a, b]: [&Triangle; 2]) -> bool {
        let [start, end] = snapshot.triangles_at_ends(a, b);
        let apart = |n| {
            let least = lesser(
                gap_along(n, &start[0], &start[1]),
                gap_along(n, &end[0], &end[1]),
            );
            // Also false for NaN: `min` drops it, so the direction itself is tested.
            n.is_finite() && least > snapshot.gap_error_bound
        };
        let placed = snapshot.triangle_of_a_at_middle(a);
        let mut normals = separating_axis_candidates(&placed, b);
        if normals.by_ref().take(FACE_NORMAL_COUNT).any(apart) {
            return true;
        }
        let (p, q) = nearest_points(&placed, b);
        let (between, size) = (p - q, (b[1] - b[0]).length() + (a[1] - a[0]).length());
        // The direction between two points is only useful if their distance is larger than rounding.
        apart(between.normalize())
            || (between.length() < MAX_RELATIVE_DISTANCE_FOR_EDGE_NORMALS * size
                && normals.any(apart))
    }

    /// Searches for a time soon after `from` at which the surfaces certainly share a point.
    fn find_contact_after(
        &mut self,
        from: f64,
        roots: NodePair,
        near: &[NodePair],
        times_met: u32,
    ) -> Option<f64> {
        let mut step = SHORTEST_SPAN_SHARE * self.duration;
        for doubling in 0..=MAX_STEP_DOUBLINGS {
            let time = lesser(from + step, self.duration);
            if self.certainly_meet_at(near, time) {
                return Some(time);
            }
            // All triangles are tested for the first undecided time, and then only periodically, because that
            // is slow.
            let wider = doubling % DOUBLINGS_PER_FULL_TEST == DOUBLINGS_PER_FULL_TEST - 1
                && (times_met == 0 || doubling == times_met);
            if wider
                && self.decide_touch_at(roots, time, TouchCriterion::Piercing)
                    == TouchDecision::Touching
            {
                return Some(time);
            }
            if time >= self.duration {
                break;
            }
            step *= 2.0;
        }
        None
    }

    fn certainly_meet_at(&mut self, pairs: &[NodePair], time: f64) -> bool {
        let [a, b] = &self.motions;
        let instant = IntervalMaps::new(a, b, time);
        self.remaining_budget = self.remaining_budget.saturating_sub(pairs.len() as u64);
        pairs
            .iter()
            .any(|&pair| match self.expand_larger_node(pair) {
                OpenedPair::Children(..) => false,
                OpenedPair::Triangles([a, b]) => instant.certainly_meet(a, b),
            })
    }

    /// Tests whether the surfaces touch at a time, by the evidence that `proof` requires.
    fn decide_touch_at(
        &mut self,
        roots: NodePair,
        time: f64,
        proof: TouchCriterion,
    ) -> TouchDecision {
        let snapshot = self.linearize_motions(TimeSpan::span_of_instant(time));
        let [a, b] = &self.motions;
        let instant = IntervalMaps::new(a, b, time);
        let mut stack = vec![roots];
        while let Some(pair) = stack.pop() {
            if self.remaining_budget == 0 {
                return TouchDecision::BudgetSpent;
            }
            self.remaining_budget -= 1;
            let [a, b] = self.node_pair(pair);
            if snapshot.travel_bound_unless_apart(a, b).is_none() {
                continue;
            }
            match self.expand_larger_node(pair) {
                OpenedPair::Children(_, pairs) => stack.extend(pairs),
                OpenedPair::Triangles([a, b]) => {
                    if !Self::are_triangles_apart(&snapshot, [a, b])
                        && (proof == TouchCriterion::UnlessProvenApart
                            || instant.certainly_meet(a, b))
                    {
                        return TouchDecision::Touching;
                    }
                }
            }
        }
        TouchDecision::NotTouching
    }

    pub(super) fn node_pair(&self, [a, b]: NodePair) -> [&'a Node; 2] {
        [self.surfaces[0].node(a), self.surfaces[1].node(b)]
    }

    /// Opens the larger of two nodes, or the only one that is no leaf.
    pub(super) fn expand_larger_node(&self, [a, b]: NodePair) -> OpenedPair<'a> {
        let [node_a, node_b] = self.node_pair([a, b]);
        let with_b = |parts: [u32; 2]| parts.map(|part| [part, b]);
        match (node_a.content, node_b.content) {
            (NodeContent::Children(parts), NodeContent::Children(_))
                if node_a.half_diagonal >= node_b.half_diagonal =>
            {
                OpenedPair::Children(node_a, with_b(parts))
            }
            (_, NodeContent::Children(parts)) => {
                OpenedPair::Children(node_b, parts.map(|part| [a, part]))
            }
            (NodeContent::Children(parts), NodeContent::Triangle(_)) => {
                OpenedPair::Children(node_a, with_b(parts))
            }
            (NodeContent::Triangle(a), NodeContent::Triangle(b)) => {
                OpenedPair::Triangles([self.surfaces[0].triangle(a), self.surfaces[1].triangle(b)])
            }
        }
    }
}

/// What is tested in place of a pair of nodes.
pub(super) enum OpenedPair<'a> {
    /// The node that is opened, and its children, each with the other node.
    Children(&'a Node, [NodePair; 2]),
    /// The triangles of two leaves.
    Triangles([&'a Triangle; 2]),
}

/// The evidence that makes two surfaces count as touching.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum TouchCriterion {
    /// Surfaces touch if they cannot be proven to be apart.
    UnlessProvenApart,
    /// Surfaces touch only if an edge certainly passes through a triangle.
    Piercing,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum TouchDecision {
    Touching,
    NotTouching,
    BudgetSpent,
}

/// The times at which neither a contact nor a gap between the surfaces could be proven.
#[derive(Debug, Default)]
struct UndecidedTimes {
    /// The first undecided time; `None` if there is no undecided time.
    first_undecided_time: Option<f64>,
    /// The time before which the search examines no further intervals.
    skipped_until: f64,
    /// The number of intervals so far in which neither a contact nor a gap was proven.
    undecided_count: u32,
}

impl UndecidedTimes {
    /// Skips some time after an undecided interval; the skipped time doubles with every undecided interval. Surfaces
    /// that slide on each other all the time are left after about as many steps as the duration has halvings.
    fn skip_after(&mut self, span: TimeSpan, shortest: f64) {
        let ahead = shortest * 2.0_f64.powi(self.undecided_count.min(1000) as i32);
        self.skipped_until = span.end + ahead;
        self.undecided_count = self.undecided_count.saturating_add(1);
    }
}

impl TimeSpan {
    /// Returns the part of the interval after `start`; `None` if it is empty.
    fn clipped_from(self, start: f64) -> Option<Self> {
        let start = greater(self.start, start);
        (start < self.end).then_some(TimeSpan { start, ..self })
    }
}
