//! Reads from an SRDF file which pairs of links are not checked.

use quick_xml::de::from_str;
use serde::Deserialize;

/// The pairs that an SRDF file disables. Groups, states and other elements are ignored.
#[derive(Debug, Deserialize)]
struct Document {
    #[serde(rename = "disable_collisions", default)]
    pairs: Vec<DisabledPair>,
}

/// A pair of links that is not checked, by their names.
#[derive(Debug, Deserialize, PartialEq)]
pub(crate) struct DisabledPair {
    #[serde(rename = "@link1")]
    pub(crate) link1: String,
    #[serde(rename = "@link2")]
    pub(crate) link2: String,
    /// MoveIt's reason, such as `Never` or `Adjacent`; empty if the file has none.
    #[serde(rename = "@reason", default)]
    pub(crate) reason: String,
}

/// Reads the pairs that are not checked from the text of an SRDF file.
pub(crate) fn disabled_pairs(text: &str) -> Result<Vec<DisabledPair>, quick_xml::DeError> {
    Ok(from_str::<Document>(text)?.pairs)
}

#[cfg(test)]
mod tests;
