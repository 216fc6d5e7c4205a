//! Computes the distance of two bodies at one time, descending from where the last descent ended. This is Algorithm 3
//! of the paper `[FAST06]`.

use super::hull_pair::{FeaturesOnBridges, HullTreePair};
use super::reach::AxisDistanceCache;
use super::traversal_tree::{Node, TraversalPair, TraversalTree};
use crate::answer::{Contact, Outcome};
use crate::distance::oracle::DistanceOracle;
use crate::engine::meter::Meter;
use crate::engine::pieces::contact_rule::PairStep;
use crate::engine::pieces::placed_pair::PlacedPair;
use crate::engine::proven::ProvenFacts;
use crate::math::order::lesser;
use crate::motion::bound::VelocityBound;
use crate::problem::Problem;
use crate::settings::StartPolicy;
use crate::tuning::{JOIN_DISTANCE_RATIO, MIN_OVERLAP_TO_SPLIT};
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::ops::ControlFlow;

/// A search for the nearest pairs of nodes at one clock, which starts from the front of the last descent.
pub(super) struct Descent<'s, 'p, O: DistanceOracle> {
    pub(super) problem: &'p Problem<'p>,
    pub(super) hulls: HullTreePair<'p>,
    pub(super) velocity_bound: VelocityBound,
    pub(super) traversal_tree: &'s mut TraversalTree<O::Cache>,
    pub(super) axis_distance_cache: &'s mut AxisDistanceCache,
    pub(super) proven_facts: &'s ProvenFacts,
    pub(super) oracle: &'s mut O,
    pub(super) meter: &'s mut Meter,
}

/// The results at a clock so far, and the pairs that may improve them.
struct DescentState {
    /// An upper bound of the distance of the two bodies.
    distance_bound: f64,
    /// The nearest pair of pieces in contact.
    contact: Option<Contact>,
    /// The pairs that may have to be split, as a heap with the nearest first.
    open_pairs: BinaryHeap<OpenPair>,
}

/// A pair of the front that may have to be split, with a lower bound of its distance.
struct OpenPair {
    lower: f64,
    traversal_node: u32,
}

impl<'p, O: DistanceOracle> Descent<'_, 'p, O> {
    /// Updates the front at clock `s`, and returns the time until which all its pairs stay apart. Pairs that may have
    /// the least distance are split, and pairs that no longer may are joined. Pairs that stay apart to the end are
    /// skipped.
    pub(super) fn step(&mut self, s: f64) -> ControlFlow<Outcome, f64> {
        let placed = PlacedPair::from_pieces(self.problem, self.hulls.hulls([0, 0]), s);
        let mut found = DescentState {
            distance_bound: f64::INFINITY,
            contact: None,
            open_pairs: BinaryHeap::new(),
        };
        for at in self.traversal_tree.leaf_indices() {
            if self.traversal_tree.node(at).stays_apart() {
                continue;
            }
            self.measure_pair(&placed, at, &mut found)?;
        }
        while let Some(OpenPair {
            lower,
            traversal_node: at,
        }) = found.open_pairs.pop()
        {
            // Written so that a pair with NaN is split.
            if lower >= found.distance_bound {
                break;
            }
            let Some(first) = self.traversal_tree.split(self.hulls, at) else {
                continue;
            };
            self.measure_pair(&placed, first, &mut found)?;
            self.measure_pair(&placed, first + 1, &mut found)?;
        }
        if let Some(contact) = found.contact {
            return ControlFlow::Break(self.proven_facts.contact_outcome(self.problem, contact, s));
        }
        let next = self.traversal_tree.least_clock();
        self.merge_far_pairs(&placed, &mut found, next)?;
        ControlFlow::Continue(next)
    }

    /// Measures a pair in the front, and updates its clock and the results of the descent.
    fn measure_pair(
        &mut self,
        placed: &PlacedPair<'p>,
        at: u32,
        found: &mut DescentState,
    ) -> ControlFlow<Outcome> {
        if let Err(reason) = self.meter.count_visit_and_check_limits(self.problem) {
            return ControlFlow::Break(Outcome::unresolved(
                self.problem.time_of_clock(placed.clock),
                reason,
            ));
        }
        match self.traversal_tree.node(at).traversal_pair {
            TraversalPair::Nodes(_) => {
                self.measure_nodes(placed, at, found);
                ControlFlow::Continue(())
            }
            TraversalPair::Pieces(_) => self.measure_pieces(placed, at, found),
        }
    }

    fn measure_nodes(&mut self, placed: &PlacedPair<'p>, at: u32, found: &mut DescentState) {
        let (problem, s) = (self.problem, placed.clock);
        let node = self.traversal_tree.node(at);
        let TraversalPair::Nodes(cache) = &mut node.traversal_pair else {
            return;
        };
        let placed = placed.with_pieces(self.hulls.hulls(node.pair));
        let depth = placed.relative_overlap_along_center_line();
        // The search for a common point takes longer than the search for a distance, and its result is of no use
        // here.
        if depth.is_some_and(|depth| depth > MIN_OVERLAP_TO_SPLIT) {
            self.meter.stats.point_evaluations += placed.pieces.points_per_support_search();
            found.open_pairs.push(node.reset_unmeasured_pair(at, s));
            return;
        }
        let Some(checked) = placed.query_oracle(self.oracle, cache, self.meter) else {
            // Smaller hulls may be easier.
            found.open_pairs.push(node.reset_unmeasured_pair(at, s));
            return;
        };
        let reaches = self
            .axis_distance_cache
            .max_axis_distances(problem, node.pair, &placed);
        let free =
            placed.free_time_along_axis(&checked, problem.kept_gap(), self.velocity_bound, reaches);
        node.distance_lower_bound = checked.lower;
        node.features_on_bridges = self.hulls.features_on_bridges(node.pair, &checked.claim);
        node.certified_until = free.clock_after(s);
        let contact = problem.contact_distance();
        // Contacts at the start are found at the start, or never.
        let reach = if s > 0.0 { problem.kept_gap() } else { contact };
        let apart = checked.lower > reach && node.certified_until > s;
        // The distance bound is that of the pieces below the nodes, which are not in contact.
        let settled =
            node.features_on_bridges == FeaturesOnBridges::BothPieces && checked.upper > contact;
        if settled && apart {
            found.distance_bound = lesser(found.distance_bound, checked.upper);
        }
        // If a pair stays apart, all pairs below it do, whatever their distance.
        let done = apart && (settled || node.stays_apart());
        if !(done || checked.lower >= found.distance_bound) {
            let lower = checked.lower;
            found.open_pairs.push(OpenPair {
                lower,
                traversal_node: at,
            });
        }
    }

    fn measure_pieces(
        &mut self,
        placed: &PlacedPair<'p>,
        at: u32,
        found: &mut DescentState,
    ) -> ControlFlow<Outcome> {
        let (problem, bound, s) = (self.problem, self.velocity_bound, placed.clock);
        let node = self.traversal_tree.node(at);
        let TraversalPair::Pieces(pair) = &mut node.traversal_pair else {
            return ControlFlow::Continue(());
        };
        let placed = placed.with_pieces(problem.pieces([pair.a, pair.b]));
        let reaches = self
            .axis_distance_cache
            .max_axis_distances(problem, node.pair, &placed);
        // Pairs that rest on each other do not count for the distance of the bodies.
        node.distance_lower_bound = f64::NEG_INFINITY;
        let step = pair.advance_with_free_time(
            &placed,
            self.oracle,
            self.meter,
            |placed, checked, kept| {
                node.distance_lower_bound = checked.lower;
                found.distance_bound = lesser(found.distance_bound, checked.upper);
                placed.free_time_along_axis(checked, kept, bound, reaches)
            },
        );
        if let PairStep::Contact(contact) = step
            && s > 0.0
        {
            found.record_contact(contact);
            return ControlFlow::Continue(());
        }
        let free =
            self.proven_facts
                .free_time_or_outcome(problem, self.oracle, self.meter, step, s)?;
        node.certified_until = free.clock_after(s);
        ControlFlow::Continue(())
    }

    /// Replaces far pairs of the front by the pair that covers them, if that makes neither the distance nor the step
    /// smaller. The pair that covers both must be as far apart as the bodies, and apart until the next clock.
    fn merge_far_pairs(
        &mut self,
        placed: &PlacedPair<'p>,
        found: &mut DescentState,
        next: f64,
    ) -> ControlFlow<Outcome> {
        // Pairs that were let go at the start must not be forgotten.
        if self.problem.start_policy == StartPolicy::Leave {
            return ControlFlow::Continue(());
        }
        let distance = found.distance_bound;
        for (at, first) in self.traversal_tree.joinable_pairs() {
            let far = [first, first + 1].into_iter().all(|child| {
                self.traversal_tree.node(child).distance_lower_bound
                    >= JOIN_DISTANCE_RATIO * distance
            });
            if !far || self.traversal_tree.node(at).max_join_distance <= distance {
                continue;
            }
            self.measure_pair(placed, at, found)?;
            let node = self.traversal_tree.node(at);
            if node.distance_lower_bound >= distance && node.certified_until >= next {
                self.traversal_tree.remove_child_leaves(at);
            } else {
                node.max_join_distance = distance / JOIN_DISTANCE_RATIO;
            }
        }
        ControlFlow::Continue(())
    }
}

impl<C> Node<C> {
    /// Resets an unmeasured pair so that it is split whatever its distance, and returns its entry for the heap.
    fn reset_unmeasured_pair(&mut self, at: u32, s: f64) -> OpenPair {
        (
            self.distance_lower_bound,
            self.features_on_bridges,
            self.certified_until,
        ) = (f64::NEG_INFINITY, FeaturesOnBridges::BothBridges, s);
        let lower = self.distance_lower_bound;
        OpenPair {
            lower,
            traversal_node: at,
        }
    }
}

impl DescentState {
    fn record_contact(&mut self, contact: Contact) {
        let separation = &contact.separation;
        self.distance_bound = lesser(self.distance_bound, separation.upper);
        let nearest = self.contact.get_or_insert(contact);
        if separation.lower < nearest.separation.lower {
            *nearest = contact;
        }
    }
}

/// The order of the heap: the pair with the least lower bound is the greatest; among equal bounds, the one with the
/// least index.
impl Ord for OpenPair {
    fn cmp(&self, other: &Self) -> Ordering {
        let nearer = other.lower.total_cmp(&self.lower);
        nearer.then(other.traversal_node.cmp(&self.traversal_node))
    }
}

impl PartialOrd for OpenPair {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for OpenPair {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for OpenPair {}
