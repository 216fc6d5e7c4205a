//! Pairs of bodies that are open in a stretch, for the engine.

use super::Goal;
use super::part_pairs::PartPair;
use crate::path::stretch::Stretch;
use ccd_core::order::{greater, lesser};

/// A pair that is open in a stretch of one segment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OpenPair {
    pub(crate) pair: PartPair,
    /// The numbers of both bodies.
    pub(crate) bodies: [usize; 2],
    pub(crate) segment: usize,
    pub(crate) from: f64,
    pub(crate) to: f64,
}

/// The open pairs of a search.
#[derive(Debug, Default)]
pub(crate) struct UndecidedPairs(Vec<OpenPair>);

impl OpenPair {
    /// Creates a pair that is undecided at one point of the path.
    pub(crate) fn new_at_point(pair: PartPair, bodies: [usize; 2], at: f64) -> Self {
        OpenPair {
            pair,
            bodies,
            segment: at as usize,
            from: at,
            to: at,
        }
    }

    /// Returns the pair in the parts before and after the middle of its stretch.
    pub(crate) fn halves(&self) -> [Self; 2] {
        let middle = self.from + 0.5 * (self.to - self.from);
        [(self.from, middle), (middle, self.to)].map(|(from, to)| OpenPair { from, to, ..*self })
    }

    /// Returns the point of the path after a share of the stretch, 0 at its start and 1 at its end, rounded towards the start.
    pub(crate) fn point(&self, share: f64) -> f64 {
        let at = self.from + share * (self.to - self.from);
        greater(at.next_down(), self.from)
    }
}

impl UndecidedPairs {
    pub(crate) fn reserve(&mut self, count: usize) {
        self.0.reserve(count);
    }

    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// Returns the start of the earliest stretch; infinite without open pairs.
    pub(crate) fn earliest_start(&self) -> f64 {
        let starts = self.0.iter().map(|open| open.from);
        starts.fold(f64::INFINITY, lesser)
    }

    /// Adds a pair of bodies in a stretch. Neighbouring stretches of the pair become one.
    pub(crate) fn add_or_merge(&mut self, pair: PartPair, bodies: [usize; 2], stretch: &Stretch) {
        let (from, to, segment) = (stretch.from, stretch.to, stretch.from as usize);
        let mut same = self.0.iter_mut().filter(|open| {
            open.bodies == bodies && open.segment == segment && open.from <= to && from <= open.to
        });
        match same.next() {
            Some(open) => {
                open.from = lesser(open.from, from);
                open.to = greater(open.to, to);
                open.pair.distance_to_proof_ratio = lesser(
                    open.pair.distance_to_proof_ratio,
                    pair.distance_to_proof_ratio,
                );
            }
            None => self.0.push(OpenPair {
                pair,
                bodies,
                segment,
                from,
                to,
            }),
        }
    }

    /// Returns the open pairs in the order in which the engine is asked: the earliest first for the first contact, the
    /// nearest first for other questions.
    pub(crate) fn sorted_for(&mut self, goal: Goal) -> &[OpenPair] {
        match goal {
            Goal::FirstContact => self.0.sort_unstable_by(|a, b| a.from.total_cmp(&b.from)),
            Goal::AnyContact | Goal::LeastDistance => self.0.sort_unstable_by(|a, b| {
                a.pair
                    .distance_to_proof_ratio
                    .total_cmp(&b.pair.distance_to_proof_ratio)
            }),
        }
        &self.0
    }
}
