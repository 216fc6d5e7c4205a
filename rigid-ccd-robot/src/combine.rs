//! Combines several robots into one.

use crate::error::RobotError;
use crate::pairs::LinkPairs;
use crate::robot::{CompoundKind, Joint, Link, PositionRule, Robot};
use rigid_ccd::{Pose, trajectory};

/// The name of the common base link. Underscores are appended while a robot has a link of that name.
const WORLD: &str = "world";

/// A robot, and where to place its base among other robots.
#[derive(Clone, Copy, Debug)]
pub struct PlacedRobot<'a> {
    /// The prefix of the robot's link and joint names, without the slash that follows it. Empty to keep the names.
    pub name: &'a str,
    /// The robot.
    pub robot: &'a Robot,
    /// The pairs of the robot's links that are checked.
    pub pairs: &'a LinkPairs,
    /// The link to which the base is attached, by its combined name, such as `arm/flange`; `None` for the world.
    pub carrier: Option<&'a str>,
    /// The pose of the base in the frame of the carrier or the world. For a moving base, the pose at positions 0.
    pub pose: Pose,
    /// How the base moves relative to its carrier; `None` for a fixed base.
    pub base_motion: Option<CompoundKind>,
}

impl Robot {
    /// Combines robots into one robot, whose base is a link `world`. A configuration lists the positions of the first
    /// robot, then the positions of the second, and so on.
    ///
    /// All robots are checked against each other. Within a robot, its [`PlacedRobot::pairs`] are checked. The positions
    /// of a moving base come before the other positions of its robot, with names such as `cart/base/x`.
    ///
    /// A moving obstacle is a robot of one link with a moving base. A gripper is a robot whose base is attached to a
    /// link of the arm. It is not checked against the links that are fixed to its base.
    ///
    /// # Errors
    /// [`RobotError`] for repeated names, a carrier that is not a link, robots that are attached to each other in a
    /// loop, a planar base without a normal, and pairs of another robot.
    ///
    /// ```
    /// use rigid_ccd::{Body, Pose};
    /// use rigid_ccd_robot::{Cell, CompoundKind, Link, LinkPairs, PlacedRobot, Robot};
    ///
    /// let box_of = |size| Body::cuboid([size; 3]);
    /// let cart = Robot::new(vec![Link::named("cart").with_body(box_of(0.2)?, Pose::IDENTITY)], vec![])?;
    /// let pairs = LinkPairs::from_robot(&cart);
    /// let on_floor = Some(CompoundKind::Planar { normal: [0.0, 0.0, 1.0] });
    /// let placed = |name, x| Ok::<_, rigid_ccd::InputError>(PlacedRobot {
    ///     name,
    ///     robot: &cart,
    ///     pairs: &pairs,
    ///     carrier: None,
    ///     pose: Pose::at([x, 0.0, 0.0])?,
    ///     base_motion: on_floor,
    /// });
    /// let (both, pairs) = Robot::combine(&[placed("red", 0.0)?, placed("blue", 5.0)?])?;
    /// let cell = Cell::new(both, pairs);
    /// let starts = [0.0; 6];
    /// // Both drive towards each other: x, y and yaw of the red one, then of the blue one.
    /// assert!(cell.solver().is_free(&[starts, [2.0, 0.0, 0.0, -2.0, 0.0, 0.0]])?);
    /// assert!(!cell.solver().is_free(&[starts, [3.0, 0.0, 0.0, -2.0, 0.0, 0.0]])?);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn combine(robots: &[PlacedRobot<'_>]) -> Result<(Robot, LinkPairs), RobotError> {
        let mut world = WORLD.to_owned();
        let link_names = || robots.iter().flat_map(PlacedRobot::link_names);
        while link_names().any(|name| name == world) {
            world.push('_');
        }
        let mut links = vec![Link::named(&world)];
        let mut joints = Vec::new();
        let mut first_links = Vec::new();
        // The links of moving bases come last: the links of a robot stay consecutive and in order.
        let mut base_links = Vec::new();
        for placed in robots {
            let carrier = placed.carrier.unwrap_or(&world);
            let (links_of_base, joints_of_base) = placed.base_joints(carrier)?;
            base_links.extend(links_of_base);
            joints.extend(joints_of_base);
            first_links.push(links.len());
            links.extend(placed.robot.links().iter().map(|link| Link {
                name: placed.prefixed(&link.name),
                bodies: link.bodies.clone(),
                planes: link.planes.clone(),
            }));
            let robot_joints = placed.robot.joints().iter();
            joints.extend(robot_joints.map(|joint| placed.with_prefixed_names(joint)));
        }
        links.extend(base_links);
        let remarks = robots.iter().flat_map(|placed| {
            let remarks = placed.robot.file_remarks().iter();
            remarks.map(|remark| remark.with_robot_name(|name| placed.prefixed(name)))
        });
        let combined = Robot::new(links, joints)?.with_file_remarks(remarks);
        let mut pairs = LinkPairs::from_robot(&combined);
        for (placed, first) in robots.iter().zip(first_links) {
            let links_of_robot = first..first + placed.robot.links().len();
            if !pairs.replace_within(links_of_robot, placed.pairs) {
                return Err(RobotError::PairsOfAnotherRobot {
                    robot: placed.name.to_owned(),
                });
            }
            let remarks = placed.pairs.file_remarks().iter();
            pairs.add_file_remarks(
                remarks.map(|remark| remark.with_robot_name(|name| placed.prefixed(name))),
            );
        }
        Ok((combined, pairs))
    }
}

impl PlacedRobot<'_> {
    fn link_names(&self) -> impl Iterator<Item = String> {
        let links = self.robot.links().iter();
        links.map(|link| self.prefixed(&link.name))
    }

    /// Prefixes a name with the name of the robot.
    fn prefixed(&self, name: &str) -> String {
        match self.name {
            "" => name.to_owned(),
            robot => format!("{robot}/{name}"),
        }
    }

    /// Returns the joints between the carrier and the base, and the links between them.
    fn base_joints(&self, carrier: &str) -> Result<(Vec<Link>, Vec<Joint>), RobotError> {
        let base = self.prefixed(&self.robot.links()[self.robot.base()].name);
        let mut name = self.prefixed("base");
        let joints = || self.robot.joints().iter();
        while joints().any(|joint| self.prefixed(&joint.name) == name) {
            name.push('_');
        }
        if let Some(kind) = self.base_motion {
            return Ok(kind.links_and_joints(&name, [carrier, &base], self.pose)?);
        }
        let fixed = Joint {
            name,
            parent: carrier.to_owned(),
            child: base,
            geometry: trajectory::Joint::fixed(self.pose),
            position_rule: PositionRule::Independent,
        };
        Ok((Vec::new(), vec![fixed]))
    }

    /// Returns a joint of the robot with all names prefixed.
    fn with_prefixed_names(&self, joint: &Joint) -> Joint {
        let mut joint = joint.clone();
        for name in [&mut joint.name, &mut joint.parent, &mut joint.child] {
            *name = self.prefixed(name);
        }
        if let PositionRule::Follows {
            joint: followed, ..
        } = &mut joint.position_rule
        {
            *followed = self.prefixed(followed);
        }
        joint
    }
}

#[cfg(test)]
mod tests;
