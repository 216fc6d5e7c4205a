//! Answers about the path of a robot.

use super::answer::{AnswerKind, feature_numbers};
use super::limits::limit_number;
use rigid_ccd::Error;
use rigid_ccd::answer::Limit;
use rigid_ccd::glam::DVec3;
use rigid_ccd_robot::{ClosestApproach, PathContact, PathError, PathOutcome, PathPoint};
use wasm_bindgen::prelude::wasm_bindgen;

/// The index of the tolerance in the numbers of an answer.
const TOLERANCE: usize = 3;

/// An answer about a path: its kind, numbers at places that `js/module/cell.js` knows, and the names of a pair.
#[wasm_bindgen]
#[derive(Debug)]
pub struct PathAnswer {
    /// The kind of the answer.
    pub kind: AnswerKind,
    numbers: Vec<f64>,
    names: Vec<String>,
}

#[wasm_bindgen]
impl PathAnswer {
    /// Returns the numbers: two bounds of the distance and the number of the limit, or the segment, the share and the number of the
    /// limit; and the tolerance that is met. If a pair is named, the segment, the share, both witnesses, bounds of the distance and both features follow.
    pub fn numbers(&self) -> Vec<f64> {
        self.numbers.clone()
    }

    /// Returns the names of the pair, if there is one.
    pub fn names(&self) -> Vec<String> {
        self.names.clone()
    }
}

impl PathAnswer {
    /// Returns the answer with the tolerance that it meets.
    pub(crate) fn with_tolerance(mut self, tolerance: f64) -> Self {
        self.numbers[TOLERANCE] = tolerance;
        self
    }

    /// Makes an answer about a path of some segments.
    pub(crate) fn from_outcome(outcome: PathOutcome<'_>, segments: usize) -> Self {
        match outcome {
            PathOutcome::Free => {
                PathAnswer::without_pair(AnswerKind::Free, [segments as f64, 0.0, 0.0])
            }
            PathOutcome::Contact(contact) => {
                PathAnswer::without_pair(AnswerKind::Contact, [0.0; 3]).with_pair(&contact)
            }
            PathOutcome::Unresolved { free_until, limit } => {
                PathAnswer::from_limit(free_until, limit)
            }
        }
    }

    /// Makes an answer whether a path is free; a limit that was reached is one, too.
    pub(crate) fn from_any_contact(
        found: Result<Option<PathContact<'_>>, PathError>,
        segments: usize,
    ) -> Result<Self, PathError> {
        let outcome = |found| PathAnswer::from_outcome(found, segments);
        match found {
            Ok(Some(contact)) => Ok(outcome(PathOutcome::Contact(contact))),
            Ok(None) => Ok(outcome(PathOutcome::Free)),
            Err(PathError::Query(Error::Unresolved(known))) => {
                let start = PathPoint {
                    segment: 0,
                    share: 0.0,
                };
                Ok(PathAnswer::from_limit(start, known.limit))
            }
            Err(error) => Err(error),
        }
    }

    pub(crate) fn from_closest_approach(closest: &ClosestApproach<'_>) -> Self {
        let kind = match closest.limit {
            Some(_) => AnswerKind::Unresolved,
            None => AnswerKind::LeastDistance,
        };
        let limit = closest.limit.map_or(0, limit_number) as f64;
        let answer = PathAnswer::without_pair(kind, [closest.lower, closest.upper, limit]);
        match &closest.nearest {
            Some(nearest) => answer.with_pair(nearest),
            None => answer,
        }
    }

    fn from_limit(free_until: PathPoint, limit: Limit) -> Self {
        let PathPoint { segment, share } = free_until;
        let numbers = [segment as f64, share, limit_number(limit) as f64];
        PathAnswer::without_pair(AnswerKind::Unresolved, numbers)
    }

    fn without_pair(kind: AnswerKind, [first, second, limit]: [f64; TOLERANCE]) -> Self {
        PathAnswer {
            kind,
            numbers: vec![first, second, limit, f64::NAN],
            names: Vec::new(),
        }
    }

    fn with_pair(mut self, pair: &PathContact<'_>) -> Self {
        self.numbers.extend([pair.at.segment as f64, pair.at.share]);
        let witnesses = pair.witnesses.unwrap_or([DVec3::NAN; 2]);
        let witnesses = witnesses.iter().flat_map(|point| point.to_array());
        self.numbers.extend(witnesses);
        self.numbers.extend(pair.distance_bounds);
        for feature in pair.features {
            // No feature is one of a kind after all others.
            let numbers = feature.map_or([4.0, 0.0, 0.0], feature_numbers);
            self.numbers.extend(numbers);
        }
        self.names = pair.items.map(|item| item.name().to_owned()).to_vec();
        self
    }
}
