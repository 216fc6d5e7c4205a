//! The limits that leave a question unresolved.

use rigid_ccd::answer::Limit;
use wasm_bindgen::prelude::wasm_bindgen;

/// Returns the number of a limit. JavaScript passes it to [`limit_name`] and [`limit_advice`].
pub(crate) fn limit_number(limit: Limit) -> usize {
    let number = Limit::ALL.iter().position(|other| *other == limit);
    number.unwrap_or(Limit::ALL.len())
}

/// Returns the name of the limit with a number.
#[wasm_bindgen]
pub fn limit_name(number: usize) -> String {
    let limit = Limit::ALL.get(number);
    limit.map_or("other".into(), Limit::to_string)
}

/// Returns what the caller can do about the limit with a number. Functions have their JavaScript names.
#[wasm_bindgen]
pub fn limit_advice(number: usize) -> String {
    let limit = Limit::ALL.get(number).copied();
    limit.map_or(String::new(), advice)
}

/// Returns what the caller can do about a limit. Functions have their JavaScript names.
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
