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

/// A tree of links and joints. Each joint holds one link on another.
///
/// A *configuration* has one position for each joint that has a position of its own: in radians for joints that turn, a
/// length for those that slide. Fixed joints have none, and joints that follow another one neither. Positions are in the
/// order of [`Robot::free_joint_names`], which is that in which joints were given.
#[derive(Clone, Debug)]
pub struct Robot {
    name: String,
    links: Vec<Link>,
    joints: Vec<Joint>,
    tree: Tree,
    /// For each joint, the rule by which its position is computed from a configuration; `None` for a fixed joint.
    position_sources: Vec<Option<PositionSource>>,
    /// The numbers of the joints with a position of their own, in the order of a configuration.
    free_joints: Vec<usize>,
    /// For each link, the link nearest to the base from which only fixed joints lead to it.
    rigid_roots: Vec<usize>,
    /// The remarks on the file that the robot is from.
    file_remarks: Vec<CellRemark>,
}

/// A link of a robot: a frame, with the bodies that are fixed in it.
#[derive(Clone, Debug)]
pub struct Link {
    /// The name of the link, which no other link of the robot has.
    pub name: String,
    /// The bodies that are fixed in the link's frame.
    pub bodies: Vec<LinkBody>,
    /// Half-spaces of a link that no joint moves: of each the pose in the link's frame of a frame in which it is below `z = 0`.
    pub planes: Vec<Pose>,
}

/// A body that is fixed in the frame of a link.
#[derive(Clone, Debug)]
pub struct LinkBody {
    /// The body, which clones of the link share.
    pub body: Arc<Body>,
    /// The pose of the body in the link's frame.
    pub pose: Pose,
}

/// A joint of a robot, which connects a child link to its parent link.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The name of the joint, which no other joint of the robot has.
    pub name: String,
    /// The name of the link that holds the joint.
    pub parent: String,
    /// The name of the link that the joint moves.
    pub child: String,
    /// The axis and the limits of the joint, in the frame of the parent.
    pub axis_and_limits: trajectory::Joint,
    /// The source of the joint's position: the configuration, or another joint.
    pub position_rule: PositionRule,
}

/// The source of a joint's position: the configuration, or another joint.
#[derive(Clone, Debug, PartialEq)]
pub enum PositionRule {
    /// The configuration has a position for the joint, unless the joint is fixed.
    Independent,
    /// The joint follows another joint, as `mimic` of URDF. Its position is `multiplier · position + offset`; limits of
    /// its own do not count.
    Follows {
        /// The name of the followed joint.
        joint: String,
        /// The factor on the followed joint's position.
        multiplier: f64,
        /// The position of the joint when the followed joint is at 0.
        offset: f64,
    },
}

/// The rule by which a joint's position is computed from a configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PositionSource {
    /// The index of a position in the configuration, from which the joint's position is computed.
    position_index: usize,
    multiplier: f64,
    offset: f64,
    /// The sum of the absolute values of all offsets that add to `offset`.
    offset_magnitude: f64,
    /// The number of joints from the joint to the one with a position of its own.
    mimic_chain_length: u32,
}

impl PositionSource {
    /// Returns the index of the position in a configuration.
    pub(crate) fn position_index(&self) -> usize {
        self.position_index
    }

    /// Returns the factor from the position in a configuration to that of the joint.
    pub(crate) fn factor(&self) -> f64 {
        self.multiplier
    }

    /// Returns the position of the joint when the position in a configuration is 0.
    pub(crate) fn offset(&self) -> f64 {
        self.offset
    }

    /// Returns whether the factor is a whole number. While the position in the configuration makes one turn, the joint
    /// then makes a whole number of turns.
    pub(crate) fn has_integer_multiplier(&self) -> bool {
        self.multiplier.fract() == 0.0
    }

    /// Returns the position of the joint in a configuration.
    pub(crate) fn position(&self, configuration: &[f64]) -> f64 {
        let followed = configuration[self.position_index];
        if self.offset == 0.0 {
            self.multiplier * followed
        } else {
            // Rounded once, also if product and offset cancel.
            self.multiplier.mul_add(followed, self.offset)
        }
    }

    /// Returns a bound of the numbers of which the position of the joint is computed, more the more often it is rounded.
    pub(crate) fn magnitude(&self, configuration: &[f64]) -> f64 {
        let moved = (self.multiplier * configuration[self.position_index]).abs();
        self.magnitude_of_product(moved)
    }

    /// Returns the same for a bound of the absolute value of the product with the factor.
    pub(crate) fn magnitude_of_product(&self, moved: f64) -> f64 {
        (moved + self.offset_magnitude) * f64::from(1 + self.mimic_chain_length)
    }

    /// Returns one coefficient of the joint's position as a polynomial, from that of the position in the configuration.
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

    /// Adds the half-space below the plane `z = 0` of a frame at a pose in the link's frame. Only a link that no joint moves has
    /// planes.
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
    /// [`RobotError`] with the link or the joint, if names are not unique or unknown, the joints form no tree, a
    /// joint is reversed, or a joint moves a link with planes.
    pub fn new(links: Vec<Link>, mut joints: Vec<Joint>) -> Result<Self, RobotError> {
        for joint in &mut joints {
            if joint.axis_and_limits.is_reversed() {
                let joint = joint.name.clone();
                return Err(RobotError::ReversedJoint { joint });
            }
            RobotError::check_pose("joint", &joint.name, joint.axis_and_limits.origin())?;
            let limits = joint.axis_and_limits.limits();
            let (low, high) = (*limits.start(), *limits.end());
            // Written so that NaN is refused.
            if !(low <= high) {
                let joint = joint.name.clone();
                return Err(RobotError::InvalidLimits { joint, low, high });
            }
            if joint.position_rule != PositionRule::Independent {
                joint.axis_and_limits = joint
                    .axis_and_limits
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
        let (sources, free_joints) = position_sources_and_free_joints(&joints)?;
        let mut rigid_roots: Vec<usize> = (0..links.len()).collect();
        for (link, parent, joint) in tree.links_parents_first() {
            if sources[joint].is_none() {
                rigid_roots[link] = rigid_roots[parent];
            }
        }
        let moves = |link: &usize| rigid_roots[*link] != tree.base();
        let mut with_planes = (0..links.len()).filter(|&link| !links[link].planes.is_empty());
        if let Some(moving) = with_planes.find(moves) {
            let link = links[moving].name.clone();
            return Err(RobotError::MovingPlane { link });
        }
        Ok(Robot {
            rigid_roots,
            links,
            joints,
            tree,
            position_sources: sources,
            free_joints,
            file_remarks: Vec::new(),
            name: String::new(),
        })
    }

    /// Gives the robot a name. A file has one; without a file it is empty.
    #[must_use]
    pub fn with_name(self, name: impl Into<String>) -> Self {
        let name = name.into();
        Robot { name, ..self }
    }

    /// Returns the name of the robot; empty if it has none.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Adds remarks on the file that the robot is from.
    pub(crate) fn with_file_remarks(
        mut self,
        remarks: impl IntoIterator<Item = CellRemark>,
    ) -> Self {
        for remark in remarks {
            remark.add_to(&mut self.file_remarks);
        }
        self
    }

    /// Returns the remarks on the file that the robot is from.
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

    /// Returns the names of the joints that have a position of their own, in the order of a configuration.
    pub fn free_joint_names(&self) -> impl ExactSizeIterator<Item = &str> {
        let free = self.free_joints.iter();
        free.map(|&joint| self.joints[joint].name.as_str())
    }

    /// Returns the limits of the positions, in the order of a configuration.
    pub fn limits(&self) -> impl ExactSizeIterator<Item = [f64; 2]> {
        self.free_joints.iter().map(|&joint| {
            let limits = self.joints[joint].axis_and_limits.limits();
            [*limits.start(), *limits.end()]
        })
    }

    /// Returns the configuration in which each joint is at 0 or, if that is outside of its limits, at the limit nearest to 0.
    pub fn configuration_nearest_zero(&self) -> Vec<f64> {
        let limits = self.limits();
        // The lower limit is not above the upper one.
        limits.map(|[low, high]| 0f64.clamp(low, high)).collect()
    }

    /// Returns the number of the base, which is the link that no joint moves.
    pub fn base(&self) -> usize {
        self.tree.base()
    }

    /// Returns the number of the link that has the given name.
    ///
    /// # Errors
    /// [`RobotError::NoSuchLink`].
    pub fn link_number(&self, name: &str) -> Result<usize, RobotError> {
        let number = self.links.iter().position(|link| link.name == name);
        number.ok_or_else(|| RobotError::NoSuchLink { link: name.into() })
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

    /// Returns the chain of joints by which link number `to` moves in the frame of link number `from`. It leads up to
    /// their common ancestor, through reversed joints, and down again.
    pub fn chain_between(&self, from: usize, to: usize) -> ChainBetween {
        let steps = self.tree.path_between(from, to);
        let joints = steps.iter().map(|step| {
            let joint = self.joints[step.joint].axis_and_limits.clone();
            if step.leads_to_parent {
                joint.reversed()
            } else {
                joint
            }
        });
        let chain = Chain::new(Pose::IDENTITY, joints.collect());
        ChainBetween::new(chain, steps.iter().map(|step| step.joint).collect())
    }

    /// Returns whether only fixed joints are between two links, so that neither moves in the frame of the other.
    pub(crate) fn are_rigidly_connected(&self, one: usize, other: usize) -> bool {
        self.rigid_roots[one] == self.rigid_roots[other]
    }

    /// Returns whether a joint connects two links directly.
    pub(crate) fn are_neighbours(&self, one: usize, other: usize) -> bool {
        self.parent_link(one) == Some(other) || self.parent_link(other) == Some(one)
    }

    /// Returns the number of a link's parent link; `None` for the base.
    pub(crate) fn parent_link(&self, link: usize) -> Option<usize> {
        self.tree.parent(link)
    }

    /// Returns the numbers of the links that a joint holds, each with those of the link that carries the joint, and of the
    /// joint. Links come after those nearer to the base.
    pub fn joints_parents_first(&self) -> Vec<(usize, usize, usize)> {
        self.tree.links_parents_first()
    }

    /// Returns how the position of a joint comes from a configuration; `None` for a fixed one.
    pub(crate) fn source(&self, joint: usize) -> Option<PositionSource> {
        self.position_sources[joint]
    }

    /// Refuses a configuration with a wrong number of positions, or with a position outside of its joint's limits.
    pub(crate) fn check_configuration(&self, configuration: &[f64]) -> Result<(), RobotError> {
        self.check_position_count(configuration.len())?;
        for (&joint, &position) in self.free_joints.iter().zip(configuration) {
            let Joint {
                name,
                axis_and_limits: joint,
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

    /// Iterates over how the positions of all joints that move come from a configuration.
    pub(crate) fn position_sources(&self) -> impl Iterator<Item = PositionSource> {
        self.position_sources.iter().copied().flatten()
    }

    /// Refuses a number of positions other than that of a configuration.
    pub(crate) fn check_position_count(&self, count: usize) -> Result<(), RobotError> {
        let expected = self.free_joints.len();
        if count == expected {
            return Ok(());
        }
        Err(RobotError::WrongPositionCount {
            given_count: count,
            expected_count: expected,
            joint_names: self.free_joint_names().collect::<Vec<_>>().join(", "),
        })
    }

    /// Returns the position of each joint in a configuration, in the order of [`Robot::joints`]; 0 for a fixed joint.
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

    /// Returns the position of a joint in a configuration; 0 for a fixed joint.
    fn position(&self, joint: usize, configuration: &[f64]) -> f64 {
        self.position_sources[joint].map_or(0.0, |source| source.position(configuration))
    }
}

/// Finds the rule for the position of each joint, and the joints that have a position of their own.
fn position_sources_and_free_joints(
    joints: &[Joint],
) -> Result<(Vec<Option<PositionSource>>, Vec<usize>), RobotError> {
    let is_free = |joint: &Joint| {
        joint.position_rule == PositionRule::Independent && !joint.axis_and_limits.is_fixed()
    };
    let free_joints: Vec<usize> = (0..joints.len()).filter(|&k| is_free(&joints[k])).collect();
    let sources = joints.iter().map(|joint| {
        if joint.axis_and_limits.is_fixed() {
            return Ok(None);
        }
        let (mut multiplier, mut offset, mut at) = (1.0, 0.0, joint);
        let mut offset_magnitude = 0.0;
        // A joint that follows another one more often than there are joints follows itself.
        for follow_count in 0..=joints.len() as u32 {
            match &at.position_rule {
                PositionRule::Independent => {
                    let number = free_joints.iter().position(|&k| joints[k].name == at.name);
                    return number
                        .map(|number| {
                            Some(PositionSource {
                                position_index: number,
                                multiplier,
                                offset,
                                offset_magnitude,
                                mimic_chain_length: follow_count,
                            })
                        })
                        .ok_or_else(|| unfollowable_joint_error(joint, &at.name));
                }
                PositionRule::Follows {
                    joint: followed,
                    multiplier: factor,
                    offset: shift,
                } => {
                    if !(factor.is_finite() && shift.is_finite()) {
                        let quantity = "the multiplier or the offset";
                        let error = InputError::NotFinite { quantity };
                        let joint = at.name.clone();
                        return Err(RobotError::InvalidPosition { joint, error });
                    }
                    offset += multiplier * shift;
                    offset_magnitude += f64::abs(multiplier * shift);
                    multiplier *= factor;
                    let found = joints.iter().find(|other| other.name == *followed);
                    at = found.ok_or_else(|| RobotError::NoSuchMimicJoint {
                        joint: at.name.clone(),
                        followed_joint: followed.clone(),
                    })?;
                }
            }
        }
        Err(unfollowable_joint_error(joint, &at.name))
    });
    Ok((sources.collect::<Result<_, _>>()?, free_joints))
}

fn unfollowable_joint_error(joint: &Joint, followed: &str) -> RobotError {
    RobotError::InvalidMimicJoint {
        joint: joint.name.clone(),
        followed_joint: followed.to_owned(),
    }
}

#[cfg(test)]
mod tests;
