//! The status of a row of results: contact, free, touching, overlapping and others, or error.

use ccd_core::{ClearanceVerdict, HitKind, Outcome, Question};
use serde::Deserialize;

/// The kind of a row's answer, or `error` for a row that is not a valid query.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// The bodies come into contact after the start.
    Contact,
    /// The bodies stay apart by more than the margin for the whole duration.
    Free,
    /// The bodies are at most margin + tolerance apart at the start, without overlapping.
    Touching,
    /// The bodies overlap at the start.
    Overlapping,
    /// The distance of the bodies is between the two bounds of the row.
    Measured,
    /// The distance is proven to be at least the clearance.
    Kept,
    /// The distance is proven to be less than the clearance.
    Violated,
    /// The bounds of the distance are too wide to compare it with the clearance.
    Unverified,
    /// A limit was reached before there was an answer.
    Unresolved,
    /// The row is not a valid query.
    #[default]
    Error,
}

impl Status {
    /// All statuses, in the order in which the summary of a run lists them.
    pub const ALL: [Status; 10] = [
        Status::Contact,
        Status::Free,
        Status::Touching,
        Status::Overlapping,
        Status::Measured,
        Status::Kept,
        Status::Violated,
        Status::Unverified,
        Status::Unresolved,
        Status::Error,
    ];

    /// Returns the text of the status in the table of results.
    pub fn name(self) -> &'static str {
        match self {
            Status::Contact => "contact",
            Status::Free => "free",
            Status::Touching => "touching",
            Status::Overlapping => "overlapping",
            Status::Measured => "measured",
            Status::Kept => "kept",
            Status::Violated => "violated",
            Status::Unverified => "unverified",
            Status::Unresolved => "unresolved",
            Status::Error => "error",
        }
    }

    /// Returns whether the status proves that the bodies keep the required distance.
    pub fn proves_distance_kept(self) -> bool {
        matches!(self, Status::Free | Status::Kept)
    }

    /// Returns the status of an outcome. Distances are compared to `clearance`, if there is one.
    pub fn of(question: Question, outcome: &Outcome, clearance: Option<f64>) -> Self {
        if let (true, Some(required)) = (question.is_for_a_distance(), clearance) {
            return match outcome.clearance_verdict(required) {
                ClearanceVerdict::Kept => Status::Kept,
                ClearanceVerdict::Violated => Status::Violated,
                ClearanceVerdict::Unverified => Status::Unverified,
            };
        }
        Status::from(outcome)
    }
}

impl From<&Outcome> for Status {
    fn from(outcome: &Outcome) -> Self {
        match outcome {
            Outcome::Contact { .. } => Status::Contact,
            Outcome::Free { .. } => Status::Free,
            Outcome::Touching { .. } => Status::Touching,
            Outcome::Overlapping { .. } => Status::Overlapping,
            Outcome::Interval { first, .. } => Status::from(&first.kind),
            Outcome::LeastDistance { .. } => Status::Measured,
            Outcome::Unresolved(_) => Status::Unresolved,
        }
    }
}

impl From<&HitKind> for Status {
    fn from(kind: &HitKind) -> Self {
        match kind {
            HitKind::Contact(_) => Status::Contact,
            HitKind::Touching(_) => Status::Touching,
            HitKind::Overlapping(_) => Status::Overlapping,
        }
    }
}
