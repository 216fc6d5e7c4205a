//! The table of contacts: all pairs of features in contact, written as CSV.

#[cfg(test)]
mod tests;

use crate::batch::{Bodies, Question};
use crate::table::courses::Course;
use ccd_core::{Answer, ContactsError, FeaturePair, InputError, Outcome, Separation, Settings};

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

/// One row, in the order of [`COLUMNS`]: id, time, features, bounds of the distance, then normal and witnesses. Numbers
/// read back to the same bits.
pub(crate) type ContactRow = (String, f64, [String; 2], [f64; 2], [[f64; 3]; 3]);

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
    let row = |pair: &FeaturePair| row(course.id(), course.earliest(time), pair);
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

/// Returns the row of a pair.
fn row(id: &str, time: f64, pair: &FeaturePair) -> ContactRow {
    let Separation {
        lower,
        upper,
        normal,
        witness_a,
        witness_b,
    } = pair.separation;
    (
        id.to_owned(),
        time,
        [pair.feature_a, pair.feature_b].map(|feature| feature.to_string()),
        [lower, upper],
        [normal, witness_a, witness_b].map(|vector| vector.to_array()),
    )
}
