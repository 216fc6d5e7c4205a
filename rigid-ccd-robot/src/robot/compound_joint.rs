//! Expands joints with several degrees of freedom into chains of joints with one each.

use super::{Joint, Link, PositionRule};
use rigid_ccd::glam::DVec3;
use rigid_ccd::{InputError, Pose, trajectory};

/// A kind of joint with several degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CompoundKind {
    /// Translation in a plane and rotation about its normal: the positions `x`, `y` and `yaw`.
    Planar {
        /// The normal of the plane, in the joint's frame. If the normal is z, `x` and `y` are along the frame's axes.
        /// In a URDF the normal is the joint's axis, which is x by default. Some other programs always use z.
        normal: [f64; 3],
    },
    /// Free motion: the positions `x`, `y`, `z`, `yaw`, `pitch` and `roll`.
    Floating,
    /// Rotation about a point: the positions `yaw`, `pitch` and `roll`.
    Spherical,
}

impl CompoundKind {
    /// Creates the joints, and the links between them, that connect a child link to its parent.
    ///
    /// A joint `drive` becomes the independent joints `drive/x`, `drive/y` and so on, without limits. Rotations are by
    /// yaw about z, then by pitch about the rotated y, then by roll about the rotated x, as in URDF. Between two
    /// configurations each angle changes at a constant rate. Each link between two joints has the name of the joint
    /// before it, and no bodies. Parent and child are not adjacent because of these links, so their pair is checked.
    ///
    /// # Errors
    /// [`InputError`] for a normal that is not finite, or has no length.
    ///
    /// ```
    /// use rigid_ccd_robot::{CompoundKind, Link, Robot};
    /// use rigid_ccd::Pose;
    /// let drive = CompoundKind::Planar { normal: [0.0, 0.0, 1.0] };
    /// let (mut links, joints) = drive.links_and_joints("drive", ["floor", "cart"], Pose::IDENTITY)?;
    /// links.extend(["floor", "cart"].map(Link::named));
    /// let cart = Robot::new(links, joints)?;
    /// assert_eq!(cart.independent_joint_names().collect::<Vec<_>>(), ["drive/x", "drive/y", "drive/yaw"]);
    /// assert_eq!(cart.pose("cart", &[3.0, 4.0, 0.0])?.translation().to_array(), [3.0, 4.0, 0.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn links_and_joints(
        self,
        joint: &str,
        [parent, child]: [&str; 2],
        origin: Pose,
    ) -> Result<(Vec<Link>, Vec<Joint>), InputError> {
        let slide = |axis: DVec3| (false, axis);
        let turn = |axis: DVec3| (true, axis);
        let rotations = [
            ("yaw", turn(DVec3::Z)),
            ("pitch", turn(DVec3::Y)),
            ("roll", turn(DVec3::X)),
        ];
        let slides = [
            ("x", slide(DVec3::X)),
            ("y", slide(DVec3::Y)),
            ("z", slide(DVec3::Z)),
        ];
        let degrees_of_freedom = match self {
            CompoundKind::Spherical => rotations.to_vec(),
            CompoundKind::Floating => [slides, rotations].concat(),
            CompoundKind::Planar { normal } => {
                // Normalises the axis and checks it.
                let axis = match trajectory::Joint::revolute(Pose::IDENTITY, normal)?.kind() {
                    trajectory::JointKind::Revolute(axis) => axis,
                    _ => DVec3::Z,
                };
                // For z, the two axes are x and y.
                let in_plane = if axis.y.abs() < 0.9 {
                    DVec3::Y
                } else {
                    DVec3::X
                };
                let x = in_plane.cross(axis);
                vec![
                    ("x", slide(x)),
                    ("y", slide(axis.cross(x))),
                    ("yaw", turn(axis)),
                ]
            }
        };
        let names: Vec<String> = degrees_of_freedom
            .iter()
            .map(|(suffix, _)| format!("{joint}/{suffix}"))
            .collect();
        let last = names.len() - 1;
        let joints = degrees_of_freedom
            .iter()
            .enumerate()
            .map(|(k, &(_, (is_rotation, axis)))| {
                let origin = if k == 0 { origin } else { Pose::IDENTITY };
                let geometry = if is_rotation {
                    trajectory::Joint::revolute(origin, axis.to_array())?
                } else {
                    trajectory::Joint::prismatic(origin, axis.to_array())?
                };
                Ok(Joint {
                    name: names[k].clone(),
                    parent: if k == 0 { parent } else { &names[k - 1] }.to_owned(),
                    child: if k == last { child } else { &names[k] }.to_owned(),
                    geometry,
                    position_rule: PositionRule::Independent,
                })
            });
        let links = names[..last].iter().map(Link::named).collect();
        Ok((links, joints.collect::<Result<_, InputError>>()?))
    }
}
