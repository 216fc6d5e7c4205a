//! The table of contacts: all pairs of features in contact, written as CSV.

#[cfg(test)]
mod tests;

use crate::batch::{Bodies, Question};
use crate::table::courses::Course;
use ccd_core::glam::DVec3;
use ccd_core::{Answer, ContactsError, FeaturePair, InputError, Outcome, Separation, Settings};
use serde::Serialize;

/// The columns, in order.
pub(crate) const COLUMNS: [&str; 15] = [
    "id",
    "time",
    "feature_a",
    "feature_b",
    "distance_lower",
    "distance_upper",
    "normal_x",
    "normal_y",
    "normal_z",
    "witness_a_x",
    "witness_a_y",
    "witness_a_z",
    "witness_b_x",
    "witness_b_y",
    "witness_b_z",
];

/// One row: a pair of features, in the order of [`COLUMNS`]. Numbers read back to the same bits.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct ContactRow {
    /// The id in the table of motions.
    pub(crate) id: String,
    /// The time of the answer.
    pub(crate) time: f64,
    /// The feature of A.
    pub(crate) feature_a: String,
    /// The feature of B.
    pub(crate) feature_b: String,
    /// A lower bound of the distance of the features at `time`.
    pub(crate) distance_lower: f64,
    /// An upper bound of the same distance.
    pub(crate) distance_upper: f64,
    /// The unit vector from A to B, in the world frame.
    pub(crate) normal: [f64; 3],
    /// The nearest point of A's feature, in the world frame at `time`.
    pub(crate) witness_a: [f64; 3],
    /// The nearest point of B's feature.
    pub(crate) witness_b: [f64; 3],
}

/// The error of listing contacts.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub(crate) enum ListError {
    /// The query is not valid.
    #[error("{0}")]
    Input(#[from] InputError),
    /// The contacts cannot be listed.
    #[error("{0}; raise --budget, or reduce --tolerance")]
    Contacts(#[from] ContactsError),
}

/// Lists all contacts at the time of a contact or touching, nearest first; an empty list for other answers.
///
/// # Errors
/// The query is not valid, or the contacts cannot be listed.
pub(crate) fn rows(
    bodies: Bodies<'_>,
    course: &Course,
    settings: &Settings,
    (question, answer): (Question, &Answer),
) -> Result<Vec<ContactRow>, ListError> {
    let Some(time) = time_of_contact(question, &answer.outcome) else {
        return Ok(Vec::new());
    };
    let query = bodies.query(question, course, settings)?;
    let pairs = query.contacts_at(time)?;
    let row = |pair: &FeaturePair| ContactRow::new(course.id(), course.earliest(time), pair);
    Ok(pairs.iter().map(row).collect())
}

/// Returns the time of a contact or of touching, if the question is about a contact.
fn time_of_contact(question: Question, outcome: &Outcome) -> Option<f64> {
    match *outcome {
        Outcome::Contact { time, .. } if question.is_for_one_contact() => Some(time),
        Outcome::Touching { .. } => Some(0.0),
        _ => None,
    }
}

impl ContactRow {
    /// Creates the row of a pair.
    pub(crate) fn new(id: &str, time: f64, pair: &FeaturePair) -> Self {
        let Separation {
            lower,
            upper,
            normal,
            witness_a,
            witness_b,
        } = pair.separation;
        ContactRow {
            id: id.to_owned(),
            time,
            feature_a: pair.feature_a.to_string(),
            feature_b: pair.feature_b.to_string(),
            distance_lower: lower,
            distance_upper: upper,
            normal: DVec3::to_array(&normal),
            witness_a: DVec3::to_array(&witness_a),
            witness_b: DVec3::to_array(&witness_b),
        }
    }
}
