//! Converts a MuJoCo model, MJCF, to a robot.
//!
//! What is not known is an error: an element that is passed over may stand for a shape.

mod attributes;
mod bodies;
mod classes;
mod document;
mod error;
mod geoms;
mod joints;
mod orientation;
mod pairs;
mod settings;

pub use error::MjcfError;

use super::BodyElements;
use super::error::RobotFileError;
use super::meshes::MeshBodies;
use crate::robot::{Link, Robot};
use bodies::{MjcfBody, read_bodies};
use classes::Classes;
use document::Element;
use geoms::{GeomReader, MeshAsset, read_mesh_assets};
use joints::JointReader;
use settings::Settings;
use std::collections::HashMap;
use std::path::Path;

/// The first element of an MJCF file.
pub(super) const ROOT_ELEMENT: &str = "mujoco";

/// The number of the body that does not move.
const WORLD: usize = 0;

/// What an MJCF file says of a robot.
pub(super) struct MjcfModel {
    settings: Settings,
    /// The bodies; the world is first, and others follow their parents.
    bodies: Vec<MjcfBody>,
    meshes: HashMap<String, MeshAsset>,
    /// The elements of `contact` and `equality`, with the attributes of their classes.
    constraints: Vec<attributes::Attributes>,
}

/// Sections of a model that say nothing of shapes, joints or pairs.
const OTHER_SECTIONS: [&str; 12] = [
    "actuator",
    "asset",
    "compiler",
    "custom",
    "default",
    "extension",
    "keyframe",
    "option",
    "sensor",
    "size",
    "statistic",
    "visual",
];

impl MjcfModel {
    /// Reads the text of a file, which includes files of a folder.
    pub(super) fn from_text(text: &str, folder: &Path) -> Result<Self, RobotFileError> {
        let root = document::parse(text, folder)?;
        let settings = Settings::read(&root, folder)?;
        let classes = Classes::read(&root)?;
        let mut constraints = Vec::new();
        for section in &root.children {
            match section.name.as_str() {
                "contact" | "equality" => {
                    for element in &section.children {
                        constraints.push(classes.merged(element, None)?);
                    }
                }
                // A tendon is no shape; it may hold two joints together, which then are independent.
                "worldbody" | "tendon" => {}
                other if OTHER_SECTIONS.contains(&other) => {}
                _ => return Err(section.unknown_in(ROOT_ELEMENT).into()),
            }
        }
        Ok(MjcfModel {
            bodies: read_bodies(&root, &settings, &classes)?,
            meshes: read_mesh_assets(&root, &classes)?,
            constraints,
            settings,
        })
    }

    /// Builds the robot: a link for each body, and joints between them.
    pub(super) fn robot(
        &self,
        elements: BodyElements,
        meshes: &MeshBodies,
    ) -> Result<Robot, RobotFileError> {
        let geoms = GeomReader {
            mjcf: self,
            elements,
            meshes,
        };
        let joints_of_bodies = JointReader::new(self)?;
        let (mut links, mut joints) = (Vec::new(), Vec::new());
        for body in &self.bodies {
            let own = geoms.bodies(body);
            links.push(Link {
                name: body.name.clone(),
                bodies: own.map_err(|error| error.with_link_name(&body.name))?,
            });
            let (between, own) = joints_of_bodies.joints(body)?;
            links.extend(between);
            joints.extend(own);
        }
        Ok(Robot::new(links, joints)?)
    }

    /// Returns the number of the body that has a name.
    fn body_named(&self, name: &str) -> Result<usize, MjcfError> {
        let number = self.bodies.iter().position(|body| body.name == name);
        number.ok_or_else(|| MjcfError::unknown_name("body", name))
    }

    /// Iterates over the elements of `contact` and `equality` with a name.
    fn constraints_named(&self, element: &str) -> impl Iterator<Item = &attributes::Attributes> {
        self.constraints
            .iter()
            .filter(move |own| own.element == element)
    }
}

/// Iterates over the children of all sections of a model that have a name.
fn children_of_sections<'r>(
    root: &'r Element,
    section: &'r str,
) -> impl Iterator<Item = &'r Element> {
    let sections = root.children.iter().filter(move |own| own.name == section);
    sections.flat_map(|section| &section.children)
}

#[cfg(test)]
mod tests;
