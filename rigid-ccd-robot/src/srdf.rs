//! Which pairs of links are not checked: reads them from an SRDF file, and writes one with proofs.

use crate::link_contacts::LinkContactClass;
use crate::robot::Robot;
use quick_xml::de::from_str;
use quick_xml::escape::escape;
use serde::Deserialize;
use std::fmt::Write;

/// The pairs that an SRDF file disables, and those that it enables again. Groups, states and other elements are ignored.
#[derive(Debug, Deserialize)]
struct Document {
    #[serde(rename = "disable_collisions", default)]
    disabled: Vec<SrdfPair>,
    #[serde(rename = "enable_collisions", default)]
    enabled: Vec<SrdfPair>,
}

/// A pair of links by their names.
#[derive(Debug, Deserialize, PartialEq)]
pub(crate) struct SrdfPair {
    #[serde(rename = "@link1")]
    pub(crate) link1: String,
    #[serde(rename = "@link2")]
    pub(crate) link2: String,
    /// MoveIt's reason, such as `Never` or `Adjacent`; empty if the file has none.
    #[serde(rename = "@reason", default)]
    pub(crate) reason: String,
}

/// Reads the pairs that are not checked, and those that are checked nevertheless, from the text of an SRDF file.
pub(crate) fn disabled_and_enabled_pairs(
    text: &str,
) -> Result<[Vec<SrdfPair>; 2], quick_xml::DeError> {
    let Document { disabled, enabled } = from_str(text)?;
    Ok([disabled, enabled])
}

impl Robot {
    /// Writes an SRDF file in which all pairs are disabled that need no check: neighbours, and pairs that are proven to touch
    /// never or always. The reason of each says which.
    ///
    /// ```
    /// use rigid_ccd_robot::{Link, Robot};
    /// let robot = Robot::new(vec![Link::named("base")], Vec::new())?;
    /// let srdf = robot.to_srdf("stone", &robot.classify_link_contacts(100)?);
    /// assert!(srdf.contains("<robot name=\"stone\">"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn to_srdf(&self, robot_name: &str, meetings: &[([usize; 2], LinkContactClass)]) -> String {
        let mut text = format!(
            "<?xml version=\"1.0\"?>\n<robot name=\"{}\">\n",
            escape(robot_name)
        );
        for ([one, other], meeting) in meetings {
            let reason = match meeting {
                LinkContactClass::Never => "Never (proven)",
                LinkContactClass::Always => "Always (proven)",
                _ if self.are_neighbours(*one, *other) => "Adjacent",
                LinkContactClass::Sometimes { .. } | LinkContactClass::Undecided { .. } => continue,
            };
            let [one, other] = [one, other].map(|&link| escape(&*self.links()[link].name));
            writeln!(
                text,
                "  <disable_collisions link1=\"{one}\" link2=\"{other}\" reason=\"{reason}\"/>"
            )
            .expect("a string takes all text");
        }
        text + "</robot>\n"
    }
}

#[cfg(test)]
mod tests;
