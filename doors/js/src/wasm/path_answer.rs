//! Answers about the path of a robot. JavaScript reads their fields by name.

use super::answer::AnswerKind;
use super::limits::{advice, name};
use rigid_ccd::answer::Limit;
use rigid_ccd::glam::DVec3;
use rigid_ccd_robot as robot;
use robot::PathOutcome;
use wasm_bindgen::prelude::wasm_bindgen;

/// An answer about a path. Times count the segments of the path.
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
    /// The tolerance that is met.
    pub tolerance: f64,
    limit: Option<Limit>,
    nearest: Option<PathContact>,
}

/// The pair of an answer that touches or is nearest.
#[wasm_bindgen]
#[derive(Clone, Debug)]
pub struct PathContact {
    /// The number of the segment.
    pub segment: usize,
    /// The share of the segment that is passed.
    pub share: f64,
    /// The segment and the share together.
    pub time: f64,
    /// A lower bound of the distance of the pair there.
    pub lower: f64,
    /// An upper bound of it.
    pub upper: f64,
    names: [String; 2],
    witnesses: [DVec3; 2],
    features: [Option<String>; 2],
}

#[wasm_bindgen]
impl PathAnswer {
    /// Returns the name of the limit that was reached, if one was.
    pub fn limit(&self) -> Option<String> {
        self.limit.map(name)
    }

    /// Returns what can be done about the limit.
    pub fn advice(&self) -> Option<String> {
        self.limit.map(advice)
    }

    /// Returns the pair that touches or is nearest, if there is one.
    pub fn nearest(&self) -> Option<PathContact> {
        self.nearest.clone()
    }
}

#[wasm_bindgen]
impl PathContact {
    /// Returns the name of the first one of the pair.
    pub fn a(&self) -> String {
        self.names[0].clone()
    }

    /// Returns the name of the second one.
    pub fn b(&self) -> String {
        self.names[1].clone()
    }

    /// Returns the point of the first one that is nearest to the second.
    pub fn witness_a(&self) -> Vec<f64> {
        self.witnesses[0].to_array().to_vec()
    }

    /// Returns the point of the second one that is nearest to the first.
    pub fn witness_b(&self) -> Vec<f64> {
        self.witnesses[1].to_array().to_vec()
    }

    /// Returns the feature of the first one's mesh at its point, if it has one.
    pub fn feature_a(&self) -> Option<String> {
        self.features[0].clone()
    }

    /// Returns the feature of the second one's mesh at its point, if it has one.
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
            share: contact.at.share,
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
