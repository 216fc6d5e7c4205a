//! Reads a robot from a URDF file and from the mesh files that the URDF names.

mod bodies;
mod error;
mod materials;
mod packages;

pub use bodies::MeshConversion;
pub use error::UrdfError;

use crate::pairs::{LinkPairs, SkipReason};
use crate::robot::{CompoundKind, Joint, Link, LinkBody, PositionRule, Robot};
use crate::srdf::disabled_and_enabled_pairs;
use bodies::BodyReader;
use materials::without_materials;
use packages::SearchFolders;
use rigid_ccd::glam::{DQuat, EulerRot};
use rigid_ccd::{InputError, Pose, trajectory};
use std::fs;
use std::path::{Path, PathBuf};
use urdf_rs::JointType;

/// A URDF file to read, with the choice of how its links become bodies.
///
/// ```
/// use rigid_ccd_robot::{MeshConversion, Urdf};
/// # let text = "<robot name='door'><link name='frame'/><link name='leaf'><collision>
/// #     <geometry><box size='0.8 0.04 2'/></geometry></collision></link>
/// #     <joint name='hinge' type='revolute'><parent link='frame'/><child link='leaf'/>
/// #     <axis xyz='0 0 1'/><limit lower='0' upper='1.5' effort='1' velocity='1'/></joint></robot>";
/// # let folder = tempfile::tempdir()?;
/// # std::fs::write(folder.path().join("door.urdf"), text)?;
/// # std::env::set_current_dir(&folder)?;
/// let urdf = Urdf::from_path("door.urdf").with_mesh_conversion(MeshConversion::OuterHull);
/// let robot = urdf.read()?;
/// let pairs = urdf.link_pairs(&robot, None)?;
/// assert_eq!(robot.limits().collect::<Vec<_>>(), [[0.0, 1.5]]);
/// assert_eq!(pairs.checked_pairs().count(), 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Urdf {
    path: PathBuf,
    /// The text of the file, if it is not read from the path.
    text: Option<String>,
    search_folders: SearchFolders,
    body_elements: BodyElements,
    mesh_conversion: MeshConversion,
}

/// The kind of XML elements of a URDF's links that become bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BodyElements {
    /// The elements `collision` of each link: the shapes for collision checks.
    #[default]
    Collision,
    /// The elements `visual` of each link: the shapes for drawing.
    Visual,
}

impl Urdf {
    /// Names the URDF file to read. Its links become exact bodies of the elements `collision`. Packages are searched
    /// for in the folders of `ROS_PACKAGE_PATH` and `AMENT_PREFIX_PATH`, then in the folders above the file.
    pub fn from_path(path: impl Into<PathBuf>) -> Self {
        let path = path.into();
        Urdf {
            search_folders: SearchFolders::for_urdf(&path),
            path,
            text: None,
            body_elements: BodyElements::default(),
            mesh_conversion: MeshConversion::default(),
        }
    }

    /// Takes the text of a URDF file that is not read. Meshes are found and messages are written as if it were at a path.
    ///
    /// ```
    /// use rigid_ccd_robot::Urdf;
    /// let robot = Urdf::from_text("<robot name='stone'><link name='base'/></robot>", "stone.urdf").read()?;
    /// assert_eq!(robot.links().len(), 1);
    /// # Ok::<(), rigid_ccd_robot::UrdfError>(())
    /// ```
    pub fn from_text(text: impl Into<String>, path: impl Into<PathBuf>) -> Self {
        Urdf {
            text: Some(text.into()),
            ..Urdf::from_path(path)
        }
    }

    /// Adds a folder that is searched first for `package://` names. The folder is a package, or holds packages.
    #[must_use]
    pub fn with_package_folder(mut self, folder: impl Into<PathBuf>) -> Self {
        self.search_folders.prepend_folder(folder.into());
        self
    }

    /// Sets whether the `collision` or the `visual` elements of links become bodies.
    #[must_use]
    pub fn with_body_element_kind(self, geometry: BodyElements) -> Self {
        Urdf {
            body_elements: geometry,
            ..self
        }
    }

    /// Sets whether a mesh becomes exact pieces or its convex hull.
    #[must_use]
    pub fn with_mesh_conversion(self, meshes: MeshConversion) -> Self {
        Urdf {
            mesh_conversion: meshes,
            ..self
        }
    }

    /// Reads the URDF file and its meshes, and builds the robot.
    ///
    /// A cylinder becomes a polytope that encloses it; see [`Body::excess`](rigid_ccd::Body::excess). A floating, planar or
    /// spherical joint becomes a chain of joints, see [`CompoundKind`].
    ///
    /// # Errors
    /// [`UrdfError`] with the link or the joint, and with the file of a mesh.
    pub fn read(&self) -> Result<Robot, UrdfError> {
        let text = match &self.text {
            Some(text) => text,
            None => &read(&self.path)?,
        };
        let urdf = urdf_rs::read_from_string(&without_materials(text)).map_err(|error| {
            UrdfError::Syntax {
                file: self.path.clone(),
                error: error.to_string(),
            }
        })?;
        let reader = BodyReader::new(&self.search_folders, self.mesh_conversion);
        let links = urdf.links.iter().map(|link| self.link(&reader, link));
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

    /// Returns which pairs of links are checked: all pairs except neighbours, links that never move relative to each
    /// other, and pairs that the SRDF file disables; those that it enables are checked.
    ///
    /// # Errors
    /// [`UrdfError`] if the file cannot be read, or names a link that the robot does not have.
    pub fn link_pairs(&self, robot: &Robot, srdf: Option<&Path>) -> Result<LinkPairs, UrdfError> {
        let mut pairs = LinkPairs::from_robot(robot);
        if let Some(file) = srdf {
            let pairs_of_file = disabled_and_enabled_pairs(&read(file)?);
            let [disabled, enabled] = pairs_of_file.map_err(|error| UrdfError::Syntax {
                file: file.to_owned(),
                error: error.to_string(),
            })?;
            for pair in disabled {
                let [one, other] = [&pair.link1, &pair.link2].map(|link| robot.link_number(link));
                pairs.skip(one?, other?, SkipReason::Disabled(pair.reason));
            }
            for pair in enabled {
                let [one, other] = [&pair.link1, &pair.link2].map(|link| robot.link_number(link));
                pairs.include(one?, other?);
            }
        }
        Ok(pairs)
    }

    fn link(&self, reader: &BodyReader<'_>, link: &urdf_rs::Link) -> Result<Link, UrdfError> {
        let elements: Vec<(&urdf_rs::Pose, &urdf_rs::Geometry)> = match self.body_elements {
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
            let (body, pose) = (reader.body(geometry)?, convert_pose(origin)?);
            Ok(LinkBody { body, pose })
        };
        let bodies: Result<_, UrdfError> = elements.into_iter().map(body).collect();
        Ok(Link {
            name: link.name.clone(),
            bodies: bodies.map_err(|error| error.with_link_name(&link.name))?,
        })
    }
}

fn read(file: &Path) -> Result<String, UrdfError> {
    fs::read_to_string(file).map_err(|error| UrdfError::Unreadable {
        file: file.to_owned(),
        error: error.to_string(),
    })
}

/// Converts a joint; one with several degrees of freedom becomes several joints with links between them.
fn convert_joint(joint: &urdf_rs::Joint) -> Result<(Vec<Link>, Vec<Joint>), UrdfError> {
    let origin = convert_pose(&joint.origin)?;
    let axis = joint.axis.xyz.0;
    let limits = joint.limit.lower..=joint.limit.upper;
    let [parent, child] = [&joint.parent.link, &joint.child.link];
    let compound = |kind: CompoundKind| {
        if joint.mimic.is_some() {
            return Err(UrdfError::CompoundMimic);
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

#[cfg(test)]
mod tests;
