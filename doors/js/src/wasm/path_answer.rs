//! Answers about the path of a robot. JavaScript reads their fields by name.

use super::answer::AnswerKind;
use super::limits::{advice, name};
use rigid_ccd::answer::Limit;
use rigid_ccd::glam::DVec3;
use rigid_ccd_robot as robot;
use robot::PathOutcome;
use wasm_bindgen::prelude::wasm_bindgen;

/// An answer about a path. Time is counted in segments: segment k is from k to k + 1.
#[wasm_bindgen]
#[derive(Debug)]
pub struct PathAnswer {
    /// The kind of the answer.
    pub kind: AnswerKind,
    /// The time before which nothing touches.
    pub safe_until: f64,
    /// A lower bound of the distance.
    pub lower: f64,
    /// An upper bound of the distance.
    pub upper: f64,
    /// The tolerance that the answer meets.
    pub tolerance: f64,
    limit: Option<Limit>,
    nearest: Option<PathContact>,
}

/// The pair that touches or is nearest.
#[wasm_bindgen]
#[derive(Clone, Debug)]
pub struct PathContact {
    /// The index of the segment.
    pub segment: usize,
    /// The position within the segment, from 0 to 1.
    pub fraction: f64,
    /// The sum of segment and fraction.
    pub time: f64,
    /// A lower bound of the distance of the pair at that time.
    pub lower: f64,
    /// An upper bound of the same distance.
    pub upper: f64,
    names: [String; 2],
    witnesses: [DVec3; 2],
    features: [Option<String>; 2],
}

#[wasm_bindgen]
impl PathAnswer {
    /// Returns the name of the limit that was reached, or `None`.
    pub fn limit(&self) -> Option<String> {
        self.limit.map(name)
    }

    /// Returns advice about the limit.
    pub fn advice(&self) -> Option<String> {
        self.limit.map(advice)
    }

    /// Returns the pair that touches or is nearest, or `None`.
    pub fn nearest(&self) -> Option<PathContact> {
        self.nearest.clone()
    }
}

#[wasm_bindgen]
impl PathContact {
    /// Returns the name of the first item of the pair.
    pub fn a(&self) -> String {
        self.names[0].clone()
    }

    /// Returns the name of the second item of the pair.
    pub fn b(&self) -> String {
        self.names[1].clone()
    }

    /// Returns the point of the first item that is nearest to the second.
    pub fn witness_a(&self) -> Vec<f64> {
        self.witnesses[0].to_array().to_vec()
    }

    /// Returns the point of the second item that is nearest to the first.
    pub fn witness_b(&self) -> Vec<f64> {
        self.witnesses[1].to_array().to_vec()
    }

    /// Returns the feature of the first item's mesh at its witness point, or `None`.
    pub fn feature_a(&self) -> Option<String> {
        self.features[0].clone()
    }

    /// Returns the feature of the second item's mesh at its witness point, or `None`.
    pub fn feature_b(&self) -> Option<String> {
        self.features[1].clone()
    }
}

impl From<robot::PathAnswer<'_>> for PathAnswer {
    fn from(answer: robot::PathAnswer<'_>) -> Self {
        let outcome = &answer.outcome;
        PathAnswer {
            kind: kind(outcome),
            safe_until: answer.free_until.time(),
            lower: outcome.lower(),
            upper: outcome.upper(),
            tolerance: answer.tolerance,
            limit: outcome.limit(),
            nearest: outcome.nearest().map(PathContact::from),
        }
    }
}

impl From<robot::PathContact<'_>> for PathContact {
    fn from(contact: robot::PathContact<'_>) -> Self {
        let [lower, upper] = contact.distance_bounds;
        PathContact {
            segment: contact.at.segment,
            fraction: contact.at.fraction,
            time: contact.at.time(),
            lower,
            upper,
            names: contact.items.map(|item| item.name().to_owned()),
            witnesses: contact.witnesses.unwrap_or([DVec3::NAN; 2]),
            features: contact
                .features
                .map(|feature| feature.map(|feature| feature.to_string())),
        }
    }
}

fn kind(outcome: &PathOutcome<'_>) -> AnswerKind {
    match outcome {
        PathOutcome::Free => AnswerKind::Free,
        PathOutcome::Contact(_) => AnswerKind::Contact,
        PathOutcome::LeastDistance { .. } => AnswerKind::LeastDistance,
        PathOutcome::Unresolved(_) => AnswerKind::Unresolved,
    }
}
