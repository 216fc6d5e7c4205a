//! Converts the links and joints of a URDF file.

use super::body_elements::BodyElements;
use super::error::RobotFileError;
use super::materials::without_materials;
use super::meshes::MeshBodies;
use super::packages::SearchFolders;
use crate::robot::{CompoundKind, Joint, Link, LinkBody, PositionRule, Robot};
use rigid_ccd::glam::{DAffine3, DQuat, DVec3, EulerRot};
use rigid_ccd::{Body, InputError, Pose, trajectory};
use std::sync::Arc;
use urdf_rs::{Geometry, JointType};

/// Parses the text of a URDF file.
pub(super) fn parse(text: &str) -> Result<urdf_rs::Robot, String> {
    let urdf = urdf_rs::read_from_string(&without_materials(text)?);
    urdf.map_err(|error| error.to_string())
}

/// Makes a robot of a URDF.
pub(super) struct UrdfReader<'r> {
    pub(super) elements: BodyElements,
    pub(super) meshes: &'r MeshBodies,
    pub(super) folders: &'r SearchFolders,
}

impl UrdfReader<'_> {
    pub(super) fn robot(&self, urdf: &urdf_rs::Robot) -> Result<Robot, RobotFileError> {
        let links = urdf.links.iter().map(|link| self.link(link));
        let mut links: Vec<Link> = links.collect::<Result<_, _>>()?;
        let mut joints = Vec::new();
        for joint in &urdf.joints {
            let converted = convert_joint(joint);
            let (between, own) = converted.map_err(|error| error.with_joint_name(&joint.name))?;
            links.extend(between);
            joints.extend(own);
        }
        Ok(Robot::new(links, joints)?)
    }

    fn link(&self, link: &urdf_rs::Link) -> Result<Link, RobotFileError> {
        let elements: Vec<(&urdf_rs::Pose, &Geometry)> = match self.elements {
            BodyElements::Collision => link
                .collision
                .iter()
                .map(|c| (&c.origin, &c.geometry))
                .collect(),
            BodyElements::Visual => link
                .visual
                .iter()
                .map(|v| (&v.origin, &v.geometry))
                .collect(),
        };
        let body = |(origin, geometry)| {
            let (body, pose) = (self.body(geometry)?, convert_pose(origin)?);
            Ok(LinkBody { body, pose })
        };
        let bodies: Result<_, RobotFileError> = elements.into_iter().map(body).collect();
        Ok(Link {
            name: link.name.clone(),
            bodies: bodies.map_err(|error| error.with_link_name(&link.name))?,
        })
    }

    /// Makes the body of a box, sphere, capsule, cylinder or mesh. A URDF gives full side lengths and full heights, not
    /// halves.
    fn body(&self, geometry: &Geometry) -> Result<Arc<Body>, RobotFileError> {
        let body = match geometry {
            Geometry::Box { size } => Body::cuboid(DVec3::from_array(size.0) / 2.0)?,
            Geometry::Sphere { radius } => Body::sphere(*radius)?,
            Geometry::Capsule { radius, length } => Body::capsule(*radius, length / 2.0)?,
            Geometry::Cylinder { radius, length } => Body::cylinder(*radius, length / 2.0)?,
            Geometry::Mesh { filename, scale } => {
                let scale = scale.map_or(DVec3::ONE, |scale| DVec3::from_array(scale.0));
                let file = self.folders.find_file(filename)?;
                return self.meshes.body(file, DAffine3::from_scale(scale));
            }
        };
        Ok(Arc::new(body))
    }
}

/// Converts a joint; one with several degrees of freedom becomes several joints with links between them.
fn convert_joint(joint: &urdf_rs::Joint) -> Result<(Vec<Link>, Vec<Joint>), RobotFileError> {
    let origin = convert_pose(&joint.origin)?;
    let axis = joint.axis.xyz.0;
    let limits = joint.limit.lower..=joint.limit.upper;
    let [parent, child] = [&joint.parent.link, &joint.child.link];
    let compound = |kind: CompoundKind| {
        if joint.mimic.is_some() {
            return Err(RobotFileError::CompoundMimic);
        }
        Ok(kind.links_and_joints(&joint.name, [parent, child], origin)?)
    };
    let moved = match joint.joint_type {
        JointType::Floating => return compound(CompoundKind::Floating),
        JointType::Spherical => return compound(CompoundKind::Spherical),
        JointType::Planar => return compound(CompoundKind::Planar { normal: axis }),
        JointType::Revolute => trajectory::Joint::revolute(origin, axis)?.with_limits(limits),
        JointType::Prismatic => trajectory::Joint::prismatic(origin, axis)?.with_limits(limits),
        JointType::Continuous => trajectory::Joint::revolute(origin, axis)?,
        JointType::Fixed => trajectory::Joint::fixed(origin),
    };
    let position = match &joint.mimic {
        None => PositionRule::Independent,
        Some(mimic) => PositionRule::Follows {
            joint: mimic.joint.clone(),
            multiplier: mimic.multiplier.unwrap_or(1.0),
            offset: mimic.offset.unwrap_or(0.0),
        },
    };
    let converted = Joint {
        name: joint.name.clone(),
        parent: parent.clone(),
        child: child.clone(),
        axis_and_limits: moved,
        position_rule: position,
    };
    Ok((Vec::new(), vec![converted]))
}

/// Converts a pose of a URDF, whose roll, pitch and yaw are rotations about fixed axes: first x, then y, then z.
fn convert_pose(origin: &urdf_rs::Pose) -> Result<Pose, InputError> {
    let [roll, pitch, yaw] = origin.rpy.0;
    let turned = DQuat::from_euler(EulerRot::ZYX, yaw, pitch, roll);
    Pose::new(origin.xyz.0, turned)
}
