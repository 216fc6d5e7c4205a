//! Converts a MuJoCo model, MJCF, to a robot.

mod geoms;
mod joints;
mod pairs;

use super::BodyElements;
use super::bodies::MeshBodies;
use super::error::RobotFileError;
use crate::pairs::LinkPairs;
use crate::robot::{Link, Robot};
use geoms::GeomReader;
use joints::JointReader;
use mjcf_rs::Model;
use rigid_ccd::{InputError, Pose};
use std::path::{Path, PathBuf};

/// The first element of an MJCF file.
pub(super) const ROOT_ELEMENT: &str = "mujoco";

/// The number of the body that does not move.
const WORLD: usize = 0;

/// The parsed text of an MJCF file.
pub(super) struct MjcfModel {
    model: Model,
    /// The folder in which meshes are found.
    folder: PathBuf,
    /// The name of the link that each body becomes.
    link_names: Vec<String>,
}

impl MjcfModel {
    /// Parses a text, which includes files of a folder.
    pub(super) fn from_text(text: &str, folder: &Path) -> Result<Self, String> {
        let model = Model::from_str(text, folder).map_err(|error| error.to_string())?;
        let names = model.bodies.iter().enumerate();
        let names = names.map(|(number, entry)| match (&entry.body.name, number) {
            (_, WORLD) => "world".to_owned(),
            (Some(name), _) => name.clone(),
            (None, _) => format!("body{number}"),
        });
        Ok(MjcfModel {
            link_names: names.collect(),
            folder: folder.to_owned(),
            model,
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
        let joints_of_bodies = JointReader::new(self);
        let (mut links, mut joints) = (Vec::new(), Vec::new());
        for (number, name) in self.link_names.iter().enumerate() {
            let bodies = geoms.bodies(number);
            links.push(Link {
                name: name.clone(),
                bodies: bodies.map_err(|error| error.with_link_name(name))?,
            });
            let (between, own) = joints_of_bodies.joints(number)?;
            links.extend(between);
            joints.extend(own);
        }
        Ok(Robot::new(links, joints)?)
    }

    /// Returns the pairs of links that MuJoCo checks.
    pub(super) fn link_pairs(
        &self,
        robot: &Robot,
        elements: BodyElements,
    ) -> Result<LinkPairs, RobotFileError> {
        pairs::link_pairs(self, robot, elements)
    }
}

fn convert_pose(pose: mjcf_rs::Pose) -> Result<Pose, InputError> {
    Pose::new(pose.translation.to_array(), pose.rotation.to_array())
}

#[cfg(test)]
mod tests;
