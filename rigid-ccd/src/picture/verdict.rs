//! What a row of the results says, in words.

use crate::table::results::{ResultRow, Status};
use ccd_core::order::greater;

/// Returns the answer of a row as sentences; `end` is the end of its motions, `proven` a gap that is proven at all times.
pub(super) fn verdict(row: &ResultRow, end: f64, proven: Option<f64>) -> String {
    let time = row.time.map_or("an unknown time".to_owned(), number);
    let apart = apart(row);
    let reason = row.reason.as_deref().unwrap_or("no reason given");
    match row.status {
        Status::Contact => format!(
            "First contact at {time}: {}. Proven: nothing touches before.",
            contact(row)
        ),
        Status::Free => match row
            .distance_lower
            .map(|gap| greater(gap, proven.unwrap_or(gap)))
        {
            Some(gap) => format!(
                "No contact until {}. Proven: never nearer than {}.",
                number(end),
                number(gap)
            ),
            None => format!("No contact until {}. Proven.", number(end)),
        },
        Status::Touching => format!("In contact at the start: {}.", contact(row)),
        Status::Overlapping => format!("Overlapping at the start: {}.", contact(row)),
        Status::Measured => format!("Nearest at {time}: {apart}."),
        Status::Kept => format!("The clearance is kept: nearest at {time}, {apart}."),
        Status::Violated => format!("The clearance is violated: nearest at {time}, {apart}."),
        Status::Unverified => format!("The clearance is not verified: {reason}."),
        Status::Unresolved => format!(
            "Not resolved ({reason}). Proven: nothing touches before {time}. After it nothing is known."
        ),
        Status::Error => format!("Not answered: {reason}."),
    }
}

/// Returns what touches, or is nearest.
pub(super) fn contact(row: &ResultRow) -> String {
    let features = match (&row.feature_a, &row.feature_b) {
        (Some(a), Some(b)) => format!("{} of A at {} of B", feature(a), feature(b)),
        _ => "one body is inside the other".to_owned(),
    };
    match row.distance_upper {
        Some(_) => format!("{features}, {}", apart(row)),
        None => features,
    }
}

fn apart(row: &ResultRow) -> String {
    match (row.distance_lower, row.distance_upper) {
        (Some(lower), Some(_)) if lower < 0.0 => {
            format!("a shift by {} would part them", number_up(-lower))
        }
        (Some(lower), Some(upper)) => {
            format!("between {} and {} apart", number(lower), number_up(upper))
        }
        (Some(lower), None) => format!("at least {} apart", number(lower)),
        _ => "at an unknown distance".to_owned(),
    }
}

/// Returns `vertex 7` for `v7`.
fn feature(name: &str) -> String {
    let kinds = [
        ('v', "vertex"),
        ('e', "edge"),
        ('f', "face"),
        ('p', "piece"),
    ];
    let kind = kinds.iter().find(|(sign, _)| name.starts_with(*sign));
    kind.map_or_else(
        || name.to_owned(),
        |(_, kind)| format!("{kind} {}", &name[1..]),
    )
}

/// Returns a number in at most seven digits, rounded down: what is proven of it is proven of the text.
pub(super) fn number(value: f64) -> String {
    let text = short(value);
    match text.parse::<f64>() {
        Ok(read) if value < read => short(value - last_digit(value)),
        _ => text,
    }
}

/// Returns a number in at most seven digits, rounded up.
fn number_up(value: f64) -> String {
    let text = short(value);
    match text.parse::<f64>() {
        Ok(read) if read < value => short(value + last_digit(value)),
        _ => text,
    }
}

fn short(value: f64) -> String {
    match is_plain(value) {
        true => {
            let text = format!("{value:.6}");
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        }
        false => format!("{value:.3e}"),
    }
}

/// Returns the worth of the last digit that is written.
fn last_digit(value: f64) -> f64 {
    match is_plain(value) {
        true => 1e-6,
        false => 10f64.powf(value.abs().log10().floor() - 3.0),
    }
}

fn is_plain(value: f64) -> bool {
    value == 0.0 || (1e-3..1e6).contains(&value.abs())
}
