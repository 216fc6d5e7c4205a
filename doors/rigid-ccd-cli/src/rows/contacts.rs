//! The table of contacts: all pairs of features in contact, written as CSV.

#[cfg(test)]
mod tests;

use anyhow::{Result, anyhow};
use ccd_core::{Answer, Contact, Outcome, Settings};
use ccd_tables::batch::BodyPair;
use ccd_tables::movements::Movements;
use ccd_tables::results::{Column, ResultRow, reordered_columns};
use rigid_ccd::Question;

/// Returns the columns of the table of contacts, in order.
pub(crate) fn columns() -> Vec<Column> {
    reordered_columns(
        &["id", "time", "feature_a", "feature_b"],
        &["status", "iterations", "oracle_calls", "micros", "reason"],
    )
}

/// Lists all pairs of features in contact at the time of an answer's contact, nearest first; empty for other answers.
///
/// # Errors
/// The query is not valid, or the contacts cannot be listed.
pub(crate) fn contact_rows(
    bodies: BodyPair<'_>,
    movements: &Movements,
    settings: &Settings,
    (question, answer): (Question, &Answer),
) -> Result<Vec<ResultRow>> {
    let Some(time) = time_of_contact(question, &answer.outcome) else {
        return Ok(Vec::new());
    };
    let query = bodies.build_query(question, movements, settings)?;
    let pairs = query
        .contacts_at(time)
        .map_err(|error| anyhow!("{error}; raise --budget, or reduce --tolerance"))?;
    let row = |pair: &Contact| {
        ResultRow::from_feature_pair(
            movements.id(),
            movements.table_time_rounded_down(time),
            pair,
        )
    };
    Ok(pairs.iter().map(row).collect())
}

/// Returns the time of a contact or of touching, if the question is about a contact.
fn time_of_contact(question: Question, outcome: &Outcome) -> Option<f64> {
    match *outcome {
        Outcome::Contact { time, .. } if question.has_single_contact_time() => Some(time),
        Outcome::Touching { .. } => Some(0.0),
        _ => None,
    }
}
