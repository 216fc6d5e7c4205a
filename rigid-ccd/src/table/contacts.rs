//! The table of contacts: all features in contact at the times of answers, CSV out.

#[cfg(test)]
mod tests;

use crate::batch::Bodies;
use crate::table::motions::Query;
use ccd_core::glam::DVec3;
use ccd_core::{
    Config, ContactsError, FeaturePair, InputError, Moving, Outcome, Problem, Separation,
};
use serde::Serialize;

/// The columns, in order.
pub const COLUMNS: [&str; 15] = [
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

/// One pair of features as the table holds it, in the order of [`COLUMNS`]; numbers read back to the same
/// bits.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ContactRow {
    /// As in the table of motions.
    pub id: String,
    /// The time of the answer.
    pub time: f64,
    /// The feature of A's mesh.
    pub feature_a: String,
    /// The feature of B's mesh.
    pub feature_b: String,
    /// A lower bound of the features' distance at `time`.
    pub distance_lower: f64,
    /// An upper bound of it.
    pub distance_upper: f64,
    /// From A to B, in the world's frame.
    pub normal: [f64; 3],
    /// The nearest point of A's feature, in the world's frame at `time`.
    pub witness_a: [f64; 3],
    /// The nearest point of B's feature.
    pub witness_b: [f64; 3],
}

/// Why an answer has no contacts to tell.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Untold {
    /// The query cannot be posed.
    #[error("{0}")]
    Input(#[from] InputError),
    /// They cannot be listed.
    #[error("{0}; --budget raises it, a smaller --tolerance needs less")]
    Contacts(#[from] ContactsError),
}

/// All contacts at the time of an answer, nearest first; none unless it ends in contact or touching.
///
/// # Errors
/// [`Untold`].
pub fn rows(
    bodies: Bodies<'_>,
    query: &Query,
    config: &Config,
    outcome: &Outcome,
) -> Result<Vec<ContactRow>, Untold> {
    let time = match *outcome {
        Outcome::Contact { time, .. } => time,
        Outcome::Touching { .. } => 0.0,
        Outcome::Free { .. } | Outcome::Overlapping { .. } | Outcome::Unresolved { .. } => {
            return Ok(Vec::new());
        }
    };
    let moving = |body, motion| Moving { body, motion };
    let (a, b) = (moving(bodies.a, query.a), moving(bodies.b, query.b));
    let pairs = Problem::new(a, b, query.duration, config)?.contacts_at(time)?;
    let row = |pair: &FeaturePair| ContactRow::new(&query.id, time, pair);
    Ok(pairs.iter().map(row).collect())
}

impl ContactRow {
    /// What the table says of a pair.
    pub fn new(id: &str, time: f64, pair: &FeaturePair) -> Self {
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
