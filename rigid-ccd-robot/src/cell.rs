//! A robot among obstacles.

mod clusters;
mod compared;
mod margins;
pub(crate) mod part;
mod planes;
mod remarks;
pub(crate) mod rounding;

use crate::error::RobotError;
use crate::kinematics::Kinematics;
use crate::pairs::LinkPairs;
use crate::robot::Robot;
use crate::tuning::{MAX_LINK_PARTS, MAX_OBSTACLE_PARTS};
use crate::units::SizeScale;
use compared::AllowedPairs;
use margins::Margins;
use part::{HullPart, PlacedBody};
use rigid_ccd::{Body, Pose};
use std::cmp::Ordering;
use std::sync::{Arc, OnceLock};

/// A robot among obstacles that rest in the frame of its base.
///
/// Obstacles and bodies that are attached to links go by their names, which no link has.
#[derive(Clone, Debug)]
pub struct Cell {
    robot: Robot,
    pairs: LinkPairs,
    kinematics: Kinematics,
    /// The bodies of the robot's links, then those attached to links, then the obstacles.
    bodies: Vec<PlacedBody>,
    /// The convex parts of all bodies, in the order of the bodies.
    parts: Vec<HullPart>,
    robot_part_count: usize,
    /// Where the robot holds each of its bodies, in the order of the bodies.
    robot_body_placements: Vec<RobotBodyPlacement>,
    obstacle_names: Vec<String>,
    margins: Margins,
    allowed: AllowedPairs,
    size_scale: SizeScale,
    /// A body of the smallest item, and the item's size; `None` in it if nothing has a size. It is found when it is first needed.
    smallest_item: OnceLock<Option<(usize, f64)>>,
}

/// Where a robot holds a body.
#[derive(Clone, Debug)]
struct RobotBodyPlacement {
    /// The number of the link.
    link: usize,
    /// The pose of the body in the link's frame.
    pose_in_link: Pose,
    /// The name of an attached body; `None` for a body of the link itself.
    attached_name: Option<String>,
}

/// A link of the robot, a body attached to a link, or an obstacle, by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Item<'c> {
    /// A link.
    Link(&'c str),
    /// A body that is attached to a link.
    Attached(&'c str),
    /// An obstacle.
    Obstacle(&'c str),
}

impl<'c> Item<'c> {
    /// Returns the name, which is unique in a cell.
    pub fn name(self) -> &'c str {
        let (Item::Link(name) | Item::Attached(name) | Item::Obstacle(name)) = self;
        name
    }
}

/// A body of a cell, at rest on a link.
#[derive(Clone, Copy, Debug)]
pub struct CarriedBody<'c> {
    /// What the body belongs to.
    pub item: Item<'c>,
    /// The body.
    pub body: &'c Body,
    /// The number of the link that carries it: the base for an obstacle.
    pub link: usize,
    /// The pose of the body in the frame of the link.
    pub pose: Pose,
}

impl Cell {
    /// Creates a cell without obstacles. Pairs of links that are not checked may touch.
    pub fn new(robot: Robot, pairs: LinkPairs) -> Self {
        let kinematics = Kinematics::of_robot(&robot);
        let mut cell = Cell {
            margins: Margins::default(),
            allowed: AllowedPairs::default(),
            size_scale: robot.size_scale(),
            smallest_item: OnceLock::new(),
            robot,
            pairs,
            kinematics,
            bodies: Vec::new(),
            parts: Vec::new(),
            robot_part_count: 0,
            robot_body_placements: Vec::new(),
            obstacle_names: Vec::new(),
        };
        for link in 0..cell.robot.links().len() {
            for body in cell.robot.links()[link].bodies.clone() {
                cell.add_robot_body(
                    body.body,
                    RobotBodyPlacement::for_link_body(link, body.pose),
                );
            }
        }
        for link in 0..cell.robot.links().len() {
            for plane in cell.robot.links()[link].planes.clone() {
                cell.add_link_plane(RobotBodyPlacement::for_link_body(link, plane));
            }
        }
        cell
    }

    /// Adds an obstacle at a pose in the frame of the robot's base.
    ///
    /// # Errors
    /// [`RobotError::NameTaken`], [`RobotError::EmptyName`], [`RobotError::TooFar`].
    pub fn add_obstacle(
        &mut self,
        name: impl Into<String>,
        body: impl Into<Arc<Body>>,
        pose: Pose,
    ) -> Result<(), RobotError> {
        let name = name.into();
        self.check_new_name(&name)?;
        RobotError::check_pose("obstacle", &name, &pose)?;
        self.obstacle_names.push(name);
        let placed = PlacedBody::new(body.into(), pose, 0, MAX_OBSTACLE_PARTS);
        self.insert(self.bodies.len(), placed);
        Ok(())
    }

    /// Moves an obstacle to a pose in the frame of the robot's base.
    ///
    /// # Errors
    /// [`RobotError::NoSuchObstacle`], [`RobotError::TooFar`].
    pub fn move_obstacle(&mut self, name: &str, pose: Pose) -> Result<(), RobotError> {
        let number = self.robot_body_placements.len() + self.obstacle_index(name)?;
        RobotError::check_pose("obstacle", name, &pose)?;
        let moved = self.bodies[number].moved_to(pose);
        self.replace(number, moved);
        Ok(())
    }

    /// Removes an obstacle, together with the clearances and the allowed contacts that it had.
    ///
    /// # Errors
    /// [`RobotError::NoSuchObstacle`].
    pub fn remove_obstacle(&mut self, name: &str) -> Result<(), RobotError> {
        let obstacle = self.obstacle_index(name)?;
        self.obstacle_names.remove(obstacle);
        self.remove(self.robot_body_placements.len() + obstacle);
        Ok(())
    }

    /// Attaches a body to a link, such as an object that a gripper holds, at a pose in the link's frame. It moves with the
    /// link. It may touch that link, links that no joint moves against it, and the links, attached bodies and obstacles that are
    /// named; [`Cell::allow_contact`] allows more of them later.
    ///
    /// # Errors
    /// [`RobotError::NameTaken`], [`RobotError::EmptyName`], [`RobotError::NoSuchLink`], [`RobotError::TooFar`], and
    /// [`RobotError::NoSuchItem`] for what it may touch.
    pub fn attach(
        &mut self,
        name: impl Into<String>,
        body: impl Into<Arc<Body>>,
        (link, pose): (&str, Pose),
        may_touch: &[&str],
    ) -> Result<(), RobotError> {
        let link = self.robot.link_number(link)?;
        let may_touch = may_touch.iter().map(|item| self.item_named(item));
        let may_touch: Vec<Item<'_>> = may_touch.collect::<Result<_, _>>()?;
        let name = name.into();
        self.check_new_name(&name)?;
        RobotError::check_pose("attached body", &name, &pose)?;
        let placement = RobotBodyPlacement {
            link,
            pose_in_link: pose,
            attached_name: Some(name),
        };
        let number = self.robot_body_placements.len();
        self.add_robot_body(body.into(), placement);
        self.allow_contacts_of_attached(number, &may_touch);
        Ok(())
    }

    /// Removes a body that is attached to a link, together with the clearances and the allowed contacts that it had.
    ///
    /// # Errors
    /// [`RobotError::NoSuchAttachedBody`].
    pub fn detach(&mut self, name: &str) -> Result<(), RobotError> {
        let number = self.attached_body_index(name)?;
        self.robot_body_placements.remove(number);
        let parts = self.parts.iter().filter(|part| part.owner == number);
        self.robot_part_count -= parts.count();
        self.remove(number);
        Ok(())
    }

    /// Returns the robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Returns which pairs of links are checked.
    pub fn link_pairs(&self) -> &LinkPairs {
        &self.pairs
    }

    /// Returns the names of the obstacles, in the order in which they were added.
    pub fn obstacle_names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.obstacle_names.iter().map(String::as_str)
    }

    /// Returns the names of the bodies that are attached to links, in the order in which they were attached.
    pub fn attached_names(&self) -> impl Iterator<Item = &str> {
        let placement = self.robot_body_placements.iter();
        placement.filter_map(|placement| placement.attached_name.as_deref())
    }

    /// Returns the link, the attached body or the obstacle that has a name.
    ///
    /// # Errors
    /// [`RobotError::NoSuchItem`].
    pub fn item_named<'c>(&self, name: &'c str) -> Result<Item<'c>, RobotError> {
        if self.robot.link_number(name).is_ok() {
            Ok(Item::Link(name))
        } else if self.attached_body_index(name).is_ok() {
            Ok(Item::Attached(name))
        } else if self.obstacle_index(name).is_ok() {
            Ok(Item::Obstacle(name))
        } else {
            Err(RobotError::NoSuchItem { name: name.into() })
        }
    }

    /// Returns the bodies of the cell in a configuration, each with what it belongs to and its pose in the frame of the base.
    ///
    /// # Errors
    /// [`RobotError::WrongPositionCount`], [`RobotError::InvalidPosition`].
    pub fn placed_bodies(
        &self,
        configuration: &[f64],
    ) -> Result<Vec<(Item<'_>, &Body, Pose)>, RobotError> {
        let robot_bodies = self.robot_body_placements.iter().map(|placement| {
            let link = self
                .robot
                .pose(&self.robot.links()[placement.link].name, configuration)?;
            Ok::<Pose, RobotError>(link.compose(&placement.pose_in_link))
        });
        let obstacles = self.bodies[self.robot_body_count()..]
            .iter()
            .map(|placed| Ok(placed.pose));
        let poses = robot_bodies.chain(obstacles).enumerate();
        let placed = poses.map(|(number, pose)| {
            let body: &Body = &self.bodies[number].body;
            Ok((self.item_of_body(number), body, pose?))
        });
        placed.collect()
    }

    /// Returns the bodies of the cell, in the order of [`Cell::placed_bodies`], each with the link that carries it.
    pub fn carried_bodies(&self) -> impl ExactSizeIterator<Item = CarriedBody<'_>> {
        let bodies = self.bodies.iter().enumerate();
        bodies.map(|(number, placed)| {
            let placement = self.robot_body_placements.get(number);
            let on_base = (self.robot.base(), placed.pose);
            let (link, pose) = placement.map_or(on_base, |placement| {
                (placement.link, placement.pose_in_link)
            });
            CarriedBody {
                item: self.item_of_body(number),
                body: &placed.body,
                link,
                pose,
            }
        })
    }

    pub(crate) fn kinematics(&self) -> &Kinematics {
        &self.kinematics
    }

    /// Returns the bodies that the robot holds, followed by the obstacles.
    pub(crate) fn bodies(&self) -> &[PlacedBody] {
        &self.bodies
    }

    /// Returns the number of bodies that the robot holds.
    pub(crate) fn robot_body_count(&self) -> usize {
        self.robot_body_placements.len()
    }

    /// Returns the convex parts of all bodies, in the order of the bodies.
    pub(crate) fn parts(&self) -> &[HullPart] {
        &self.parts
    }

    pub(crate) fn robot_part_count(&self) -> usize {
        self.robot_part_count
    }

    /// Returns the number of the link that holds one of the robot's bodies.
    pub(crate) fn link_of(&self, body: usize) -> usize {
        self.robot_body_placements[body].link
    }

    /// Returns the pose of one of the robot's bodies in its link.
    pub(crate) fn pose_in_link(&self, body: usize) -> Pose {
        self.robot_body_placements[body].pose_in_link
    }

    /// Returns the name of what a body belongs to.
    pub(crate) fn item_of_body(&self, body: usize) -> Item<'_> {
        match self.robot_body_placements.get(body) {
            None => Item::Obstacle(&self.obstacle_names[body - self.robot_body_placements.len()]),
            Some(RobotBodyPlacement {
                attached_name: Some(name),
                ..
            }) => Item::Attached(name),
            Some(placement) => Item::Link(&self.robot.links()[placement.link].name),
        }
    }

    /// Adds a body that the robot holds.
    fn add_robot_body(&mut self, body: Arc<Body>, placement: RobotBodyPlacement) {
        let (frame, link_pose) = self.kinematics.link_frame_and_pose(placement.link);
        let pose = link_pose.compose(&placement.pose_in_link);
        let placed = PlacedBody::new(body, pose, frame, MAX_LINK_PARTS);
        let number = self.robot_body_placements.len();
        self.robot_body_placements.push(placement);
        self.robot_part_count += self.insert(number, placed);
        self.fit_planes();
    }

    /// Inserts a body with its parts, and returns the number of the parts.
    fn insert(&mut self, number: usize, placed: PlacedBody) -> usize {
        let first = self.parts.partition_point(|part| part.owner < number);
        for part in &mut self.parts[first..] {
            part.owner += 1;
        }
        self.margins.insert_body(number);
        self.allowed
            .reindex(|body| Some(if body < number { body } else { body + 1 }));
        let parts = placed.parts(number);
        let count = parts.len();
        self.parts.splice(first..first, parts);
        self.bodies.insert(number, placed);
        self.smallest_item = OnceLock::new();
        count
    }

    /// Replaces a body by one with as many parts.
    fn replace(&mut self, number: usize, placed: PlacedBody) {
        let parts = placed.parts(number);
        let first = self.parts.partition_point(|part| part.owner < number);
        self.parts.splice(first..first + parts.len(), parts);
        self.bodies[number] = placed;
    }

    fn remove(&mut self, number: usize) {
        self.bodies.remove(number);
        self.smallest_item = OnceLock::new();
        let after_removal = |body: usize| match body.cmp(&number) {
            Ordering::Less => Some(body),
            Ordering::Equal => None,
            Ordering::Greater => Some(body - 1),
        };
        self.margins.remove_body(number, after_removal);
        self.allowed.reindex(after_removal);
        self.parts.retain(|part| part.owner != number);
        for part in &mut self.parts {
            if part.owner > number {
                part.owner -= 1;
            }
        }
    }

    fn check_new_name(&self, name: &str) -> Result<(), RobotError> {
        if name.is_empty() {
            return Err(RobotError::EmptyName);
        }
        match self.item_named(name) {
            Ok(_) => Err(RobotError::NameTaken { name: name.into() }),
            Err(_) => Ok(()),
        }
    }

    fn obstacle_index(&self, name: &str) -> Result<usize, RobotError> {
        let number = self.obstacle_names.iter().position(|other| other == name);
        number.ok_or_else(|| RobotError::NoSuchObstacle { name: name.into() })
    }

    fn attached_body_index(&self, name: &str) -> Result<usize, RobotError> {
        let has_name =
            |placement: &RobotBodyPlacement| placement.attached_name.as_deref() == Some(name);
        let number = self.robot_body_placements.iter().position(has_name);
        number.ok_or_else(|| RobotError::NoSuchAttachedBody { name: name.into() })
    }
}

impl RobotBodyPlacement {
    fn for_link_body(link: usize, pose: Pose) -> Self {
        RobotBodyPlacement {
            link,
            pose_in_link: pose,
            attached_name: None,
        }
    }
}

#[cfg(test)]
mod tests;
