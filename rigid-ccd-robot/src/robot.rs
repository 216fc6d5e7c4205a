//! A robot: a tree of links, connected by joints.

mod chain_between;
mod compound_joint;
mod tree;

pub use chain_between::ChainBetween;
pub use compound_joint::CompoundKind;

use crate::error::RobotError;
use crate::remark::CellRemark;
use ccd_core::double_double::DoubleDouble;
use ccd_core::limits::MAX_COORDINATE;
use rigid_ccd::trajectory::{self, Chain};
use rigid_ccd::{Body, InputError, Pose};
use std::sync::Arc;
use tree::Tree;

/// A robot: a tree of links, connected by joints.
///
/// A *configuration* has one position for each independent joint: an angle in radians for a revolute joint, a length for
/// a prismatic joint. Fixed joints and joints that follow another joint are not independent. The positions have the
/// order of [`Robot::independent_joint_names`], which is the order of the joints in [`Robot::new`].
#[derive(Clone, Debug)]
pub struct Robot {
    name: String,
    links: Vec<Link>,
    joints: Vec<Joint>,
    tree: Tree,
    /// For each joint, the rule that computes its position from a configuration; `None` for a fixed joint.
    position_sources: Vec<Option<PositionSource>>,
    /// The indices of the independent joints, in the order of a configuration.
    independent_joints: Vec<usize>,
    /// For each link, the link nearest to the base among the links that are connected to it by fixed joints only.
    rigid_roots: Vec<usize>,
    /// Remarks on the file from which the robot was read.
    file_remarks: Vec<CellRemark>,
}

/// A link of a robot: a frame, and the bodies fixed to it.
#[derive(Clone, Debug)]
pub struct Link {
    /// The name, unique among the links of the robot.
    pub name: String,
    /// The bodies that are fixed to the link.
    pub bodies: Vec<LinkBody>,
    /// Half-spaces of a static link. Each is the half-space below the plane `z = 0` of a frame, which has this pose in
    /// the link's frame.
    pub planes: Vec<Pose>,
}

/// A body that is fixed to a link.
#[derive(Clone, Debug)]
pub struct LinkBody {
    /// The body. Clones of the link share it.
    pub body: Arc<Body>,
    /// The pose of the body in the link's frame.
    pub pose: Pose,
}

/// A joint of a robot, which connects a parent link to a child link.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The name, unique among the joints of the robot.
    pub name: String,
    /// The name of the parent link.
    pub parent: String,
    /// The name of the child link, which the joint moves.
    pub child: String,
    /// The joint's origin in the frame of the parent link, its axis and its limits.
    pub geometry: trajectory::Joint,
    /// The source of the joint's position: the configuration, or another joint.
    pub position_rule: PositionRule,
}

/// The source of a joint's position: the configuration, or another joint.
#[derive(Clone, Debug, PartialEq)]
pub enum PositionRule {
    /// The configuration has a position for the joint. A fixed joint has none.
    Independent,
    /// The joint follows another joint, like `mimic` in URDF. Its position is `multiplier · position + offset`, where
    /// `position` is the position of the followed joint. Its limits are ignored.
    Follows {
        /// The name of the followed joint.
        joint: String,
        /// The multiplier.
        multiplier: f64,
        /// The position of the joint when the followed joint is at 0.
        offset: f64,
    },
}

/// The rule that computes the position of a joint from a configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PositionSource {
    /// The index in the configuration of the position that the joint depends on.
    pub(crate) position_index: usize,
    /// The factor from that position to the joint's position.
    pub(crate) multiplier: f64,
    /// The joint's position when that position is 0.
    pub(crate) offset: f64,
    /// The sum of the absolute values of the terms of `offset`.
    offset_magnitude: f64,
    /// The number of joints that are followed, one after the other, up to an independent joint.
    mimic_chain_length: u32,
}

impl PositionSource {
    /// Returns whether the multiplier is an integer. If it is, this joint makes a whole number of turns in one turn of
    /// the followed joint.
    pub(crate) fn has_integer_multiplier(&self) -> bool {
        self.multiplier.fract() == 0.0
    }

    /// Returns the position of the joint in a configuration.
    pub(crate) fn position(&self, configuration: &[f64]) -> f64 {
        let followed = configuration[self.position_index];
        if self.offset == 0.0 {
            self.multiplier * followed
        } else {
            // Rounds once, even if product and offset almost cancel.
            self.multiplier.mul_add(followed, self.offset)
        }
    }

    /// Returns a number to which the rounding error of the joint's position is proportional. It increases with the
    /// number of roundings.
    pub(crate) fn magnitude(&self, configuration: &[f64]) -> f64 {
        let product = (self.multiplier * configuration[self.position_index]).abs();
        self.magnitude_of_product(product)
    }

    /// Returns the number of [`PositionSource::magnitude`], from an upper bound of `|multiplier · position|`.
    pub(crate) fn magnitude_of_product(&self, product: f64) -> f64 {
        (product + self.offset_magnitude) * f64::from(1 + self.mimic_chain_length)
    }

    /// Converts a coefficient of the followed joint's polynomial to the coefficient of this joint's polynomial.
    pub(crate) fn polynomial_coefficient(
        &self,
        power: usize,
        followed: DoubleDouble,
    ) -> DoubleDouble {
        let product = DoubleDouble::from(self.multiplier) * followed;
        match power {
            0 => product + DoubleDouble::from(self.offset),
            _ => product,
        }
    }
}

impl Link {
    /// Creates a link without bodies.
    pub fn named(name: impl Into<String>) -> Self {
        Link {
            name: name.into(),
            bodies: Vec::new(),
            planes: Vec::new(),
        }
    }

    /// Adds a body at a pose in the link's frame.
    #[must_use]
    pub fn with_body(mut self, body: Body, pose: Pose) -> Self {
        let body = Arc::new(body);
        self.bodies.push(LinkBody { body, pose });
        self
    }

    /// Adds the half-space below the plane `z = 0` of a frame at `pose` in the link's frame. Only static links may
    /// have planes.
    #[must_use]
    pub fn with_plane(mut self, pose: Pose) -> Self {
        self.planes.push(pose);
        self
    }

    /// Returns whether the link has bodies or planes.
    pub(crate) fn has_shapes(&self) -> bool {
        !self.bodies.is_empty() || !self.planes.is_empty()
    }
}

impl Robot {
    /// Creates a robot from its links and joints, in any order.
    ///
    /// # Errors
    /// [`RobotError`] with the name of the link or joint: for repeated or unknown names, joints that do not form a
    /// tree, a reversed joint, invalid limits, and planes on a moving link.
    pub fn new(links: Vec<Link>, mut joints: Vec<Joint>) -> Result<Self, RobotError> {
        for joint in &mut joints {
            if joint.geometry.is_reversed() {
                let joint = joint.name.clone();
                return Err(RobotError::ReversedJoint { joint });
            }
            RobotError::check_pose("joint", &joint.name, joint.geometry.origin())?;
            let limits = joint.geometry.limits();
            let (low, high) = (*limits.start(), *limits.end());
            // Written so that NaN is refused.
            if !(low <= high) {
                let joint = joint.name.clone();
                return Err(RobotError::InvalidLimits { joint, low, high });
            }
            if joint.position_rule != PositionRule::Independent {
                joint.geometry = joint
                    .geometry
                    .clone()
                    .with_limits(f64::NEG_INFINITY..=f64::INFINITY);
            }
        }
        for link in &links {
            for link_body in &link.bodies {
                RobotError::check_pose("a body of link", &link.name, &link_body.pose)?;
            }
            for plane in &link.planes {
                RobotError::check_pose("a plane of link", &link.name, plane)?;
            }
        }
        let tree = Tree::new(&links, &joints)?;
        let (sources, independent_joints) = position_sources_and_independent_joints(&joints)?;
        let mut rigid_roots: Vec<usize> = (0..links.len()).collect();
        for (link, parent, joint) in tree.links_parents_first() {
            if sources[joint].is_none() {
                rigid_roots[link] = rigid_roots[parent];
            }
        }
        let is_moving = |link: &usize| rigid_roots[*link] != tree.base;
        let mut with_planes = (0..links.len()).filter(|&link| !links[link].planes.is_empty());
        if let Some(moving) = with_planes.find(is_moving) {
            let link = links[moving].name.clone();
            return Err(RobotError::MovingPlane { link });
        }
        Ok(Robot {
            rigid_roots,
            links,
            joints,
            tree,
            position_sources: sources,
            independent_joints,
            file_remarks: Vec::new(),
            name: String::new(),
        })
    }

    /// Sets the name of the robot. It is empty by default; a file sets it.
    #[must_use]
    pub fn with_name(self, name: impl Into<String>) -> Self {
        let name = name.into();
        Robot { name, ..self }
    }

    /// Returns the name of the robot; empty if it has none.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Adds remarks on the file from which the robot was read.
    pub(crate) fn with_file_remarks(
        mut self,
        remarks: impl IntoIterator<Item = CellRemark>,
    ) -> Self {
        for remark in remarks {
            remark.add_to(&mut self.file_remarks);
        }
        self
    }

    /// Returns the remarks on the file from which the robot was read.
    pub fn file_remarks(&self) -> &[CellRemark] {
        &self.file_remarks
    }

    /// Returns the links, in the order in which they were given.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// Returns the joints, in the order in which they were given.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Returns the names of the independent joints, in the order of a configuration.
    pub fn independent_joint_names(&self) -> impl ExactSizeIterator<Item = &str> {
        let joints = self.independent_joints.iter();
        joints.map(|&joint| self.joints[joint].name.as_str())
    }

    /// Returns the limits of the positions, in the order of a configuration.
    pub fn limits(&self) -> impl ExactSizeIterator<Item = [f64; 2]> {
        self.independent_joints.iter().map(|&joint| {
            let limits = self.joints[joint].geometry.limits();
            [*limits.start(), *limits.end()]
        })
    }

    /// Returns the configuration with each joint at 0, or at the limit nearest to 0.
    pub fn configuration_nearest_zero(&self) -> Vec<f64> {
        let limits = self.limits();
        // `clamp` requires ordered limits, which `Robot::new` has checked.
        limits.map(|[low, high]| 0f64.clamp(low, high)).collect()
    }

    /// Returns the index of the base, which is the only link that is not the child of a joint.
    pub fn base(&self) -> usize {
        self.tree.base
    }

    /// Returns the index in [`Robot::links`] of the link with this name.
    ///
    /// # Errors
    /// [`RobotError::NoSuchLink`].
    pub fn link_number(&self, name: &str) -> Result<usize, RobotError> {
        let index = self.links.iter().position(|link| link.name == name);
        index.ok_or_else(|| RobotError::NoSuchLink { link: name.into() })
    }

    /// Returns the pose of a link in the frame of the base.
    ///
    /// # Errors
    /// [`RobotError::NoSuchLink`], [`RobotError::WrongPositionCount`], [`RobotError::InvalidPosition`].
    pub fn pose(&self, link: &str, configuration: &[f64]) -> Result<Pose, RobotError> {
        let chain = self.chain_between(self.base(), self.link_number(link)?);
        let positions = chain.positions(self, configuration)?;
        Ok(chain
            .chain()
            .pose(chain.chain().joints().len(), &positions)?)
    }

    /// Returns the chain of joints that moves link `to` in the frame of link `from`. From `from` it leads to the nearest
    /// common ancestor through reversed joints, and from there to `to`.
    pub fn chain_between(&self, from: usize, to: usize) -> ChainBetween {
        let steps = self.tree.path_between(from, to);
        let joints = steps.iter().map(|step| {
            let joint = self.joints[step.joint].geometry.clone();
            if step.leads_to_parent {
                joint.reversed()
            } else {
                joint
            }
        });
        let chain = Chain::new(Pose::IDENTITY, joints.collect());
        ChainBetween::new(chain, steps.iter().map(|step| step.joint).collect())
    }

    /// Returns whether only fixed joints connect two links.
    pub(crate) fn are_rigidly_connected(&self, one: usize, other: usize) -> bool {
        self.rigid_roots[one] == self.rigid_roots[other]
    }

    /// Returns whether one joint connects two links.
    pub(crate) fn are_neighbours(&self, one: usize, other: usize) -> bool {
        self.parent_link(one) == Some(other) || self.parent_link(other) == Some(one)
    }

    /// Returns the index of a link's parent link; `None` for the base.
    pub(crate) fn parent_link(&self, link: usize) -> Option<usize> {
        self.tree.parent(link)
    }

    /// Returns the indices (child link, parent link, joint) of all joints. Parents come before children.
    pub fn joints_parents_first(&self) -> Vec<(usize, usize, usize)> {
        self.tree.links_parents_first()
    }

    /// Returns the rule that computes a joint's position from a configuration; `None` for a fixed joint.
    pub(crate) fn source(&self, joint: usize) -> Option<PositionSource> {
        self.position_sources[joint]
    }

    /// Checks the number of positions of a configuration, and that each is within its joint's limits.
    pub(crate) fn check_configuration(&self, configuration: &[f64]) -> Result<(), RobotError> {
        self.check_position_count(configuration.len())?;
        for (&joint, &position) in self.independent_joints.iter().zip(configuration) {
            let Joint {
                name,
                geometry: joint,
                ..
            } = &self.joints[joint];
            let is_near = position.abs() <= MAX_COORDINATE;
            let too_far = InputError::OutOfRange {
                quantity: "position",
                value: position,
                allowed: "within 1e12 of 0",
            };
            joint
                .check(position)
                .and(is_near.then_some(()).ok_or(too_far))
                .map_err(|error| RobotError::InvalidPosition {
                    joint: name.clone(),
                    error,
                })?;
        }
        Ok(())
    }

    /// Iterates over the rules that compute the positions of the moving joints.
    pub(crate) fn position_sources(&self) -> impl Iterator<Item = PositionSource> {
        self.position_sources.iter().copied().flatten()
    }

    /// Checks the number of positions of a configuration.
    pub(crate) fn check_position_count(&self, count: usize) -> Result<(), RobotError> {
        let expected = self.independent_joints.len();
        if count == expected {
            return Ok(());
        }
        Err(RobotError::WrongPositionCount {
            given_count: count,
            expected_count: expected,
            joint_names: self
                .independent_joint_names()
                .collect::<Vec<_>>()
                .join(", "),
        })
    }

    /// Returns the positions of all joints at a configuration, in the order of [`Robot::joints`]; 0 for a fixed joint.
    ///
    /// # Errors
    /// [`RobotError::WrongPositionCount`].
    pub fn joint_positions(&self, configuration: &[f64]) -> Result<Vec<f64>, RobotError> {
        self.check_position_count(configuration.len())?;
        let joints = 0..self.joints.len();
        Ok(joints
            .map(|joint| self.position(joint, configuration))
            .collect())
    }

    /// Returns the position of a joint at a configuration; 0 for a fixed joint.
    fn position(&self, joint: usize, configuration: &[f64]) -> f64 {
        self.position_sources[joint].map_or(0.0, |source| source.position(configuration))
    }
}

/// Returns the rule that computes each joint's position from a configuration, and the indices of the independent joints.
fn position_sources_and_independent_joints(
    joints: &[Joint],
) -> Result<(Vec<Option<PositionSource>>, Vec<usize>), RobotError> {
    let is_independent = |joint: &Joint| {
        joint.position_rule == PositionRule::Independent && !joint.geometry.is_fixed()
    };
    let independent_joints: Vec<usize> = (0..joints.len())
        .filter(|&k| is_independent(&joints[k]))
        .collect();
    let sources = joints.iter().map(|joint| {
        if joint.geometry.is_fixed() {
            return Ok(None);
        }
        let (mut multiplier, mut offset, mut followed) = (1.0, 0.0, joint);
        let mut offset_magnitude = 0.0;
        // A chain of followed joints that is longer than the number of joints contains a loop.
        for follow_count in 0..=joints.len() as u32 {
            match &followed.position_rule {
                PositionRule::Independent => {
                    let position_index = independent_joints
                        .iter()
                        .position(|&k| joints[k].name == followed.name);
                    return position_index
                        .map(|position_index| {
                            Some(PositionSource {
                                position_index,
                                multiplier,
                                offset,
                                offset_magnitude,
                                mimic_chain_length: follow_count,
                            })
                        })
                        .ok_or_else(|| unfollowable_joint_error(joint, &followed.name));
                }
                PositionRule::Follows {
                    joint: leader,
                    multiplier: next_multiplier,
                    offset: next_offset,
                } => {
                    if !(next_multiplier.is_finite() && next_offset.is_finite()) {
                        let quantity = "the multiplier or the offset";
                        let error = InputError::NotFinite { quantity };
                        let joint = followed.name.clone();
                        return Err(RobotError::InvalidPosition { joint, error });
                    }
                    offset += multiplier * next_offset;
                    offset_magnitude += f64::abs(multiplier * next_offset);
                    multiplier *= next_multiplier;
                    let found = joints.iter().find(|other| other.name == *leader);
                    followed = found.ok_or_else(|| RobotError::NoSuchMimicJoint {
                        joint: followed.name.clone(),
                        followed_joint: leader.clone(),
                    })?;
                }
            }
        }
        Err(unfollowable_joint_error(joint, &followed.name))
    });
    Ok((sources.collect::<Result<_, _>>()?, independent_joints))
}

fn unfollowable_joint_error(joint: &Joint, followed: &str) -> RobotError {
    RobotError::InvalidMimicJoint {
        joint: joint.name.clone(),
        followed_joint: followed.to_owned(),
    }
}

#[cfg(test)]
mod tests;
