//! Describes rows of results in words.

use ccd_tables::results::{ResultRow, Status};

/// The facts about a query that the description of its answer needs: the meaning of times, the margin, the clearance.
#[derive(Clone, Copy, Debug)]
pub struct QueryContext {
    /// The meaning of the answer's time.
    pub time_meaning: TimeMeaning,
    /// The margin of the query, in the scene's unit of length.
    pub query_margin: f64,
    /// The required distance that the query's answer is compared with, if any.
    pub clearance: Option<f64>,
}

/// The meaning of the time in an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimeMeaning {
    /// The certified time of the first contact or, for a closest approach, of the least distance.
    FirstContact,
    /// The time of the [first](TimeMeaning::FirstContact) contact, where a contact at the start is ignored until the
    /// bodies part.
    FirstContactAfterParting,
    /// The time of some contact, perhaps not the first one.
    SomeContact,
    /// The time at which the distance was measured.
    MeasurementTime,
    /// The time of the first contact according to the published bound, which is not certified.
    UncertifiedFirstContact,
    /// A time from a table of results; the question and the bound of that table are unknown.
    TableTime,
}

/// Describes the answer of a row in words. The motions end at `end`, and `least_proven_gap` is a lower bound of the
/// distance at all times.
pub(super) fn verdict(
    row: &ResultRow,
    context: QueryContext,
    end: f64,
    least_proven_gap: Option<f64>,
) -> String {
    let time = row
        .time
        .map_or("an unknown time".to_owned(), format_rounded_down);
    let reason = row.reason.as_deref().unwrap_or("no reason given");
    let clearance = match context.clearance {
        Some(length) => format!("The clearance of {}", format_rounded_down(length)),
        None => "The clearance".to_owned(),
    };
    match row.status {
        Status::Contact => describe_contact_after_start(row, context, &time),
        Status::Free => describe_free_bodies(context, end, least_proven_gap),
        Status::Touching | Status::Overlapping => {
            let kind = match row.status {
                Status::Overlapping => "Overlapping",
                _ if context.query_margin > 0.0 => "Within the margin",
                _ => "In contact",
            };
            let (contact, after) = (describe_contact(row), describe_end_of_start_contact(row));
            format!("{kind} at the start: {contact}.{after}")
        }
        Status::Measured if context.time_meaning == TimeMeaning::MeasurementTime => {
            format!("At {time}: {}.", describe_distance(row))
        }
        Status::Measured => format!("Nearest at {time}: {}.", describe_distance(row)),
        Status::Kept => {
            let when = match row.distance_upper {
                Some(_) => format!(": nearest at {time},"),
                None => format!(", to the end at {time}:"),
            };
            format!("{clearance} is kept{when} {}.", describe_distance(row))
        }
        Status::Violated => match row.distance_upper {
            Some(upper) if !has_negative_distance(row) => {
                let upper = number_rounded_up(upper);
                format!("{clearance} is violated: at {time} at most {upper} apart.")
            }
            _ => format!(
                "{clearance} is violated at {time}: {}.",
                describe_distance(row)
            ),
        },
        Status::Unverified => format!("{clearance} is not verified: {reason}."),
        Status::Unresolved => match context.time_meaning {
            TimeMeaning::UncertifiedFirstContact => {
                format!("Not resolved ({reason}) after {time}. Not certified.")
            }
            TimeMeaning::TableTime => {
                format!("Not resolved ({reason}) after {time}, as the table says.")
            }
            TimeMeaning::FirstContactAfterParting => format!(
                "Not resolved ({reason}). Proven: nothing touches before {time}, except for a contact at the start, \
                 which was ignored until the bodies parted."
            ),
            _ => format!(
                "Not resolved ({reason}). Proven: nothing touches before {time}. After it nothing is known."
            ),
        },
        Status::Error => format!("Not answered: {reason}."),
    }
}

/// Describes after which time bodies that touch at the start are proven not to touch; empty for a row without
/// `last_time`.
fn describe_end_of_start_contact(row: &ResultRow) -> String {
    row.last_time.map_or(String::new(), |last| {
        format!(" Proven: not after {}.", number_rounded_up(last))
    })
}

/// Describes a contact that begins after the start.
fn describe_contact_after_start(row: &ResultRow, context: QueryContext, time: &str) -> String {
    let margin = format_rounded_down(context.query_margin);
    let (first, at, before) = if context.query_margin > 0.0 {
        (
            format!("First within the margin of {margin}"),
            format!("Within the margin of {margin}"),
            "not within it before",
        )
    } else {
        (
            "First contact".to_owned(),
            "Contact".to_owned(),
            "nothing touches before",
        )
    };
    let contact = describe_contact(row);
    match (context.time_meaning, row.last_time) {
        (TimeMeaning::FirstContact, None) => {
            format!("{first} at {time}: {contact}. Proven: {before}.")
        }
        (TimeMeaning::FirstContact, Some(last)) => format!(
            "{first} at {time}: {contact}. Proven: {before}, nor after {}.",
            number_rounded_up(last)
        ),
        (TimeMeaning::FirstContactAfterParting, _) => format!(
            "{at} at {time}: {contact}. Proven: {before}, except for a contact at the start, which was ignored until the bodies parted."
        ),
        (TimeMeaning::SomeContact | TimeMeaning::MeasurementTime, _) => {
            format!("{at} at {time}: {contact}. There may be an earlier one.")
        }
        (TimeMeaning::UncertifiedFirstContact, _) => {
            format!("{at} at {time}: {contact}. Not certified: it may be late.")
        }
        (TimeMeaning::TableTime, _) => format!("{at} at {time}, as the table says: {contact}."),
    }
}

fn describe_free_bodies(context: QueryContext, end: f64, least_proven_gap: Option<f64>) -> String {
    let end = format_rounded_down(end);
    match (
        context.time_meaning,
        least_proven_gap.filter(|gap| *gap > 0.0),
    ) {
        (_, Some(gap)) => format!(
            "No contact, to the end at {end}. Proven: never nearer than {}.",
            format_rounded_down(gap)
        ),
        (TimeMeaning::UncertifiedFirstContact, None) => {
            format!("No contact found, to the end at {end}. Not certified.")
        }
        (TimeMeaning::TableTime, None) => {
            format!("No contact, to the end at {end}, as the table says.")
        }
        (TimeMeaning::FirstContactAfterParting, None) => {
            format!(
                "No contact, to the end at {end}. Proven, except for a contact at the start, which was ignored until the bodies parted."
            )
        }
        (_, None) => format!("No contact, to the end at {end}. Proven."),
    }
}

/// Describes which features touch or are nearest.
pub(super) fn describe_contact(row: &ResultRow) -> String {
    let features = match (&row.feature_a, &row.feature_b) {
        (Some(a), Some(b)) => format!(
            "{} of A at {} of B",
            feature_in_words(a),
            feature_in_words(b)
        ),
        _ => "one body is inside the other".to_owned(),
    };
    match row.distance_upper {
        Some(_) => format!("{features}, {}", describe_distance(row)),
        None => features,
    }
}

fn has_negative_distance(row: &ResultRow) -> bool {
    row.distance_lower.is_some_and(|lower| lower < 0.0)
}

fn describe_distance(row: &ResultRow) -> String {
    match (row.distance_lower, row.distance_upper) {
        (Some(lower), Some(_)) if lower < 0.0 => format!(
            "two pieces that a shift by {} would part; the bodies may overlap by more",
            number_rounded_up(-lower)
        ),
        (Some(0.0), Some(upper)) => {
            format!("at most {} apart: they may touch", number_rounded_up(upper))
        }
        (Some(lower), Some(upper)) => {
            format!(
                "between {} and {} apart",
                format_rounded_down(lower),
                number_rounded_up(upper)
            )
        }
        (Some(lower), None) => format!("at least {} apart", format_rounded_down(lower)),
        // One body is inside the other, and the bodies exceed their shapes.
        (None, Some(upper)) => format!("their shapes at most {} apart", number_rounded_up(upper)),
        _ => "at an unknown distance".to_owned(),
    }
}

/// Returns the name of a feature in words: `vertex 7` for `v7`.
fn feature_in_words(name: &str) -> String {
    let kind = match name.as_bytes().first() {
        Some(b'v') => "vertex",
        Some(b'e') => "edge",
        Some(b'f') => "face",
        Some(b'p') => "piece",
        _ => return name.to_owned(),
    };
    format!("{kind} {}", &name[1..])
}

/// Formats a number with at most six decimals, or four digits and an exponent, rounded down: the text is a lower bound.
pub(super) fn format_rounded_down(value: f64) -> String {
    let text = number_with_few_digits(value);
    match text.parse::<f64>() {
        Ok(read) if value < read => number_with_few_digits(value - last_digit_value(value)),
        _ => text,
    }
}

/// Formats a number with as many digits as [`format_rounded_down`], rounded up: the text is an upper bound.
fn number_rounded_up(value: f64) -> String {
    let text = number_with_few_digits(value);
    match text.parse::<f64>() {
        Ok(read) if read < value => number_with_few_digits(value + last_digit_value(value)),
        _ => text,
    }
}

fn number_with_few_digits(value: f64) -> String {
    if needs_no_exponent(value) {
        let text = format!("{value:.6}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        format!("{value:.3e}")
    }
}

/// Returns the value of one unit in the last digit that [`format_rounded_down`] writes.
fn last_digit_value(value: f64) -> f64 {
    if needs_no_exponent(value) {
        1e-6
    } else {
        10f64.powf(value.abs().log10().floor() - 3.0)
    }
}

fn needs_no_exponent(value: f64) -> bool {
    value == 0.0 || (1e-3..1e12).contains(&value.abs())
}
