//! Computes the distance of two bodies at one clock, by a search that examines the nearest pairs first.

use super::meter::Meter;
use super::nodes::common::NodeContext;
use super::nodes::expand::bound_child_distances;
use super::nodes::siblings::{NextStep, Siblings};
use super::pieces::placed_pair::PlacedPair;
use super::queue::{QueueFull, Rank, Worklist};
use super::search_buffers::SearchBuffers;
use crate::answer::{Contact, Limit};
use crate::distance::oracle::DistanceOracle;
use crate::distance::overlap::{self, Intersection};
use crate::math::order::{greater, lesser};
use crate::problem::Problem;
use crate::rounding::SKIPPED_PAIR_ALLOWANCE;
use std::ops::ControlFlow;

/// A search for the two nearest pieces of two bodies at one clock. It splits the pair of nodes with the least lower
/// bound, until no waiting pair can contain pieces that are nearer than those found.
///
/// Pairs that may intersect have no lower bound of their distance, and therefore come first.
pub(crate) struct NearestSearch<'p> {
    problem: &'p Problem<'p>,
    node_context: NodeContext<'p>,
    clock: f64,
    buffers: &'p mut SearchBuffers,
    /// The distance at and beyond which pairs are ignored.
    cutoff: f64,
    /// The two pieces with the least upper bound, by their indices in the problem, and their contact.
    nearest_pair: Option<([u32; 2], Contact)>,
    /// A lower bound of the distances of the measured pieces, and once the search has ended, of the waiting pairs.
    lower: f64,
    /// True if it could not be decided for some pair of pieces whether they intersect.
    pub(crate) is_intersection_undecided: bool,
}

/// The reason why a search ended before it found the distance.
#[derive(Clone, Copy, Debug)]
pub(crate) enum EarlyEndReason {
    /// Two pieces that intersect, by their indices, and their contact.
    Overlap([u32; 2], Contact),
    /// The search was ended by a limit, such as the budget, or by an oracle that gave up.
    Limit(Limit),
}

impl<'p> NearestSearch<'p> {
    /// Creates the search for the nearest pieces of both bodies, in their poses at the time `clock`.
    pub(crate) fn new(problem: &'p Problem<'p>, clock: f64, lists: &'p mut SearchBuffers) -> Self {
        NearestSearch {
            problem,
            node_context: NodeContext::new(problem),
            clock,
            buffers: lists,
            cutoff: f64::INFINITY,
            nearest_pair: None,
            lower: f64::INFINITY,
            is_intersection_undecided: false,
        }
    }

    /// Limits the search to pieces that are nearer than `beyond` to each other.
    pub(crate) fn with_cutoff(self, beyond: f64) -> Self {
        NearestSearch {
            cutoff: beyond,
            ..self
        }
    }

    /// Searches for the nearest pieces until they are found, an overlap is found, or a limit ends the search.
    ///
    /// # Complexity
    /// One distance of the bodies, and one visit for every pair of pieces that may intersect.
    pub(crate) fn search<O: DistanceOracle>(
        &mut self,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> Option<EarlyEndReason> {
        self.run(oracle, meter).break_value()
    }

    fn run<O: DistanceOracle>(
        &mut self,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> ControlFlow<EarlyEndReason> {
        let mut next = Some((0.0, NextStep::roots(self.problem)));
        while let Some((distance, pair)) = next {
            if let Err(limit) = meter.count_visit_and_check_limits(self.problem) {
                return ControlFlow::Break(EarlyEndReason::Limit(limit));
            }
            match pair {
                NextStep::Split(split) => {
                    let children = bound_child_distances(&self.node_context, &split, self.clock);
                    self.enqueue(distance, children)?;
                }
                NextStep::MeasurePieces(a, b) => self.measure_pieces([a, b], oracle, meter)?,
            }
            next = self.next_pair();
        }
        ControlFlow::Continue(())
    }

    /// Adds the children of a pair with the lower bound `distance`, which is one of theirs too.
    fn enqueue(&mut self, distance: f64, siblings: Siblings) -> ControlFlow<EarlyEndReason> {
        let distance = greater(distance, siblings.clock());
        if !(distance < self.upper_bound()) {
            return ControlFlow::Continue(());
        }
        match self
            .buffers
            .waiting_pairs
            .push(distance, Rank::Siblings, siblings)
        {
            Ok(()) => ControlFlow::Continue(()),
            Err(QueueFull) => ControlFlow::Break(EarlyEndReason::Limit(Limit::Budget)),
        }
    }

    /// Returns the waiting pair with the least lower bound, and that bound; `None` if no pair can be nearer than the one
    /// found.
    fn next_pair(&mut self) -> Option<(f64, NextStep)> {
        let (upper, search_radius) = (self.upper_bound(), self.search_radius());
        let (distance, siblings) = self.buffers.waiting_pairs.peek_next()?;
        // Pairs without a distance may intersect.
        if distance > 0.0 && distance >= search_radius {
            self.lower = lesser(self.lower, distance);
            return None;
        }
        let next = siblings.take_next_step(self.problem, distance);
        match greater(distance, siblings.clock()) {
            rest if rest < upper => self.buffers.waiting_pairs.postpone(rest),
            _ => self.buffers.waiting_pairs.remove_next(),
        }
        Some((distance, next))
    }

    /// Measures two pieces by the oracle, and then updates the bounds of the search, or ends the search. The search
    /// ends if the pieces certainly intersect, or if the oracle gives up.
    fn measure_pieces<O: DistanceOracle>(
        &mut self,
        ids: [u32; 2],
        oracle: &mut O,
        meter: &mut Meter,
    ) -> ControlFlow<EarlyEndReason> {
        let problem = self.problem;
        let placed = PlacedPair::new(problem, ids, self.clock);
        let Some(checked) = placed.query_oracle(oracle, &mut O::Cache::default(), meter) else {
            return ControlFlow::Break(EarlyEndReason::Limit(Limit::OracleGaveUp));
        };
        let inner = &mut meter.scratch_memory().expanding_polytope;
        match overlap::decide_intersection(&placed.pieces, &checked, problem.rounding, inner) {
            Intersection::Certain => {
                return ControlFlow::Break(EarlyEndReason::Overlap(
                    ids,
                    placed.contact(ids, &checked),
                ));
            }
            Intersection::Undecided => self.is_intersection_undecided = true,
            Intersection::None => {}
        }
        // Written so that NaN is not apart.
        if !(checked.lower > 0.0) {
            self.buffers.unseparated_pairs.push(ids);
        }
        self.lower = lesser(self.lower, checked.lower);
        if checked.upper < self.upper_bound() {
            self.nearest_pair = Some((ids, placed.contact(ids, &checked)));
        }
        ControlFlow::Continue(())
    }

    /// Returns the least upper bound of the distance found so far, or the cutoff if no pieces nearer than the cutoff
    /// were found.
    fn upper_bound(&self) -> f64 {
        let upper = |(_, contact): ([u32; 2], Contact)| contact.separation.upper;
        self.nearest_pair.map_or(self.cutoff, upper)
    }

    /// Returns the distance at and beyond which pairs need not be examined.
    fn search_radius(&self) -> f64 {
        let upper = self.upper_bound();
        if upper <= self.problem.contact_distance() {
            upper * (1.0 - SKIPPED_PAIR_ALLOWANCE)
        } else {
            upper
        }
    }

    /// Returns the contact of the nearest pieces, with a lower bound for all pieces; `None` if no pieces are nearer
    /// than the cutoff.
    pub(crate) fn nearest_contact(&self) -> Option<Contact> {
        self.nearest_pieces().map(|(_, contact)| contact)
    }

    /// Like [`NearestSearch::nearest_contact`], with the indices of the pieces in the problem.
    pub(crate) fn nearest_pieces(&self) -> Option<([u32; 2], Contact)> {
        self.nearest_pair
            .map(|(pieces, contact)| (pieces, contact.cap_lower_bound(self.lower)))
    }

    /// Returns the nearest pieces if they are in contact, or else the contact `seen`, with a lower bound for all
    /// pieces. The latter is returned if a later claim of an oracle contradicts an earlier one.
    pub(crate) fn contact(&self, seen: Contact) -> Contact {
        let within = self.problem.contact_distance();
        let nearest = self
            .nearest_contact()
            .filter(|nearest| nearest.separation.upper <= within);
        nearest.unwrap_or(seen.cap_lower_bound(self.lower))
    }
}
