//! Chooses the length of the next stretch of time to search along trajectories. It has to be long enough for progress,
//! and so short that the deviations are less than the bodies' distance.

use super::motions::StretchMotions;
use super::stretches::WaitingStretches;
use crate::answer::Contact;
use crate::distance::oracle::DistanceOracle;
use crate::engine::scratch::Scratch;
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::query::Query;
use crate::settings::QuerySettings;
use crate::tuning::{MAX_DEVIATION_SHARE, MIN_UNMEASURED_HALVING_LENGTH_SHARE};

/// Measures the bodies at one end of a stretch, and returns the length that suits the stretch; `None` if the bodies
/// overlap, or if a limit is reached.
pub(super) fn suitable_length_by_measurement<O: DistanceOracle>(
    stretches: &mut WaitingStretches<'_, '_>,
    motions: &StretchMotions,
    time: f64,
    oracle: &mut O,
    scratch: &mut Scratch,
) -> Result<Option<f64>, InputError> {
    let seen = stretches.measure_distance_at(time, oracle, scratch)?;
    Ok(seen.map(|(contact, approach)| {
        // Rates have the opposite sign backwards in time.
        let approach = if time > motions.span.from {
            -approach
        } else {
            approach
        };
        stretch_length_from_distance(stretches.query, motions, (contact, approach))
    }))
}

/// Chooses the length of the next stretch to search, after the motions of a stretch were found in contact.
pub(super) fn choose_next_stretch_length<O: DistanceOracle>(
    stretches: &mut WaitingStretches<'_, '_>,
    motions: &StretchMotions,
    (time, seen): (f64, Option<Contact>),
    oracle: &mut O,
    scratch: &mut Scratch,
) -> Result<f64, InputError> {
    let query = stretches.query;
    let seen = if time > 0.0 {
        seen.map(|contact| (contact, motions.approach_rate(time, &contact)))
    } else if motions.span.length() > MIN_UNMEASURED_HALVING_LENGTH_SHARE * query.duration {
        // Halves mostly suffice, and cost less.
        return Ok(f64::INFINITY);
    } else {
        // The motions begin beside the bodies. They do not show the distance of the bodies, which is measured.
        stretches.measure_distance_at(motions.span.from, oracle, scratch)?
    };
    Ok(match seen {
        Some(seen) => stretch_length_from_distance(query, motions, seen),
        None => {
            motions.stretch_length_for_deviation(MAX_DEVIATION_SHARE * query.settings.tolerance)
        }
    })
}

/// Computes the length of the next stretch to search, from the bodies' distance at a contact and their rate of
/// approach. In such a stretch the deviation is a part of the distance, and the bodies reach the time at which they
/// meet or are nearest.
///
/// Bodies at a distance `d` that approach each other at a rate `r` meet after `d/r`. If they approach ever slower,
/// and pass each other closely, they are nearest after about `2 d/r`.
fn stretch_length_from_distance(
    query: &Query<'_>,
    motions: &StretchMotions,
    (contact, approach): (Contact, f64),
) -> f64 {
    let QuerySettings {
        margin, tolerance, ..
    } = query.settings;
    let gap = greater(contact.separation.upper - margin, tolerance);
    let nearest = 2.0 * gap / approach;
    // Written so that NaN is no time.
    if nearest > 0.0 {
        lesser(
            motions.stretch_length_for_deviation(MAX_DEVIATION_SHARE * gap),
            nearest,
        )
    } else {
        motions.stretch_length_for_deviation((1.0 - MAX_DEVIATION_SHARE) * gap)
    }
}
