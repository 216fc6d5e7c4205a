//! The parsed contents of an MJCF file.

use super::assets::{Assets, read_assets};
use super::attributes::Attributes;
use super::bodies::{MjcfBody, read_bodies};
use super::classes::Classes;
use super::document::parse;
use super::names::Names;
use super::schema;
use super::settings::Settings;
use crate::robot_file::error::RobotFileError;
use crate::robot_file::mjcf_error::MjcfError;
use std::path::Path;

/// The parsed contents of an MJCF file.
pub(in crate::robot_file) struct MjcfModel {
    pub(super) settings: Settings,
    /// The bodies. The world comes first, and parents come before children.
    pub(super) bodies: Vec<MjcfBody>,
    pub(super) assets: Assets,
    /// The elements of `contact` and `equality`, merged with their classes.
    constraints: Vec<Attributes>,
}

impl MjcfModel {
    /// Parses the text of a file. Included files are relative to a folder.
    pub(in crate::robot_file) fn from_text(
        text: &str,
        folder: &Path,
    ) -> Result<Self, RobotFileError> {
        let root = parse(text, folder)?;
        schema::check(&root)?;
        let settings = Settings::read(&root, folder)?;
        let classes = Classes::read(&root)?;
        let mut constraints = Vec::new();
        let mut names = Names::default();
        for section in &root.children {
            match section.name.as_str() {
                "contact" => {
                    for element in &section.children {
                        let attributes = classes.merged(element, None)?;
                        names.add(&element.name, attributes.name("name"))?;
                        constraints.push(attributes);
                    }
                }
                // Classes list all kinds of equalities under one name.
                "equality" => {
                    for element in &section.children {
                        let attributes = classes.merged_as("equality", element, None)?;
                        names.add("equality", attributes.name("name"))?;
                        if settings.has_equalities {
                            constraints.push(attributes);
                        }
                    }
                }
                // Other modules read the other sections, or they are unrelated to shapes, joints and pairs. A tendon
                // may couple two joints, which are treated as independent.
                _ => {}
            }
        }
        let bodies = read_bodies(&root, &settings, &classes)?;
        for body in &bodies {
            names.add("body", Some(&body.name))?;
            for joint in &body.joints {
                names.add("joint", Some(&joint.name))?;
            }
            for geom in &body.geoms {
                names.add("geom", geom.name())?;
            }
        }
        Ok(MjcfModel {
            bodies,
            assets: read_assets(&root, &classes)?,
            constraints,
            settings,
        })
    }

    /// Returns the index of the body with a name.
    pub(super) fn body_named(&self, name: &str) -> Result<usize, MjcfError> {
        let number = self.bodies.iter().position(|body| body.name == name);
        number.ok_or_else(|| MjcfError::unknown_name("body", name))
    }

    /// Iterates over the elements of `contact` and `equality` of one kind.
    pub(super) fn constraints_named(&self, element: &str) -> impl Iterator<Item = &Attributes> {
        self.constraints
            .iter()
            .filter(move |constraint| constraint.element == element)
    }
}
