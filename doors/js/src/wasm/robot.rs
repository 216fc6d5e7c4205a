//! Robots and mechanisms of links and joints.

use super::body::Body;
use super::fault::Fault;
use super::host::tell;
use super::movement::{LinkMotion, Movement};
use super::poses::{pose_from_numbers, pose_to_numbers};
use rigid_ccd::Remark;
use rigid_ccd::trajectory::{self, JointKind};
use rigid_ccd_robot::{CellRemark, Joint, Link, LinkBody, LinkPairs, PositionRule, SkipReason};
use wasm_bindgen::prelude::wasm_bindgen;

/// A robot, and the pairs of its links that are checked.
#[wasm_bindgen]
#[derive(Clone, Debug)]
pub struct Robot {
    pub(crate) robot: rigid_ccd_robot::Robot,
    pub(crate) pairs: LinkPairs,
}

/// Collects the links and joints of a robot.
#[wasm_bindgen]
#[derive(Debug, Default)]
pub struct RobotBuilder {
    links: Vec<Link>,
    joints: Vec<Joint>,
    may_touch: Vec<[String; 2]>,
}

#[wasm_bindgen]
impl RobotBuilder {
    /// Creates a builder without links.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        RobotBuilder::default()
    }

    /// Adds a fixed, revolute or prismatic joint and its links. `numbers` are the pose of the joint in the frame of its
    /// parent, the axis, and the least and the greatest position.
    ///
    /// # Errors
    /// An unknown kind, or numbers that are out of range.
    pub fn add_joint(
        &mut self,
        kind: &str,
        name: &str,
        parent: &str,
        child: &str,
        numbers: &[f64],
    ) -> Result<(), Fault> {
        let in_joint = Fault::of_element(format!("joint {name:?}"));
        let origin = pose_from_numbers(numbers).map_err(&in_joint)?;
        let axis = [7, 8, 9].map(|k| numbers[k]);
        let joint = match kind {
            "fixed" => Ok(trajectory::Joint::fixed(origin)),
            "revolute" => trajectory::Joint::revolute(origin, axis),
            "prismatic" => trajectory::Joint::prismatic(origin, axis),
            // `doors/js/module/robot.js` has refused unknown names before.
            _ => return Err(Fault::plain(format!("joint {name:?}: type {kind:?}"))),
        };
        let joint = joint.map_err(&in_joint)?;
        self.joints.push(Joint {
            name: name.to_owned(),
            parent: parent.to_owned(),
            child: child.to_owned(),
            geometry: joint.with_limits(numbers[10]..=numbers[11]),
            position_rule: PositionRule::Independent,
        });
        self.link(parent);
        self.link(child);
        Ok(())
    }

    /// Makes the last added joint follow another joint.
    pub fn follow(&mut self, joint: &str, multiplier: f64, offset: f64) {
        if let Some(last) = self.joints.last_mut() {
            last.position_rule = PositionRule::Follows {
                joint: joint.to_owned(),
                multiplier,
                offset,
            };
        }
    }

    /// Fixes a body to a link, at a pose in the link's frame.
    ///
    /// # Errors
    /// An invalid pose.
    pub fn add_body(&mut self, link: &str, body: &Body, pose: &[f64]) -> Result<(), Fault> {
        let pose =
            pose_from_numbers(pose).map_err(Fault::of_element(format!("body of {link:?}")))?;
        let body = body.body.clone();
        self.link(link).bodies.push(LinkBody { body, pose });
        Ok(())
    }

    /// Excludes a pair of links from the checked pairs.
    pub fn may_touch(&mut self, a: &str, b: &str) {
        self.may_touch.push([a.to_owned(), b.to_owned()]);
    }

    /// Builds the robot.
    ///
    /// # Errors
    /// The invalid link or joint.
    pub fn build(self) -> Result<Robot, Fault> {
        let robot = rigid_ccd_robot::Robot::new(self.links, self.joints)?;
        let mut pairs = LinkPairs::from_robot(&robot);
        for [a, b] in &self.may_touch {
            let reason = SkipReason::Disabled("may touch".into());
            pairs.skip(robot.link_number(a)?, robot.link_number(b)?, reason);
        }
        Ok(Robot { robot, pairs })
    }
}

impl RobotBuilder {
    /// Returns the link with a name. Adds it if there is none.
    fn link(&mut self, name: &str) -> &mut Link {
        let index = self.links.iter().position(|link| link.name == name);
        let index = index.unwrap_or_else(|| {
            self.links.push(Link::named(name));
            self.links.len() - 1
        });
        &mut self.links[index]
    }
}

#[wasm_bindgen]
impl Robot {
    /// Returns the names of the independent joints, in the order of a configuration.
    pub fn joint_names(&self) -> Vec<String> {
        self.robot
            .independent_joint_names()
            .map(str::to_owned)
            .collect()
    }

    /// Returns the names of the links.
    pub fn link_names(&self) -> Vec<String> {
        let links = self.robot.links().iter();
        links.map(|link| link.name.clone()).collect()
    }

    /// Returns the least and the greatest position of each joint.
    pub fn limits(&self) -> Vec<f64> {
        self.robot.limits().flatten().collect()
    }

    /// Returns the checked pairs of links, two names for each pair.
    pub fn checked_pairs(&self) -> Vec<String> {
        names_of_pairs(&self.robot, &self.pairs)
    }

    /// Returns two texts for each remark: "warning" or "remark", then the remark itself.
    pub fn remarks(&self) -> Vec<String> {
        remark_texts(self.pairs.remarks(&self.robot))
    }

    /// Returns the pose of a link as numbers.
    ///
    /// # Errors
    /// An unknown link, or an invalid configuration.
    pub fn pose(&self, link: &str, configuration: &[f64]) -> Result<Vec<f64>, Fault> {
        Ok(pose_to_numbers(&self.robot.pose(link, configuration)?))
    }

    /// Returns the motion of a link in the frame of another link, or of the base.
    ///
    /// # Errors
    /// An unknown link, or an invalid configuration or duration.
    pub fn link_trajectory(
        &self,
        link: &str,
        seen_from: Option<String>,
        start: &[f64],
        end: &[f64],
        duration: f64,
    ) -> Result<Movement, Fault> {
        let robot = &self.robot;
        let link_index = robot.link_number(link)?;
        let reference_index =
            seen_from.map_or(Ok(robot.base()), |name| robot.link_number(&name))?;
        let chain = robot.chain_between(reference_index, link_index);
        let positions = |argument_name: &str, configuration: &[f64]| {
            let positions = chain.positions(robot, configuration);
            positions.map_err(Fault::of_element(argument_name))
        };
        let ends = [positions("start", start)?, positions("end", end)?];
        let joints = chain.chain().joints().iter().enumerate();
        let angles = joints
            .filter(|(_, joint)| matches!(joint.kind(), JointKind::Revolute(_)))
            .flat_map(|(k, _)| [ends[0][k], ends[1][k]]);
        tell(angles.filter_map(Remark::remark_on_joint));
        Ok(Movement::from_link(LinkMotion {
            chain,
            ends,
            duration,
        })?)
    }
}

/// Returns the checked pairs of links, two names for each pair.
pub(crate) fn names_of_pairs(robot: &rigid_ccd_robot::Robot, pairs: &LinkPairs) -> Vec<String> {
    let links = pairs.checked_pairs().flatten();
    links.map(|link| robot.links()[link].name.clone()).collect()
}

/// Returns two texts for each remark: "warning" or "remark", then the remark itself.
pub(crate) fn remark_texts(remarks: Vec<CellRemark>) -> Vec<String> {
    let texts = remarks.into_iter().flat_map(|remark| {
        let kind = if remark.is_warning() {
            "warning"
        } else {
            "remark"
        };
        [kind.to_owned(), remark.to_string()]
    });
    texts.collect()
}
