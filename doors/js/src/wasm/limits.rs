//! The limits that leave a question unresolved.

use rigid_ccd::answer::Limit;
use wasm_bindgen::prelude::wasm_bindgen;

const LIMITS: [Limit; 6] = [
    Limit::Budget,
    Limit::Deadline,
    Limit::Stopped,
    Limit::Stalled,
    Limit::OracleGaveUp,
    Limit::OverlapUndecided,
];

/// Returns the number of a limit. JavaScript passes it to [`limit_name`] and [`limit_advice`].
pub(crate) fn limit_number(limit: Limit) -> usize {
    let number = LIMITS.iter().position(|other| *other == limit);
    number.unwrap_or(LIMITS.len())
}

/// Returns the name of the limit with a number.
#[wasm_bindgen]
pub fn limit_name(number: usize) -> String {
    LIMITS.get(number).copied().map_or("other".into(), name)
}

/// Returns advice about the limit with a number, in the names of JavaScript.
#[wasm_bindgen]
pub fn limit_advice(number: usize) -> String {
    LIMITS.get(number).copied().map_or(String::new(), advice)
}

pub(crate) fn name(limit: Limit) -> String {
    limit.to_string()
}

/// Returns advice about a limit, in the names of JavaScript.
pub(crate) fn advice(limit: Limit) -> String {
    let advice = match limit {
        Limit::Budget => {
            "the budget is spent: a larger tolerance, or isFree with a margin, often decides at once; a larger budget \
             takes longer"
        }
        Limit::OracleGaveUp => {
            "a distance was not found: a larger tolerance, or another pose, may help"
        }
        limit => limit.advice(),
    };
    advice.to_owned()
}
