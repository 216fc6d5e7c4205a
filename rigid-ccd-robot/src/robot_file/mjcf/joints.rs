//! Makes chains of joints of the joints of an MJCF, several of which may move one body.

use super::{MjcfModel, convert_pose};
use crate::robot::{CompoundKind, Joint, Link, PositionRule};
use crate::robot_file::error::RobotFileError;
use mjcf_rs::body::JointType;
use mjcf_rs::equality::{Equality, EqualityJoint};
use rigid_ccd::glam::{DQuat, DVec3};
use rigid_ccd::{InputError, Pose, trajectory};
use std::collections::HashMap;

/// Makes chains of joints of those of a model.
pub(super) struct JointReader<'r> {
    mjcf: &'r MjcfModel,
    /// The constraint by which a joint follows another one, by the joint's name.
    leaders: HashMap<&'r str, &'r EqualityJoint>,
    /// The position of each named joint in the model's own configuration.
    references: HashMap<&'r str, f64>,
}

/// The joints of a body as far as they are made, from its parent on.
struct Chain<'r> {
    /// The link of the body.
    body: &'r str,
    /// The links between the parent and the body.
    links: Vec<Link>,
    joints: Vec<Joint>,
    /// The last link.
    at: String,
    /// The pose of the body's frame in that of the last link, while all joints that follow are at their references.
    frame: Pose,
}

impl<'r> JointReader<'r> {
    pub(super) fn new(mjcf: &'r MjcfModel) -> Self {
        let bodies = mjcf.model.bodies.iter();
        let joints = bodies.flat_map(|entry| &entry.body.joints);
        let has_one_position = |joint: &&mjcf_rs::body::Joint| {
            matches!(joint.type_, JointType::Hinge | JointType::Slide)
        };
        let joints = joints.filter(has_one_position);
        let references: HashMap<&str, f64> = joints
            .filter_map(|joint| Some((joint.name.as_deref()?, joint.ref_)))
            .collect();
        let mut leaders = HashMap::new();
        for equality in &mjcf.model.equality {
            // The first joint is a polynomial of the second one.
            if let Equality::Joint(constraint) = equality
                && constraint.common.active
                && constraint.polycoef[2..].iter().all(|&own| own == 0.0)
                && let Some(leader) = constraint.joint2.as_deref()
                && [leader, &constraint.joint1]
                    .iter()
                    .all(|&name| references.contains_key(name))
                && !leads_to(&leaders, leader, &constraint.joint1)
            {
                leaders.entry(&*constraint.joint1).or_insert(constraint);
            }
        }
        JointReader {
            mjcf,
            leaders,
            references,
        }
    }

    /// Returns the joints that connect a body to its parent, and the links between them.
    pub(super) fn joints(&self, number: usize) -> Result<(Vec<Link>, Vec<Joint>), RobotFileError> {
        let entry = &self.mjcf.model.bodies[number];
        let Some(parent) = entry.parent else {
            return Ok((Vec::new(), Vec::new()));
        };
        let name = &self.mjcf.link_names[number];
        let frame = convert_pose(entry.body.pose).map_err(RobotFileError::from);
        let mut chain = Chain {
            body: name,
            links: Vec::new(),
            joints: Vec::new(),
            at: self.mjcf.link_names[parent].clone(),
            frame: frame.map_err(|error| error.with_link_name(name))?,
        };
        for (k, joint) in entry.body.joints.iter().enumerate() {
            let joint_name = joint.name.clone();
            let joint_name = joint_name.unwrap_or_else(|| format!("{name}/joint{k}"));
            let is_last = k + 1 == entry.body.joints.len();
            let ends_in_frame = joint.pos == [0.0; 3] || !turns(joint.type_);
            let child = if is_last && ends_in_frame {
                name.clone()
            } else {
                format!("{name}/{joint_name}")
            };
            self.add_joint(&mut chain, joint, &joint_name, child)
                .map_err(|error| error.with_joint_name(&joint_name))?;
        }
        if chain.at != *name {
            let fixed = trajectory::Joint::fixed(chain.frame);
            chain.push(
                format!("{name}/fixed"),
                name.clone(),
                fixed,
                PositionRule::Independent,
            );
        }
        Ok((chain.links, chain.joints))
    }

    /// Adds one joint, which moves the link `child`, to the chain of its body.
    fn add_joint(
        &self,
        chain: &mut Chain<'_>,
        joint: &mjcf_rs::body::Joint,
        name: &str,
        child: String,
    ) -> Result<(), RobotFileError> {
        let anchor = Pose::at(joint.pos)?;
        let is_limited = joint
            .limited
            .resolve(self.mjcf.model.compiler.autolimits, joint.range.is_some());
        let limited = |moving: trajectory::Joint| match joint.range {
            Some([low, high]) if is_limited => moving.with_limits(low..=high),
            _ => moving,
        };
        let turned = chain.frame.compose(&anchor);
        match joint.type_ {
            JointType::Hinge => {
                let at_zero = Pose::new(DVec3::ZERO, turn_back(joint.axis, joint.ref_)?)?;
                let moving = limited(trajectory::Joint::revolute(
                    turned.compose(&at_zero),
                    joint.axis,
                )?);
                chain.push(name.to_owned(), child, moving, self.position_rule(name));
                chain.frame = anchor.inverse();
            }
            JointType::Slide => {
                let offset = -joint.ref_ * unit_axis(joint.axis)?;
                let origin = chain.frame.compose(&Pose::at(offset)?);
                let moving = limited(trajectory::Joint::prismatic(origin, joint.axis)?);
                chain.push(name.to_owned(), child, moving, self.position_rule(name));
                chain.frame = Pose::IDENTITY;
            }
            JointType::Ball => {
                chain.push_compound(CompoundKind::Spherical, name, child, turned)?;
                chain.frame = anchor.inverse();
            }
            JointType::Free => {
                // Its positions are those of the body in the world.
                chain.push_compound(CompoundKind::Floating, name, child, Pose::IDENTITY)?;
                chain.frame = Pose::IDENTITY;
            }
        }
        Ok(())
    }

    fn position_rule(&self, joint: &str) -> PositionRule {
        let Some(constraint) = self.leaders.get(joint) else {
            return PositionRule::Independent;
        };
        let leader = constraint.joint2.clone().unwrap_or_default();
        let [offset, multiplier, ..] = constraint.polycoef;
        PositionRule::Follows {
            offset: self.references[joint] + offset - multiplier * self.references[&*leader],
            joint: leader,
            multiplier,
        }
    }
}

impl Chain<'_> {
    fn push(
        &mut self,
        name: String,
        child: String,
        moving: trajectory::Joint,
        position_rule: PositionRule,
    ) {
        let parent = self.move_on_to(child);
        self.joints.push(Joint {
            name,
            parent,
            child: self.at.clone(),
            axis_and_limits: moving,
            position_rule,
        });
    }

    fn push_compound(
        &mut self,
        kind: CompoundKind,
        name: &str,
        child: String,
        origin: Pose,
    ) -> Result<(), InputError> {
        let parent = self.move_on_to(child);
        let (links, joints) = kind.links_and_joints(name, [&parent, &self.at], origin)?;
        self.links.extend(links);
        self.joints.extend(joints);
        Ok(())
    }

    /// Makes a link the last one, and returns the one before it. The robot has a link for each body already.
    fn move_on_to(&mut self, child: String) -> String {
        if child != self.body {
            self.links.push(Link::named(&child));
        }
        std::mem::replace(&mut self.at, child)
    }
}

/// Returns whether a joint follows another one, directly or through others.
fn leads_to(leaders: &HashMap<&str, &EqualityJoint>, joint: &str, other: &str) -> bool {
    let mut at = joint;
    loop {
        if at == other {
            return true;
        }
        match leaders
            .get(at)
            .and_then(|constraint| constraint.joint2.as_deref())
        {
            Some(next) => at = next,
            None => return false,
        }
    }
}

/// Returns whether a joint turns about its anchor.
fn turns(kind: JointType) -> bool {
    matches!(kind, JointType::Hinge | JointType::Ball)
}

fn unit_axis(axis: [f64; 3]) -> Result<DVec3, InputError> {
    match trajectory::Joint::revolute(Pose::IDENTITY, axis)?.kind() {
        trajectory::JointKind::Revolute(axis) => Ok(axis),
        _ => Ok(DVec3::Z),
    }
}

/// Returns the rotation to the position 0 of a hinge from that in the model's own configuration.
fn turn_back(axis: [f64; 3], reference: f64) -> Result<DQuat, InputError> {
    Ok(DQuat::from_axis_angle(unit_axis(axis)?, -reference))
}
