//! The planning scene: a robot among static obstacles.

pub(crate) mod ball_model;
mod clusters;
mod compared;
pub(crate) mod cover;
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
use ball_model::BallModel;
use compared::AllowedPairs;
use margins::Margins;
use part::{HullPart, PlacedBody};
use rigid_ccd::{Body, Pose};
use std::cmp::Ordering;
use std::sync::{Arc, OnceLock};

/// A planning scene: a robot among obstacles that are static in the frame of its base.
///
/// Links, attached bodies and obstacles are identified by name. A name is unique in the cell.
#[derive(Clone, Debug)]
pub struct Cell {
    robot: Robot,
    pairs: LinkPairs,
    kinematics: Kinematics,
    /// The bodies of the robot's links, then attached bodies, then obstacles. A body's index is its position in this
    /// list.
    bodies: Vec<PlacedBody>,
    /// The convex parts of all bodies, sorted by body.
    parts: Vec<HullPart>,
    robot_part_count: usize,
    /// The link and the pose of each body of the robot, attached bodies included. Same indices as `bodies`.
    robot_body_placements: Vec<RobotBodyPlacement>,
    obstacle_names: Vec<String>,
    margins: Margins,
    allowed: AllowedPairs,
    size_scale: SizeScale,
    /// The smallest body of nonzero size: its index and its size. Computed when it is first needed.
    smallest_item: OnceLock<Option<(usize, f64)>>,
    /// Covers and tables of the robot. Computed when the first solver is made.
    ball_model: OnceLock<Arc<BallModel>>,
}

/// The link to which a body is fixed, and the body's pose in the link's frame.
#[derive(Clone, Debug)]
struct RobotBodyPlacement {
    /// The index of the link.
    link: usize,
    /// The pose of the body in the link's frame.
    pose_in_link: Pose,
    /// The name of an attached body; `None` for a body of the link itself.
    attached_name: Option<String>,
}

/// The name of a link, of an attached body or of an obstacle.
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

/// A body of a cell, and the link to which it is fixed.
#[derive(Clone, Copy, Debug)]
pub struct AttachedBody<'c> {
    /// The link, attached body or obstacle that the body belongs to.
    pub item: Item<'c>,
    /// The body.
    pub body: &'c Body,
    /// The index of the link to which the body is fixed; for an obstacle, the base.
    pub link: usize,
    /// The pose of the body in the frame of the link.
    pub pose: Pose,
}

impl Cell {
    /// Creates a cell without obstacles. `pairs` says which pairs of links are checked against each other.
    pub fn new(robot: Robot, pairs: LinkPairs) -> Self {
        let kinematics = Kinematics::of_robot(&robot);
        let mut cell = Cell {
            margins: Margins::default(),
            allowed: AllowedPairs::default(),
            size_scale: robot.size_scale(),
            smallest_item: OnceLock::new(),
            ball_model: OnceLock::new(),
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
                cell.add_to_robot(Some(body.body), (link, body.pose), None);
            }
        }
        for link in 0..cell.robot.links().len() {
            for plane in cell.robot.links()[link].planes.clone() {
                cell.add_to_robot(None, (link, plane), None);
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
        let index = self.robot_body_placements.len() + self.obstacle_index(name)?;
        RobotError::check_pose("obstacle", name, &pose)?;
        let moved = self.bodies[index].moved_to(pose);
        self.replace(index, moved);
        Ok(())
    }

    /// Removes an obstacle. Its clearances and allowed contacts are removed, too.
    ///
    /// # Errors
    /// [`RobotError::NoSuchObstacle`].
    pub fn remove_obstacle(&mut self, name: &str) -> Result<(), RobotError> {
        let obstacle = self.obstacle_index(name)?;
        self.obstacle_names.remove(obstacle);
        self.remove(self.robot_body_placements.len() + obstacle);
        Ok(())
    }

    /// Attaches a body to a link at a pose in the link's frame, such as an object in a gripper. The body moves with
    /// the link.
    ///
    /// It may touch the link, the links that are fixed to it, and the items named in `may_touch`.
    /// [`Cell::allow_contact`] allows further contacts later.
    ///
    /// # Errors
    /// [`RobotError::NameTaken`], [`RobotError::EmptyName`], [`RobotError::NoSuchLink`], [`RobotError::TooFar`], and
    /// [`RobotError::NoSuchItem`] for an unknown name in `may_touch`.
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
        let index = self.robot_body_placements.len();
        self.add_to_robot(Some(body.into()), (link, pose), Some(name));
        self.allow_contacts_of_attached(index, &may_touch);
        Ok(())
    }

    /// Removes an attached body. Its clearances and allowed contacts are removed, too.
    ///
    /// # Errors
    /// [`RobotError::NoSuchAttachedBody`].
    pub fn detach(&mut self, name: &str) -> Result<(), RobotError> {
        let index = self.attached_body_index(name)?;
        self.robot_body_placements.remove(index);
        let parts = self.parts.iter().filter(|part| part.owner == index);
        self.robot_part_count -= parts.count();
        self.ball_model = OnceLock::new();
        self.remove(index);
        Ok(())
    }

    /// Returns the robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Returns the pairs of links that are checked.
    pub fn link_pairs(&self) -> &LinkPairs {
        &self.pairs
    }

    /// Returns the names of the obstacles in the order of their addition.
    pub fn obstacle_names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.obstacle_names.iter().map(String::as_str)
    }

    /// Returns the names of the attached bodies in the order of their attachment.
    pub fn attached_names(&self) -> impl Iterator<Item = &str> {
        let placements = self.robot_body_placements.iter();
        placements.filter_map(|placement| placement.attached_name.as_deref())
    }

    /// Returns the link, attached body or obstacle with this name.
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

    /// Returns all bodies at a configuration, each with its item and its pose in the base frame.
    ///
    /// # Errors
    /// [`RobotError::WrongPositionCount`], [`RobotError::InvalidPosition`].
    pub fn placed_bodies(
        &self,
        configuration: &[f64],
    ) -> Result<Vec<(Item<'_>, &Body, Pose)>, RobotError> {
        let bodies = self.carried_bodies().map(|carried| {
            let pose = match carried.item {
                Item::Obstacle(_) => carried.pose,
                Item::Link(_) | Item::Attached(_) => {
                    let link = &self.robot.links()[carried.link].name;
                    let link_pose = self.robot.pose(link, configuration)?;
                    link_pose.compose(&carried.pose)
                }
            };
            Ok((carried.item, carried.body, pose))
        });
        bodies.collect()
    }

    /// Returns all bodies, each with the link to which it is fixed. The order is the same as in
    /// [`Cell::placed_bodies`].
    pub fn carried_bodies(&self) -> impl ExactSizeIterator<Item = AttachedBody<'_>> {
        let bodies = self.bodies.iter().enumerate();
        bodies.map(|(index, placed)| {
            let placement = self.robot_body_placements.get(index);
            let on_base = (self.robot.base(), placed.pose);
            let (link, pose) = placement.map_or(on_base, |placement| {
                (placement.link, placement.pose_in_link)
            });
            AttachedBody {
                item: self.item_of_body(index),
                body: &placed.body,
                link,
                pose,
            }
        })
    }

    pub(crate) fn kinematics(&self) -> &Kinematics {
        &self.kinematics
    }

    /// Returns all bodies: first the robot's, attached bodies included, then the obstacles.
    pub(crate) fn bodies(&self) -> &[PlacedBody] {
        &self.bodies
    }

    /// Returns the number of the robot's bodies, attached bodies included.
    pub(crate) fn robot_body_count(&self) -> usize {
        self.robot_body_placements.len()
    }

    /// Returns the convex parts of all bodies, sorted by body.
    pub(crate) fn parts(&self) -> &[HullPart] {
        &self.parts
    }

    pub(crate) fn robot_part_count(&self) -> usize {
        self.robot_part_count
    }

    /// Returns the index of the link to which a body of the robot is fixed.
    pub(crate) fn link_of(&self, body: usize) -> usize {
        self.robot_body_placements[body].link
    }

    /// Returns the pose of a body of the robot in the frame of its link.
    pub(crate) fn pose_in_link(&self, body: usize) -> Pose {
        self.robot_body_placements[body].pose_in_link
    }

    /// Returns the item that a body belongs to.
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

    /// Adds a body that is fixed to a link, or the plane of a static link if `body` is `None`.
    fn add_to_robot(
        &mut self,
        body: Option<Arc<Body>>,
        (link, pose_in_link): (usize, Pose),
        attached_name: Option<String>,
    ) {
        let (frame, link_pose) = self.kinematics.link_frame_and_pose(link);
        let pose = link_pose.compose(&pose_in_link);
        let placed = match body {
            Some(body) => PlacedBody::new(body, pose, frame, MAX_LINK_PARTS),
            None => PlacedBody::for_plane(pose, self.plane_reach()),
        };
        let index = self.robot_body_placements.len();
        self.robot_body_placements.push(RobotBodyPlacement {
            link,
            pose_in_link,
            attached_name,
        });
        self.robot_part_count += self.insert(index, placed);
        self.ball_model = OnceLock::new();
        self.fit_planes();
    }

    /// Inserts a body and its parts at a body index. Returns the number of its parts.
    fn insert(&mut self, index: usize, placed: PlacedBody) -> usize {
        let first = self.parts.partition_point(|part| part.owner < index);
        for part in &mut self.parts[first..] {
            part.owner += 1;
        }
        self.margins.insert_body(index);
        self.allowed
            .reindex(|body| Some(if body < index { body } else { body + 1 }));
        let parts = placed.parts(index);
        let count = parts.len();
        self.parts.splice(first..first, parts);
        self.bodies.insert(index, placed);
        self.smallest_item = OnceLock::new();
        count
    }

    /// Replaces a body. The new body must have the same number of parts.
    fn replace(&mut self, index: usize, placed: PlacedBody) {
        let parts = placed.parts(index);
        let first = self.parts.partition_point(|part| part.owner < index);
        self.parts.splice(first..first + parts.len(), parts);
        self.bodies[index] = placed;
    }

    fn remove(&mut self, index: usize) {
        self.bodies.remove(index);
        self.smallest_item = OnceLock::new();
        let index_after_removal = |body: usize| match body.cmp(&index) {
            Ordering::Less => Some(body),
            Ordering::Equal => None,
            Ordering::Greater => Some(body - 1),
        };
        self.margins.remove_body(index, index_after_removal);
        self.allowed.reindex(index_after_removal);
        self.parts.retain(|part| part.owner != index);
        for part in &mut self.parts {
            if part.owner > index {
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
        let index = self
            .obstacle_names
            .iter()
            .position(|obstacle| obstacle == name);
        index.ok_or_else(|| RobotError::NoSuchObstacle { name: name.into() })
    }

    fn attached_body_index(&self, name: &str) -> Result<usize, RobotError> {
        let has_name =
            |placement: &RobotBodyPlacement| placement.attached_name.as_deref() == Some(name);
        let index = self.robot_body_placements.iter().position(has_name);
        index.ok_or_else(|| RobotError::NoSuchAttachedBody { name: name.into() })
    }
}

#[cfg(test)]
mod tests;
