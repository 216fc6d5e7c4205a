//! Pairs of bodies that are candidate in an interval, for the engine.

use super::Goal;
use super::part_pairs::PartPair;
use crate::path::interval::PathInterval;
use ccd_core::order::{greater, lesser};

/// A pair that is candidate in an interval of one segment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EngineCandidate {
    pub(crate) pair: PartPair,
    /// The numbers of both bodies.
    pub(crate) bodies: [usize; 2],
    pub(crate) segment: usize,
    pub(crate) from: f64,
    pub(crate) to: f64,
}

/// The candidate pairs of a search.
#[derive(Debug, Default)]
pub(crate) struct EngineCandidates(Vec<EngineCandidate>);

impl EngineCandidate {
    /// Creates a pair that is undecided at one point of the path.
    pub(crate) fn new_at_point(pair: PartPair, bodies: [usize; 2], at: f64) -> Self {
        EngineCandidate {
            pair,
            bodies,
            segment: at as usize,
            from: at,
            to: at,
        }
    }

    /// Returns the pair in the parts before and after the middle of its interval.
    pub(crate) fn halves(&self) -> [Self; 2] {
        let middle = self.from + 0.5 * (self.to - self.from);
        [(self.from, middle), (middle, self.to)].map(|(from, to)| EngineCandidate {
            from,
            to,
            ..*self
        })
    }

    /// Returns the point of the path after a share of the interval, 0 at its start and 1 at its end, rounded towards the start.
    pub(crate) fn point(&self, share: f64) -> f64 {
        let at = self.from + share * (self.to - self.from);
        greater(at.next_down(), self.from)
    }
}

impl EngineCandidates {
    pub(crate) fn reserve(&mut self, count: usize) {
        self.0.reserve(count);
    }

    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// Returns the start of the earliest interval; infinite without candidate pairs.
    pub(crate) fn earliest_start(&self) -> f64 {
        let starts = self.0.iter().map(|candidate| candidate.from);
        starts.fold(f64::INFINITY, lesser)
    }

    /// Adds a pair of bodies in an interval. Neighbouring intervals of the pair become one.
    pub(crate) fn add_or_merge(
        &mut self,
        pair: PartPair,
        bodies: [usize; 2],
        interval: &PathInterval,
    ) {
        let (from, to, segment) = (interval.from, interval.to, interval.from as usize);
        let mut same = self.0.iter_mut().filter(|candidate| {
            candidate.bodies == bodies
                && candidate.segment == segment
                && candidate.from <= to
                && from <= candidate.to
        });
        match same.next() {
            Some(candidate) => {
                candidate.from = lesser(candidate.from, from);
                candidate.to = greater(candidate.to, to);
                candidate.pair.distance_to_proof_ratio = lesser(
                    candidate.pair.distance_to_proof_ratio,
                    pair.distance_to_proof_ratio,
                );
            }
            None => self.0.push(EngineCandidate {
                pair,
                bodies,
                segment,
                from,
                to,
            }),
        }
    }

    /// Returns the candidate pairs in the order in which the engine is asked: the earliest first for the first contact, the
    /// nearest first for other questions.
    pub(crate) fn sorted_for(&mut self, goal: Goal) -> &[EngineCandidate] {
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
