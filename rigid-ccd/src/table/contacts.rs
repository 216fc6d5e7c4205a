//! The table of contacts: all pairs of features in contact, written as CSV.

#[cfg(test)]
mod tests;

use crate::batch::{Bodies, Found};
use crate::table::courses::Course;
use ccd_core::glam::DVec3;
use ccd_core::schedule::AnyContact;
use ccd_core::{
    Answer, Config, ContactsError, FeaturePair, InputError, Motion, Outcome, Problem, Separation,
};
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
    /// A lower bound of the features' distance at `time`.
    pub(crate) distance_lower: f64,
    /// An upper bound of that distance.
    pub(crate) distance_upper: f64,
    /// The unit vector from A to B, in the world frame.
    pub(crate) normal: [f64; 3],
    /// The nearest point of A's feature, in the world frame at `time`.
    pub(crate) witness_a: [f64; 3],
    /// The nearest point of B's feature.
    pub(crate) witness_b: [f64; 3],
}

/// An error of listing contacts.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub(crate) enum ListError {
    /// The query is not valid.
    #[error("{0}")]
    Input(#[from] InputError),
    /// The contacts cannot be listed.
    #[error("{0}; raise --budget, or reduce --tolerance")]
    Contacts(#[from] ContactsError),
}

/// Lists all contacts at the time of a contact or touching, nearest first; none for other answers.
///
/// # Errors
/// The query is not valid, or the contacts cannot be listed.
pub(crate) fn rows(
    bodies: Bodies<'_>,
    course: &Course,
    config: &Config,
    answer: &Answer<Found>,
) -> Result<Vec<ContactRow>, ListError> {
    let Some(time) = time_of_contact(&answer.outcome) else {
        return Ok(Vec::new());
    };
    let problem = |a: Motion, b: Motion, end| {
        let (a, b) = ((bodies.a, a), (bodies.b, b));
        Problem::new(a, b, end, config)
    };
    let pairs = match course {
        Course::Motions(query) => problem(query.a, query.b, query.duration)?.contacts_at(time)?,
        Course::Path(path) => {
            let [a, b] = path.poses(time)?.map(Motion::still);
            problem(a, b, 0.0)?.contacts_at(0.0)?
        }
    };
    let row = |pair: &FeaturePair| ContactRow::new(course.id(), course.earliest(time), pair);
    Ok(pairs.iter().map(row).collect())
}

/// Returns the time of a contact or touching.
fn time_of_contact(found: &Found) -> Option<f64> {
    match *found {
        Found::First(Outcome::Contact { time, .. })
        | Found::Any(AnyContact::Contact { time, .. }) => Some(time),
        Found::First(Outcome::Touching { .. }) => Some(0.0),
        Found::First(_)
        | Found::Any(_)
        | Found::Interval(_)
        | Found::Distance(_)
        | Found::Greatest(_) => None,
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
