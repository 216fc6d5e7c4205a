//! Converts a MuJoCo model (MJCF) into a robot.
//!
//! An unknown element is an error, because it may be a shape.

mod assets;
mod attributes;
mod bodies;
mod classes;
mod document;
mod geoms;
mod height_fields;
mod joints;
mod model;
mod names;
mod orientation;
mod pairs;
mod schema;
mod settings;

pub(super) use model::MjcfModel;

use super::body_elements::BodyElements;
use super::error::RobotFileError;
use super::meshes::MeshBodies;
use super::mjcf_error::MjcfError;
use crate::remark::CellRemark;
use crate::robot::{Link, Robot};
use bodies::MjcfJointKind;
use geoms::GeomReader;
use joints::JointReader;
use rigid_ccd::Remark;

/// The root element of an MJCF file.
pub(super) const ROOT_ELEMENT: &str = "mujoco";

impl MjcfModel {
    /// Builds the robot. Each body becomes a link.
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
            let mut link = Link::named(&body.name);
            let result = geoms.add_to(&mut link, body);
            result.map_err(|error| error.within("link", &body.name))?;
            links.push(link);
            let (added_links, added_joints) = joints_of_bodies.joints(body)?;
            links.extend(added_links);
            joints.extend(added_joints);
        }
        Ok(Robot::new(links, joints)?.with_file_remarks(self.remarks()?))
    }

    /// Returns remarks on ignored constraints, on margins, and on joint limits that seem to be in degrees.
    fn remarks(&self) -> Result<Vec<CellRemark>, MjcfError> {
        let mut remarks = Vec::new();
        for kind in ["connect", "weld"] {
            for constraint in self.constraints_named(kind) {
                if constraint.truth_or("active", true)? {
                    remarks.push(CellRemark::left_out(format!(
                        "{} in equality",
                        constraint.label()
                    )));
                }
            }
        }
        remarks.extend(self.margins()?);
        let joints = self.bodies.iter().flat_map(|body| &body.joints);
        for joint in joints.filter(|joint| joint.kind == MjcfJointKind::Hinge) {
            let mut limits = joint.limits.into_iter().flatten();
            let remark = limits.find_map(Remark::remark_on_joint);
            let named = |remark| CellRemark::on(format!("joint {}", joint.name), remark);
            remarks.extend(remark.map(named));
        }
        Ok(remarks)
    }

    /// Returns a remark if geoms or pairs have margins. MuJoCo reports a contact within a margin, but margins are
    /// ignored here.
    fn margins(&self) -> Result<Option<CellRemark>, MjcfError> {
        let geoms = self.bodies.iter().flat_map(|body| &body.geoms);
        let solid_geoms = geoms.filter(|geom| self.is_solid(geom));
        let geom_attributes = solid_geoms.map(|geom| &geom.attributes);
        let mut labels = Vec::new();
        for attributes in geom_attributes.chain(self.constraints_named("pair")) {
            let [margin] = attributes.array("margin")?.unwrap_or([0.0]);
            if self.settings.margin().unwrap_or(margin) != 0.0 {
                labels.push(attributes.label());
            }
        }
        let more_count = labels.len().saturating_sub(1);
        Ok(labels.first().map(|first| {
            CellRemark::left_out(match more_count {
                0 => format!("margin of {first}"),
                _ => format!("margin of {first} and {more_count} more"),
            })
        }))
    }
}

#[cfg(test)]
mod tests;
