//! Converts the joints of an MJCF, where several joints may move one body, into chains of joints.

use super::bodies::{MjcfBody, MjcfJoint, MjcfJointKind};
use super::model::MjcfModel;
use crate::robot::{CompoundKind, Joint, Link, PositionRule};
use crate::robot_file::error::RobotFileError;
use crate::robot_file::mjcf_error::MjcfError;
use rigid_ccd::glam::{DQuat, DVec3};
use rigid_ccd::{InputError, Pose, trajectory};
use std::collections::HashMap;

/// Converts the joints of a model.
pub(super) struct JointReader<'r> {
    mjcf: &'r MjcfModel,
    /// The rules of the joints that follow another one, by name.
    mimic_rules: MimicRules<'r>,
}

/// For each joint that follows another one, by name, its position rule.
type MimicRules<'r> = HashMap<&'r str, PositionRule>;

/// The chain of joints between a body and its parent, while it is built.
struct Chain<'r> {
    /// The link of the body.
    body: &'r str,
    /// The links between the parent and the body.
    links: Vec<Link>,
    joints: Vec<Joint>,
    /// The name of the last link.
    last_link: String,
    /// The pose of the body's frame in the frame of the last link, with all remaining joints at their references.
    frame: Pose,
}

impl<'r> JointReader<'r> {
    pub(super) fn new(mjcf: &'r MjcfModel) -> Result<Self, MjcfError> {
        Ok(JointReader {
            mjcf,
            mimic_rules: read_mimic_rules(mjcf)?,
        })
    }

    /// Returns the joints that connect a body to its parent, and the links between them.
    pub(super) fn joints(
        &self,
        body: &MjcfBody,
    ) -> Result<(Vec<Link>, Vec<Joint>), RobotFileError> {
        let Some(parent) = body.parent else {
            return Ok((Vec::new(), Vec::new()));
        };
        let name = &body.name;
        let mut chain = Chain {
            body: name,
            links: Vec::new(),
            joints: Vec::new(),
            last_link: self.mjcf.bodies[parent].name.clone(),
            frame: body.pose,
        };
        for (k, joint) in body.joints.iter().enumerate() {
            let is_last = k + 1 == body.joints.len();
            let ends_in_frame = joint.anchor == DVec3::ZERO || !joint.kind.is_rotational();
            let child = if is_last && ends_in_frame {
                name.clone()
            } else {
                format!("{name}/{}", joint.name)
            };
            self.add_joint(&mut chain, joint, child)
                .map_err(|error| RobotFileError::from(error).within("joint", &joint.name))?;
        }
        if chain.last_link != *name {
            let fixed = trajectory::Joint::fixed(chain.frame);
            let rule = PositionRule::Independent;
            chain.push(format!("{name}/fixed"), name.clone(), fixed, rule);
        }
        Ok((chain.links, chain.joints))
    }

    /// Adds one joint, which moves the link `child`, to the chain.
    fn add_joint(
        &self,
        chain: &mut Chain<'_>,
        joint: &MjcfJoint,
        child: String,
    ) -> Result<(), InputError> {
        let anchor = Pose::at(joint.anchor)?;
        let at_anchor = chain.frame.compose(&anchor);
        let name = &joint.name;
        match joint.kind {
            MjcfJointKind::Hinge => {
                // The pose in the file is the pose at the reference position. The joint's origin is the pose at 0.
                let to_zero = DQuat::from_scaled_axis(-joint.reference * joint.axis);
                let origin = at_anchor.compose(&Pose::new(DVec3::ZERO, to_zero)?);
                let geometry = trajectory::Joint::revolute(origin, joint.axis)?;
                chain.push(
                    name.clone(),
                    child,
                    joint.with_limits(geometry),
                    self.position_rule(name),
                );
                chain.frame = anchor.inverse();
            }
            MjcfJointKind::Slide => {
                let origin = chain
                    .frame
                    .compose(&Pose::at(-joint.reference * joint.axis)?);
                let geometry = trajectory::Joint::prismatic(origin, joint.axis)?;
                chain.push(
                    name.clone(),
                    child,
                    joint.with_limits(geometry),
                    self.position_rule(name),
                );
                chain.frame = Pose::IDENTITY;
            }
            MjcfJointKind::Ball => {
                chain.push_compound(CompoundKind::Spherical, name, child, at_anchor)?;
                chain.frame = anchor.inverse();
            }
            MjcfJointKind::Free => {
                // The positions are relative to the world's origin, not to the pose in the file.
                chain.push_compound(CompoundKind::Floating, name, child, Pose::IDENTITY)?;
                chain.frame = Pose::IDENTITY;
            }
        }
        Ok(())
    }

    fn position_rule(&self, joint: &str) -> PositionRule {
        let rule = self.mimic_rules.get(joint).cloned();
        rule.unwrap_or(PositionRule::Independent)
    }
}

impl MjcfJointKind {
    /// Returns whether the joint rotates the body about the anchor only.
    fn is_rotational(self) -> bool {
        matches!(self, MjcfJointKind::Hinge | MjcfJointKind::Ball)
    }

    fn has_one_position(self) -> bool {
        matches!(self, MjcfJointKind::Hinge | MjcfJointKind::Slide)
    }
}

impl MjcfJoint {
    fn with_limits(&self, geometry: trajectory::Joint) -> trajectory::Joint {
        match self.limits {
            Some([low, high]) => geometry.with_limits(low..=high),
            None => geometry,
        }
    }
}

impl Chain<'_> {
    fn push(
        &mut self,
        name: String,
        child: String,
        geometry: trajectory::Joint,
        position_rule: PositionRule,
    ) {
        let parent = self.append_link(child);
        self.joints.push(Joint {
            name,
            parent,
            child: self.last_link.clone(),
            geometry,
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
        let parent = self.append_link(child);
        let (links, joints) = kind.links_and_joints(name, [&parent, &self.last_link], origin)?;
        self.links.extend(links);
        self.joints.extend(joints);
        Ok(())
    }

    /// Makes `child` the last link, and returns the name of the previous one. The link of the body exists already.
    fn append_link(&mut self, child: String) -> String {
        if child != self.body {
            self.links.push(Link::named(&child));
        }
        std::mem::replace(&mut self.last_link, child)
    }
}

/// Reads the equality constraints that make the position of a joint a linear function of another joint's position. For
/// each joint, the first valid constraint applies. A constraint is ignored if the joint would follow itself.
fn read_mimic_rules(mjcf: &MjcfModel) -> Result<MimicRules<'_>, MjcfError> {
    let joints = mjcf.bodies.iter().flat_map(|body| &body.joints);
    let joints: HashMap<&str, &MjcfJoint> =
        joints.map(|joint| (joint.name.as_str(), joint)).collect();
    let mut rules = MimicRules::new();
    for constraint in mjcf.constraints_named("joint") {
        let find = |name: &str| {
            let joint = joints.get(name).copied();
            joint.ok_or_else(|| MjcfError::unknown_name("joint", name))
        };
        let joint = find(constraint.required_name("joint1")?)?;
        let Some(leader) = constraint.name("joint2").map(find).transpose()? else {
            continue;
        };
        // The default coefficients make both positions equal.
        let mut coefficients = [0.0, 1.0, 0.0, 0.0, 0.0];
        let polynomial = constraint.numbers("polycoef")?.unwrap_or_default();
        if polynomial.len() > coefficients.len() {
            return Err(constraint.invalid("polycoef"));
        }
        coefficients[..polynomial.len()].copy_from_slice(&polynomial);
        let [constant, multiplier, ref higher @ ..] = coefficients;
        let is_linear = higher.iter().all(|&coefficient| coefficient == 0.0);
        let has_one_position = joint.kind.has_one_position() && leader.kind.has_one_position();
        let is_active = constraint.truth_or("active", true)?;
        let applies = is_active && is_linear && has_one_position;
        if applies && !follows(&rules, &leader.name, &joint.name) {
            rules.entry(&joint.name).or_insert(PositionRule::Follows {
                joint: leader.name.clone(),
                multiplier,
                offset: joint.reference + constant - multiplier * leader.reference,
            });
        }
    }
    Ok(rules)
}

/// Returns whether a joint is `other` or follows it directly or indirectly.
fn follows(rules: &MimicRules<'_>, joint: &str, other: &str) -> bool {
    let mut followed = joint;
    while followed != other {
        match rules.get(followed) {
            Some(PositionRule::Follows { joint, .. }) => followed = joint,
            _ => return false,
        }
    }
    true
}
