//! Converts a URDF into a robot.
//!
//! Unknown elements and attributes are errors, unless a list marks them as harmless.

mod element;
mod vocabulary;

use super::body_elements::BodyElements;
use super::error::RobotFileError;
use super::meshes::MeshBodies;
use super::packages::SearchFolders;
use super::parse_xml;
use super::urdf_error::UrdfError;
use crate::remark::CellRemark;
use crate::robot::{CompoundKind, Joint, Link, LinkBody, PositionRule, Robot};
use element::{Element, only, required, with_declared_prefixes};
use rigid_ccd::glam::{DAffine3, DQuat, DVec3, EulerRot};
use rigid_ccd::{Body, Pose, Remark, trajectory};
use std::sync::Arc;

/// Converts a URDF into a robot.
pub(super) struct UrdfReader<'r> {
    elements: BodyElements,
    meshes: &'r MeshBodies,
    folders: &'r SearchFolders,
    version: Version,
    remarks: Vec<CellRemark>,
}

/// A version of URDF.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Version {
    V1_0,
    /// Adds `quat_xyzw`.
    V1_1,
    /// Requires both limits.
    V1_2,
}

impl<'r> UrdfReader<'r> {
    pub(super) fn new(
        elements: BodyElements,
        meshes: &'r MeshBodies,
        folders: &'r SearchFolders,
    ) -> Self {
        UrdfReader {
            elements,
            meshes,
            folders,
            version: Version::V1_0,
            remarks: Vec::new(),
        }
    }

    /// Reads the text of a URDF. The outer error is a syntax error.
    pub(super) fn read(mut self, text: &str) -> Result<Result<Robot, RobotFileError>, String> {
        let text = with_declared_prefixes(text)?;
        let document = parse_xml(&text)?;
        Ok(Element::root(&document)
            .map_err(RobotFileError::from)
            .and_then(|root| self.robot(&root)))
    }

    fn robot(&mut self, root: &Element<'_>) -> Result<Robot, RobotFileError> {
        self.version = Version::of_root(root)?;
        let (mut links, mut joints) = (Vec::new(), Vec::new());
        for element in root.children(&mut self.remarks)? {
            let name = element.required("name")?;
            if element.name() == "link" {
                let link = self.link(&element, name);
                links.push(link.map_err(|error| error.within("link", name))?);
            } else {
                let joint = self.joint(&element, name);
                joints.push(joint.map_err(|error| error.within("joint", name))?);
            }
        }
        let mut all_joints = Vec::new();
        for (added_links, added_joints) in joints {
            links.extend(added_links);
            all_joints.extend(added_joints);
        }
        Ok(Robot::new(links, all_joints)?.with_file_remarks(std::mem::take(&mut self.remarks)))
    }

    fn link(&mut self, element: &Element<'_>, name: &str) -> Result<Link, RobotFileError> {
        let body_element = match self.elements {
            BodyElements::Collision => "collision",
            BodyElements::Visual => "visual",
        };
        let mut bodies = Vec::new();
        for shape in element.children(&mut self.remarks)? {
            if shape.name() != body_element {
                continue;
            }
            let children = shape.children(&mut self.remarks)?;
            let pose = self.pose(&children, &format!("link {name}"))?;
            let geometry = required(&children, "geometry")?;
            let body = self.body(geometry)?;
            bodies.push(LinkBody { body, pose });
        }
        Ok(Link {
            bodies,
            ..Link::named(name)
        })
    }

    /// Creates the body of a box, sphere, capsule, cylinder or mesh. URDF gives full side lengths and heights.
    fn body(&mut self, geometry: &Element<'_>) -> Result<Arc<Body>, RobotFileError> {
        let shapes = geometry.children(&mut self.remarks)?;
        let [shape] = &shapes[..] else {
            return Err(match shapes.get(1) {
                Some(second) => UrdfError::RepeatedElement {
                    element: format!("{} in geometry", second.name()),
                },
                None => UrdfError::MissingElement {
                    element: "box, capsule, cylinder, mesh or sphere in geometry".to_owned(),
                },
            }
            .into());
        };
        let body = match shape.name() {
            "box" => {
                shape.required("size")?;
                let size = shape.numbers("size")?.unwrap_or([f64::NAN; 3]);
                Body::cuboid(DVec3::from_array(size) / 2.0)?
            }
            "sphere" => Body::sphere(shape.number("radius")?)?,
            "capsule" => Body::capsule(shape.number("radius")?, shape.number("length")? / 2.0)?,
            "cylinder" => Body::cylinder(shape.number("radius")?, shape.number("length")? / 2.0)?,
            _ => {
                let scale = shape
                    .numbers("scale")?
                    .map_or(DVec3::ONE, DVec3::from_array);
                let file = self.folders.find_file(shape.required("filename")?)?;
                return self.meshes.body(file, DAffine3::from_scale(scale));
            }
        };
        Ok(Arc::new(body))
    }

    /// Converts a joint. A joint with several degrees of freedom becomes a chain of joints, with links between them.
    fn joint(
        &mut self,
        element: &Element<'_>,
        name: &str,
    ) -> Result<(Vec<Link>, Vec<Joint>), RobotFileError> {
        let children = element.children(&mut self.remarks)?;
        let origin = self.pose(&children, &format!("joint {name}"))?;
        let [parent, child] =
            ["parent", "child"].map(|end| required(&children, end)?.required("link"));
        let (parent, child) = (parent?, child?);
        let mimic = only(&children, "mimic")?;
        let compound = |kind: CompoundKind| {
            if mimic.is_some() {
                return Err(RobotFileError::CompoundMimic);
            }
            Ok(kind.links_and_joints(name, [parent, child], origin)?)
        };
        let axis = || -> Result<[f64; 3], UrdfError> {
            let Some(axis) = only(&children, "axis")? else {
                return Ok([1.0, 0.0, 0.0]);
            };
            axis.required("xyz")?;
            Ok(axis.numbers("xyz")?.unwrap_or([f64::NAN; 3]))
        };
        let geometry = match element.required("type")? {
            "floating" => return compound(CompoundKind::Floating),
            "spherical" => return compound(CompoundKind::Spherical),
            "planar" => return compound(CompoundKind::Planar { normal: axis()? }),
            "fixed" => trajectory::Joint::fixed(origin),
            "continuous" => trajectory::Joint::revolute(origin, axis()?)?,
            "revolute" => {
                let [low, high] = self.limits(&children)?;
                let remark = [low, high].into_iter().find_map(Remark::remark_on_joint);
                self.remarks
                    .extend(remark.map(|remark| CellRemark::on(format!("joint {name}"), remark)));
                trajectory::Joint::revolute(origin, axis()?)?.with_limits(low..=high)
            }
            "prismatic" => {
                let [low, high] = self.limits(&children)?;
                trajectory::Joint::prismatic(origin, axis()?)?.with_limits(low..=high)
            }
            _ => {
                let joint_types =
                    "revolute, continuous, prismatic, fixed, floating, planar or spherical";
                return Err(element.invalid("type", joint_types).into());
            }
        };
        let joint = Joint {
            name: name.to_owned(),
            parent: parent.to_owned(),
            child: child.to_owned(),
            geometry,
            position_rule: position_rule(mimic)?,
        };
        Ok((Vec::new(), vec![joint]))
    }

    /// Reads the limits of a joint. The limits of a mimic joint are ignored.
    fn limits(&self, children: &[Element<'_>]) -> Result<[f64; 2], UrdfError> {
        let limit = match only(children, "limit")? {
            Some(limit) => limit,
            None if only(children, "mimic")?.is_some() => return Ok([0.0; 2]),
            None => required(children, "limit")?,
        };
        if self.version >= Version::V1_2 {
            limit.required("lower")?;
            limit.required("upper")?;
        }
        let [low] = limit.numbers("lower")?.unwrap_or([0.0]);
        let [high] = limit.numbers("upper")?.unwrap_or([0.0]);
        Ok([low, high])
    }

    /// Reads the pose of a shape or joint, for which `owner` names the link or joint in remarks. Roll, pitch and yaw
    /// are rotations about fixed axes: first x, then y, then z.
    fn pose(&mut self, children: &[Element<'_>], owner: &str) -> Result<Pose, RobotFileError> {
        let Some(origin) = only(children, "origin")? else {
            return Ok(Pose::IDENTITY);
        };
        let position = origin.numbers("xyz")?.unwrap_or([0.0; 3]);
        let angles = origin.numbers("rpy")?;
        let rotation = match (angles, origin.numbers("quat_xyzw")?) {
            (None, None) => DQuat::IDENTITY,
            (Some([roll, pitch, yaw]), None) => {
                let remark = Remark::remark_on_roll_pitch_yaw([roll, pitch, yaw]);
                self.remarks
                    .extend(remark.map(|remark| CellRemark::on(owner, remark)));
                DQuat::from_euler(EulerRot::ZYX, yaw, pitch, roll)
            }
            (_, Some(_)) if self.version < Version::V1_1 => {
                return Err(UrdfError::LaterVersion {
                    element: "origin".to_owned(),
                    attribute: "quat_xyzw".to_owned(),
                    version: "1.1",
                }
                .into());
            }
            (None, Some([x, y, z, w])) if [x, y, z, w] != [0.0; 4] => DQuat::from_xyzw(x, y, z, w),
            (None, Some(_)) => return Err(origin.invalid("quat_xyzw", "a rotation").into()),
            (Some(_), Some(_)) => {
                return Err(origin.invalid("quat_xyzw", "allowed beside rpy").into());
            }
        };
        Ok(Pose::new(position, rotation)?)
    }
}

fn position_rule(mimic: Option<&Element<'_>>) -> Result<PositionRule, UrdfError> {
    let Some(mimic) = mimic else {
        return Ok(PositionRule::Independent);
    };
    let [multiplier] = mimic.numbers("multiplier")?.unwrap_or([1.0]);
    let [offset] = mimic.numbers("offset")?.unwrap_or([0.0]);
    Ok(PositionRule::Follows {
        joint: mimic.required("joint")?.to_owned(),
        multiplier,
        offset,
    })
}

impl Version {
    fn of_root(root: &Element<'_>) -> Result<Self, UrdfError> {
        match root.get("version") {
            None | Some("1.0") => Ok(Version::V1_0),
            Some("1.1") => Ok(Version::V1_1),
            Some("1.2") => Ok(Version::V1_2),
            Some(version) => Err(UrdfError::UnknownVersion {
                version: version.to_owned(),
            }),
        }
    }
}

#[cfg(test)]
mod tests;
