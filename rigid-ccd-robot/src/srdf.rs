//! Reads the disabled pairs of links from an SRDF file, and writes an SRDF file with proven pairs.

use crate::link_contacts::LinkContactClass;
use crate::pairs::LinkPairs;
use crate::remark::CellRemark;
use crate::robot::Robot;
use crate::skip_reason::SkipReason;
use roxmltree::{Document, Node};
use std::fmt::Write;

/// The disabled and enabled pairs of an SRDF file.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Srdf {
    /// The name of the robot; empty if the file has none.
    robot_name: String,
    disabled: Vec<SrdfPair>,
    enabled: Vec<SrdfPair>,
    /// The links of `disable_default_collisions`. All their pairs with other links are disabled, unless
    /// `enable_collisions` enables a pair.
    disabled_links: Vec<String>,
}

/// A pair of links, by name.
#[derive(Debug, PartialEq)]
struct SrdfPair {
    links: [String; 2],
    /// The attribute `reason`, such as MoveIt's `Never` or `Adjacent`; empty if there is none.
    reason: String,
}

/// The reason why an SRDF file cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SrdfError {
    /// The file is not valid XML.
    #[error("{error}")]
    Syntax {
        /// The parser's message.
        error: String,
    },
    /// An element is unknown.
    #[error("an element `{element}` is not known in an SRDF")]
    UnknownElement {
        /// The name of the element.
        element: String,
    },
    /// An element does not have an attribute of this name.
    #[error("an element `{element}` has no attribute `{attribute}`")]
    UnknownAttribute {
        /// The name of the element.
        element: String,
        /// The name of the attribute.
        attribute: String,
    },
    /// A required attribute is missing.
    #[error("an element `{element}` needs an attribute `{attribute}`")]
    MissingAttribute {
        /// The name of the element.
        element: String,
        /// The name of the attribute.
        attribute: String,
    },
    /// The robot has none of the links that the file names.
    #[error("the file belongs to another robot: there is no link {}", links.join(", "))]
    OtherRobot {
        /// The names of the links in the file.
        links: Vec<String>,
    },
}

/// The elements that are unrelated to pairs of links.
const HARMLESS_ELEMENTS: [&str; 7] = [
    "end_effector",
    "group",
    "group_state",
    "joint_property",
    "link_sphere_approximation",
    "passive_joint",
    "virtual_joint",
];

impl Srdf {
    /// Reads the text of an SRDF file.
    pub(crate) fn from_text(text: &str) -> Result<Self, SrdfError> {
        let document = Document::parse(text);
        let document = document.map_err(|error| SrdfError::Syntax {
            error: error.to_string(),
        })?;
        let root = document.root_element();
        if root.tag_name().name() != "robot" {
            return Err(unknown_element(root));
        }
        let mut srdf = Srdf {
            robot_name: root.attribute("name").unwrap_or_default().trim().to_owned(),
            ..Srdf::default()
        };
        for element in root.children().filter(Node::is_element) {
            match element.tag_name().name() {
                // An element with a namespace prefix belongs to a program, such as xacro, that generates an SRDF.
                _ if element.tag_name().namespace().is_some() => {
                    return Err(unknown_element(element));
                }
                "disable_collisions" => srdf.disabled.push(SrdfPair::read(element)?),
                "enable_collisions" => srdf.enabled.push(SrdfPair::read(element)?),
                "disable_default_collisions" => {
                    check_attributes(element, &["link"])?;
                    srdf.disabled_links.push(attribute(element, "link")?);
                }
                name if HARMLESS_ELEMENTS.contains(&name) => {}
                _ => return Err(unknown_element(element)),
            }
        }
        Ok(srdf)
    }

    /// Applies the file to the pairs of a robot. Adds a remark if the file names unknown links, and if its robot name
    /// differs.
    pub(crate) fn apply(&self, robot: &Robot, pairs: &mut LinkPairs) -> Result<(), SrdfError> {
        let link_index = |link: &String| robot.link_number(link).ok();
        let unknown = self.unknown_links(robot)?;
        for link in self.disabled_links.iter().filter_map(link_index) {
            for other in (0..robot.links().len()).filter(|&other| other != link) {
                let reason = "disable_default_collisions".to_owned();
                pairs.skip(link, other, SkipReason::Disabled(reason));
            }
        }
        for SrdfPair { links, reason } in &self.disabled {
            if let [Some(one), Some(other)] = links.each_ref().map(link_index) {
                pairs.skip(one, other, SkipReason::Disabled(reason.clone()));
            }
        }
        for SrdfPair { links, .. } in &self.enabled {
            if let [Some(one), Some(other)] = links.each_ref().map(link_index) {
                pairs.include(one, other);
            }
        }
        if !unknown.is_empty() {
            pairs.add_file_remarks([CellRemark::UnknownLinks { links: unknown }]);
        }
        let are_named = !robot.name().is_empty() && !self.robot_name.is_empty();
        if are_named && robot.name() != self.robot_name {
            pairs.add_file_remarks([CellRemark::OtherRobotName {
                robot: robot.name().to_owned(),
                of_srdf: self.robot_name.clone(),
            }]);
        }
        Ok(())
    }

    /// Returns the links of the file that a robot does not have.
    ///
    /// # Errors
    /// If the robot has none of the links.
    fn unknown_links(&self, robot: &Robot) -> Result<Vec<String>, SrdfError> {
        let pairs = self.disabled.iter().chain(&self.enabled);
        let mut links: Vec<&String> = pairs.flat_map(|pair| &pair.links).collect();
        links.extend(&self.disabled_links);
        links.sort();
        links.dedup();
        let is_unknown = |link: &&&String| robot.link_number(link).is_err();
        let unknown: Vec<String> = links
            .iter()
            .filter(is_unknown)
            .map(|&link| link.clone())
            .collect();
        if !links.is_empty() && unknown.len() == links.len() {
            return Err(SrdfError::OtherRobot { links: unknown });
        }
        Ok(unknown)
    }
}

impl SrdfPair {
    fn read(element: Node<'_, '_>) -> Result<Self, SrdfError> {
        check_attributes(element, &["link1", "link2", "reason"])?;
        Ok(SrdfPair {
            links: [attribute(element, "link1")?, attribute(element, "link2")?],
            reason: element.attribute("reason").unwrap_or_default().to_owned(),
        })
    }
}

fn attribute(element: Node<'_, '_>, name: &str) -> Result<String, SrdfError> {
    let value = element.attribute(name).map(|value| value.trim().to_owned());
    value.ok_or_else(|| SrdfError::MissingAttribute {
        element: element.tag_name().name().to_owned(),
        attribute: name.to_owned(),
    })
}

fn check_attributes(element: Node<'_, '_>, known: &[&str]) -> Result<(), SrdfError> {
    let is_unknown = |attribute: &roxmltree::Attribute<'_, '_>| !known.contains(&attribute.name());
    match element.attributes().find(is_unknown) {
        None => Ok(()),
        Some(unknown) => Err(SrdfError::UnknownAttribute {
            element: element.tag_name().name().to_owned(),
            attribute: unknown.name().to_owned(),
        }),
    }
}

fn unknown_element(element: Node<'_, '_>) -> SrdfError {
    SrdfError::UnknownElement {
        element: element.tag_name().name().to_owned(),
    }
}

/// Escapes a text for an XML attribute.
fn escape(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;").replace('"', "&quot;")
}

impl Robot {
    /// Returns the text of an SRDF file that disables all pairs that need no check: adjacent links, unless `pairs` checks
    /// them, and pairs that are proven to touch never or always. The attribute `reason` is `Adjacent`, `Never (proven)`
    /// or `Always (proven)`. A robot without a name is called `robot`.
    ///
    /// ```
    /// use rigid_ccd_robot::{Link, LinkContactSettings, LinkPairs, Robot};
    /// let robot = Robot::new(vec![Link::named("base")], Vec::new())?.with_name("stone");
    /// let classes = robot.classify_link_contacts(&LinkContactSettings::DEFAULT, |_, _| ())?;
    /// let srdf = robot.to_srdf(&LinkPairs::from_robot(&robot), &classes);
    /// assert!(srdf.contains("<robot name=\"stone\">"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn to_srdf(&self, pairs: &LinkPairs, classes: &[([usize; 2], LinkContactClass)]) -> String {
        let name = match self.name() {
            "" => "robot",
            name => name,
        };
        let mut text = format!(
            "<?xml version=\"1.0\"?>\n<robot name=\"{}\">\n",
            escape(name)
        );
        for ([one, other], class) in classes {
            let reason = match class {
                LinkContactClass::Never => "Never (proven)",
                LinkContactClass::Always => "Always (proven)",
                // A file or caller may check adjacent links, such as the world and a body of an MJCF.
                _ if pairs.skip_reason(*one, *other) == Some(&SkipReason::Adjacent) => "Adjacent",
                LinkContactClass::AlwaysAsEnclosed
                | LinkContactClass::Sometimes { .. }
                | LinkContactClass::Undecided { .. } => continue,
            };
            let [one, other] = [one, other].map(|&link| escape(&self.links()[link].name));
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
