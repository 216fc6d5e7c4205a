//! Whether two methods answer alike.

#[cfg(test)]
mod tests;

use crate::motions::Query;
use crate::query::Timed;
use ccd_core::glam::DVec3;
use ccd_core::{Answer, Contact, Motion, Outcome};

/// How many answers of one method contradict those of another to the same queries.
pub fn disagreements(queries: &[Query], ones: &[Timed], others: &[Timed]) -> usize {
    let pairs = ones.iter().zip(others);
    queries
        .iter()
        .zip(pairs)
        .filter(|(query, (one, other))| !agree(query, &one.answer, &other.answer))
        .count()
}

/// Whether two answers can both be right.
///
/// Each method may report a contact as soon as the distance is within its tolerance, and has to
/// before it is 0. So two times may differ by what it takes to cross the tolerance, and bodies that
/// pass within it may be told in contact or free.
fn agree(query: &Query, one: &Answer, other: &Answer) -> bool {
    let tolerance = one.tolerance.max(other.tolerance);
    match (hit(&one.outcome), hit(&other.outcome)) {
        (Some(one), Some(other)) => {
            let apart = (one.time - other.time).abs();
            // Written so that NaN disagrees.
            apart
                <= crossing_time(query, &one, tolerance)
                    .max(crossing_time(query, &other, tolerance))
        }
        (Some(_), None) => grazes(&other.outcome, tolerance),
        (None, Some(_)) => grazes(&one.outcome, tolerance),
        (None, None) => same_kind(&one.outcome, &other.outcome),
    }
}

/// A contact, at the start or later.
struct Hit {
    time: f64,
    contact: Contact,
}

fn hit(outcome: &Outcome) -> Option<Hit> {
    match *outcome {
        Outcome::Contact { time, contact } => Some(Hit { time, contact }),
        Outcome::Touching { contact } => Some(Hit { time: 0.0, contact }),
        Outcome::Free { .. } | Outcome::Overlapping { .. } | Outcome::Unresolved { .. } => None,
    }
}

fn grazes(outcome: &Outcome, tolerance: f64) -> bool {
    matches!(outcome, Outcome::Free { clearance } if *clearance <= tolerance)
}

/// Unresolved is no answer to agree with.
fn same_kind(one: &Outcome, other: &Outcome) -> bool {
    matches!(
        (one, other),
        (Outcome::Free { .. }, Outcome::Free { .. })
            | (Outcome::Overlapping { .. }, Outcome::Overlapping { .. })
    )
}

/// How long the witnesses of a hit take to close the tolerance, with as much again for what their
/// speed changes meanwhile; the whole duration when they slide.
fn crossing_time(query: &Query, hit: &Hit, tolerance: f64) -> f64 {
    let separation = &hit.contact.separation;
    let approach = velocity(&query.a, hit.time, separation.witness_a)
        - velocity(&query.b, hit.time, separation.witness_b);
    let closing_speed = approach.dot(separation.normal);
    if closing_speed > 0.0 {
        2.0 * tolerance / closing_speed
    } else {
        query.duration
    }
}

/// The velocity of the body's point that is at `point` at that time.
fn velocity(motion: &Motion, time: f64, point: DVec3) -> DVec3 {
    let centre = motion.pose(time).transform_point(motion.centre());
    motion.velocity() + motion.spin().cross(point - centre)
}
