//! Answers about the path of a robot. JavaScript reads their fields by name.

use super::answer::AnswerKind;
use super::limits::advice;
use rigid_ccd::glam::DVec3;
use rigid_ccd_robot as robot;
use robot::PathOutcome;
use wasm_bindgen::prelude::wasm_bindgen;

/// An answer about a path. Time is counted in segments: segment k is from k to k + 1.
#[wasm_bindgen(getter_with_clone)]
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
    /// The name of the limit that was reached, or `None`.
    pub limit: Option<String>,
    /// What the caller can do about the limit.
    pub advice: Option<String>,
    /// The pair that touches or is nearest, or `None`.
    pub nearest: Option<PathContact>,
}

/// The pair that touches or is nearest.
#[wasm_bindgen(getter_with_clone)]
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
    /// The name of the first item of the pair.
    pub a: String,
    /// The name of the second item of the pair.
    pub b: String,
    /// The point of the first item that is nearest to the second.
    pub witness_a: Vec<f64>,
    /// The point of the second item that is nearest to the first.
    pub witness_b: Vec<f64>,
    /// The feature of the first item's mesh at its witness point, or `None`.
    pub feature_a: Option<String>,
    /// The feature of the second item's mesh at its witness point, or `None`.
    pub feature_b: Option<String>,
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
            limit: outcome.limit().map(|limit| limit.to_string()),
            advice: outcome.limit().map(advice),
            nearest: outcome.nearest().map(PathContact::from),
        }
    }
}

impl From<robot::PathContact<'_>> for PathContact {
    fn from(contact: robot::PathContact<'_>) -> Self {
        let [lower, upper] = contact.distance_bounds;
        let [a, b] = contact.items.map(|item| item.name().to_owned());
        let witnesses = contact.witnesses.unwrap_or([DVec3::NAN; 2]);
        let [witness_a, witness_b] = witnesses.map(|witness| witness.to_array().to_vec());
        let features = contact.features;
        let [feature_a, feature_b] =
            features.map(|feature| feature.map(|feature| feature.to_string()));
        PathContact {
            segment: contact.at.segment,
            fraction: contact.at.fraction,
            time: contact.at.time(),
            lower,
            upper,
            a,
            b,
            witness_a,
            witness_b,
            feature_a,
            feature_b,
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
