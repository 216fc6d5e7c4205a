//! What became of a row, in one word.

use crate::batch::Found;
use ccd_core::Outcome;
use ccd_core::schedule::{
    AnyContact, Clearance, ClosestApproach, ContactInterval, GreatestDistance, Touch,
};
use serde::{Deserialize, Serialize};

/// The kind of an answer, or an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// The bodies come into contact.
    Contact,
    /// The bodies stay apart.
    Free,
    /// The bodies touch at the start.
    Touching,
    /// The bodies overlap at the start.
    Overlapping,
    /// The distance is known.
    Measured,
    /// The distance is at least the clearance.
    Kept,
    /// The distance is less than the clearance.
    Violated,
    /// The distance is not known well enough to compare it to the clearance.
    Unverified,
    /// A limit was reached first.
    Unresolved,
    /// The row is not a valid query.
    Error,
}

impl Status {
    /// All statuses, in the order in which they are reported.
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

    /// Returns the name in the table.
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

    /// Returns whether it proves that the bodies stay as far apart as was asked.
    pub fn is_proof(self) -> bool {
        match self {
            Status::Free | Status::Kept => true,
            Status::Contact
            | Status::Touching
            | Status::Overlapping
            | Status::Measured
            | Status::Violated
            | Status::Unverified
            | Status::Unresolved
            | Status::Error => false,
        }
    }

    /// Returns the status of an answer; distances are compared to `clearance`, if there is one.
    pub fn of(found: &Found, clearance: Option<f64>) -> Self {
        match found {
            Found::First(outcome) => Status::from(outcome),
            Found::Any(any) => match any {
                AnyContact::Contact { .. } => Status::Contact,
                AnyContact::Free { .. } => Status::Free,
                AnyContact::Overlapping { .. } => Status::Overlapping,
                AnyContact::Unresolved { .. } => Status::Unresolved,
            },
            Found::Interval(interval) => match interval {
                ContactInterval::Within { first, .. } => Status::of_touch(first),
                ContactInterval::Free { .. } => Status::Free,
                ContactInterval::Unresolved { .. } => Status::Unresolved,
            },
            Found::Distance(closest) => Status::of_distance(closest, clearance),
            Found::Greatest(greatest) => match greatest {
                GreatestDistance::Farthest { .. } => Status::Measured,
                GreatestDistance::Unresolved { .. } => Status::Unresolved,
            },
        }
    }

    /// Returns what the first contact on its own is called.
    fn of_touch(first: &Touch) -> Self {
        match (first.overlap, first.time > 0.0) {
            (Some(_), _) => Status::Overlapping,
            (None, false) => Status::Touching,
            (None, true) => Status::Contact,
        }
    }

    fn of_distance(closest: &ClosestApproach, clearance: Option<f64>) -> Self {
        if let Some(required) = clearance {
            return match closest.clearance(required) {
                Clearance::Kept => Status::Kept,
                Clearance::Violated => Status::Violated,
                Clearance::Unverified => Status::Unverified,
            };
        }
        match closest {
            ClosestApproach::Nearest { .. } => Status::Measured,
            // Only where a distance was required.
            ClosestApproach::Farther { .. } => Status::Kept,
            ClosestApproach::Nearer { .. } => Status::Violated,
            ClosestApproach::Overlapping { .. } => Status::Overlapping,
            ClosestApproach::Unresolved { .. } => Status::Unresolved,
        }
    }
}

impl From<&Outcome> for Status {
    fn from(outcome: &Outcome) -> Self {
        match outcome {
            Outcome::Contact { .. } => Status::Contact,
            Outcome::Free { .. } => Status::Free,
            Outcome::Touching { .. } => Status::Touching,
            Outcome::Overlapping { .. } => Status::Overlapping,
            Outcome::Unresolved { .. } => Status::Unresolved,
        }
    }
}
