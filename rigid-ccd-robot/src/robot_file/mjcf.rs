//! Converts a MuJoCo model, MJCF, to a robot.
//!
//! What is not known is an error: an element that is passed over may stand for a shape.

mod assets;
mod attributes;
mod bodies;
mod classes;
mod document;
mod geoms;
mod joints;
mod model;
mod orientation;
mod pairs;
mod settings;

pub(super) use model::MjcfModel;

use super::body_elements::BodyElements;
use super::error::RobotFileError;
use super::meshes::MeshBodies;
use crate::robot::{Link, Robot};
use geoms::GeomReader;
use joints::JointReader;

/// The first element of an MJCF file.
pub(super) const ROOT_ELEMENT: &str = "mujoco";

impl MjcfModel {
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
}

#[cfg(test)]
mod tests;
