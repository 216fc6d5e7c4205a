//! Several robots as one.

use crate::error::RobotError;
use crate::pairs::LinkPairs;
use crate::robot::{CompoundKind, Joint, Link, PositionRule, Robot};
use rigid_ccd::{Pose, trajectory};

/// The name of the link that holds the bases of all robots that are combined. It gets underscores if a robot has one of that
/// name.
const WORLD: &str = "world";

/// A robot among others, with the place of its base.
#[derive(Clone, Copy, Debug)]
pub struct PlacedRobot<'a> {
    /// The name that the robot's links and joints have before theirs and a slash. Empty to keep their names.
    pub name: &'a str,
    /// The robot.
    pub robot: &'a Robot,
    /// The pairs of its links that are checked.
    pub pairs: &'a LinkPairs,
    /// The link that carries its base, by the name that it has among all robots, such as `arm/flange`; `None` for the world.
    pub carrier: Option<&'a str>,
    /// The pose of its base in the world or on the link that carries it; of a base that moves when its positions are 0.
    pub pose: Pose,
    /// How its base moves there; `None` for one at rest.
    pub base_motion: Option<CompoundKind>,
}

impl Robot {
    /// Combines robots to one, whose base is a link `world`. A configuration has the positions of the first robot, then those
    /// of the second, and so on.
    ///
    /// The robots are checked against each other. Each has its own pairs of links that are checked. A base that moves has its
    /// positions first, with names such as `cart/base/x`. An obstacle that moves is a robot of one link, with such a base. A gripper
    /// is a robot that a link of an arm carries; it is not compared with links that never move against its base.
    ///
    /// # Errors
    /// [`RobotError`] for names that are not unique, carriers that are no links or that carry each other, a plane without a
    /// normal, and pairs of another robot.
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
        let names = || robots.iter().flat_map(PlacedRobot::link_names);
        while names().any(|name| name == world) {
            world.push('_');
        }
        let mut links = vec![Link::named(&world)];
        let mut joints = Vec::new();
        let mut first_links = Vec::new();
        // Links of moving bases come last, so that those of a robot keep their order.
        let mut base_links = Vec::new();
        for placed in robots {
            let carrier = placed.carrier.unwrap_or(&world);
            let (own_links, own_joints) = placed.base_joints(carrier)?;
            base_links.extend(own_links);
            joints.extend(own_joints);
            first_links.push(links.len());
            links.extend(placed.robot.links().iter().map(|link| Link {
                name: placed.prefixed(&link.name),
                bodies: link.bodies.clone(),
                planes: link.planes.clone(),
            }));
            joints.extend(
                placed
                    .robot
                    .joints()
                    .iter()
                    .map(|joint| placed.joint(joint)),
            );
        }
        links.extend(base_links);
        let remarks = robots.iter().flat_map(|placed| {
            let own = placed.robot.file_remarks().iter();
            own.map(|remark| remark.with_robot_name(|name| placed.prefixed(name)))
        });
        let combined = Robot::new(links, joints)?.with_file_remarks(remarks);
        let mut pairs = LinkPairs::from_robot(&combined);
        for (placed, first) in robots.iter().zip(first_links) {
            let own = first..first + placed.robot.links().len();
            if !pairs.replace_within(own, placed.pairs) {
                return Err(RobotError::PairsOfAnotherRobot {
                    robot: placed.name.to_owned(),
                });
            }
            let own = placed.pairs.file_remarks().iter();
            pairs
                .add_file_remarks(own.map(|own| own.with_robot_name(|name| placed.prefixed(name))));
        }
        Ok((combined, pairs))
    }
}

impl PlacedRobot<'_> {
    fn link_names(&self) -> impl Iterator<Item = String> {
        let links = self.robot.links().iter();
        links.map(|link| self.prefixed(&link.name))
    }

    /// Returns a name with that of the robot before it.
    fn prefixed(&self, name: &str) -> String {
        match self.name {
            "" => name.to_owned(),
            own => format!("{own}/{name}"),
        }
    }

    /// Returns the joints between the link that carries the base and the base, with the links between them.
    fn base_joints(&self, carrier: &str) -> Result<(Vec<Link>, Vec<Joint>), RobotError> {
        let base = self.prefixed(&self.robot.links()[self.robot.base()].name);
        let mut name = self.prefixed("base");
        let has_joint = |name: &String| {
            let joints = self.robot.joints().iter();
            joints
                .map(|joint| self.prefixed(&joint.name))
                .any(|own| own == *name)
        };
        while has_joint(&name) {
            name.push('_');
        }
        if let Some(kind) = self.base_motion {
            return Ok(kind.links_and_joints(&name, [carrier, &base], self.pose)?);
        }
        let fixed = Joint {
            name,
            parent: carrier.to_owned(),
            child: base,
            axis_and_limits: trajectory::Joint::fixed(self.pose),
            position_rule: PositionRule::Independent,
        };
        Ok((Vec::new(), vec![fixed]))
    }

    /// Returns a joint of the robot, with its name before all names.
    fn joint(&self, joint: &Joint) -> Joint {
        Joint {
            name: self.prefixed(&joint.name),
            parent: self.prefixed(&joint.parent),
            child: self.prefixed(&joint.child),
            axis_and_limits: joint.axis_and_limits.clone(),
            position_rule: match &joint.position_rule {
                PositionRule::Independent => PositionRule::Independent,
                PositionRule::Follows {
                    joint,
                    multiplier,
                    offset,
                } => PositionRule::Follows {
                    joint: self.prefixed(joint),
                    multiplier: *multiplier,
                    offset: *offset,
                },
            },
        }
    }
}

#[cfg(test)]
mod tests;
