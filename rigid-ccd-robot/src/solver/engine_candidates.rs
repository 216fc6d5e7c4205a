//! Candidate pairs of bodies that are left to the engine.

use super::Goal;
use super::part_pairs::PartPair;
use crate::path::interval::PathInterval;
use crate::path_point::PathPoint;
use ccd_core::order::{greater, lesser};

/// A candidate pair over an interval of one segment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EngineCandidate {
    pub(crate) pair: PartPair,
    /// The indices of both bodies.
    pub(crate) bodies: [usize; 2],
    pub(crate) segment: usize,
    pub(crate) from: f64,
    pub(crate) to: f64,
}

/// All candidates of a search that are left to the engine.
#[derive(Debug, Default)]
pub(crate) struct EngineCandidates(Vec<EngineCandidate>);

impl EngineCandidate {
    /// Creates a candidate at a single point of a path with this number of segments.
    pub(crate) fn new_at_point(
        pair: PartPair,
        bodies: [usize; 2],
        (at, segments): (f64, usize),
    ) -> Self {
        EngineCandidate {
            pair,
            bodies,
            segment: PathPoint::from_path_position(at, segments).segment,
            from: at,
            to: at,
        }
    }

    /// Returns the candidate over both halves of its interval.
    pub(crate) fn halves(&self) -> [Self; 2] {
        let middle = self.from + 0.5 * (self.to - self.from);
        [(self.from, middle), (middle, self.to)].map(|(from, to)| EngineCandidate {
            from,
            to,
            ..*self
        })
    }

    /// Converts a fraction of the interval to a point of the path, rounded down.
    pub(crate) fn point(&self, fraction: f64) -> f64 {
        let at = self.from + fraction * (self.to - self.from);
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

    /// Returns the earliest start of a candidate's interval; infinity if there are no candidates.
    pub(crate) fn earliest_start(&self) -> f64 {
        let starts = self.0.iter().map(|candidate| candidate.from);
        starts.fold(f64::INFINITY, lesser)
    }

    /// Adds a candidate. If the pair has an adjacent interval in the same segment, both are merged.
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

    /// Sorts the candidates in the order of querying: the earliest first for the first contact, otherwise the nearest
    /// first.
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
