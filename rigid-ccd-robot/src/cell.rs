//! A robot among obstacles.

pub(crate) mod part;

use crate::edge::kinematics::Kinematics;
use crate::error::RobotError;
use crate::pairs::LinkPairs;
use crate::robot::Robot;
use crate::tuning::{MAX_LINK_PARTS, MAX_OBSTACLE_PARTS};
use part::{Part, PlacedBody};
use rigid_ccd::{Body, Pose};
use std::sync::Arc;

/// A robot among obstacles that rest in the frame of its base.
#[derive(Clone, Debug)]
pub struct Cell {
    robot: Robot,
    pairs: LinkPairs,
    kinematics: Kinematics,
    /// The bodies of the robot's links, then the obstacles.
    bodies: Vec<PlacedBody>,
    /// The convex parts of all bodies, in the order of the bodies.
    parts: Vec<Part>,
    robot_part_count: usize,
    /// For each body of the robot, the numbers of its link and of the body in the link.
    places: Vec<[usize; 2]>,
    obstacle_names: Vec<String>,
}

impl Cell {
    /// Creates a cell without obstacles. Pairs of links that are not checked may touch.
    pub fn new(robot: Robot, pairs: LinkPairs) -> Self {
        let kinematics = Kinematics::of_robot(&robot);
        let mut cell = Cell {
            robot,
            pairs,
            kinematics,
            bodies: Vec::new(),
            parts: Vec::new(),
            robot_part_count: 0,
            places: Vec::new(),
            obstacle_names: Vec::new(),
        };
        for (number, link) in cell.robot.links().iter().enumerate() {
            let (frame, link_pose) = cell.kinematics.link(number);
            for (k, held) in link.bodies.iter().enumerate() {
                let pose = link_pose.compose(&held.pose);
                cell.bodies
                    .push(PlacedBody::new(Arc::clone(&held.body), pose, frame));
                cell.places.push([number, k]);
            }
        }
        for (owner, placed) in cell.bodies.iter().enumerate() {
            cell.parts
                .extend(Part::of_body(placed, owner, MAX_LINK_PARTS));
        }
        cell.robot_part_count = cell.parts.len();
        cell
    }

    /// Adds an obstacle at a pose in the frame of the robot's base.
    ///
    /// # Errors
    /// [`RobotError::ObstacleNameTaken`].
    pub fn add_obstacle(
        &mut self,
        name: impl Into<String>,
        body: impl Into<Arc<Body>>,
        pose: Pose,
    ) -> Result<(), RobotError> {
        let name = name.into();
        if self.obstacle_names.contains(&name) {
            return Err(RobotError::ObstacleNameTaken { name });
        }
        self.obstacle_names.push(name);
        let placed = PlacedBody::new(body.into(), pose, 0);
        let parts = Part::of_body(&placed, self.bodies.len(), MAX_OBSTACLE_PARTS);
        self.parts.extend(parts);
        self.bodies.push(placed);
        Ok(())
    }

    /// Returns the robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Returns the names of the obstacles, in the order in which they were added.
    pub fn obstacle_names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.obstacle_names.iter().map(String::as_str)
    }

    pub(crate) fn kinematics(&self) -> &Kinematics {
        &self.kinematics
    }

    /// Returns the bodies of the robot's links, followed by the obstacles.
    pub(crate) fn bodies(&self) -> &[PlacedBody] {
        &self.bodies
    }

    pub(crate) fn robot_body_count(&self) -> usize {
        self.places.len()
    }

    /// Returns the convex parts of all bodies, in the order of the bodies.
    pub(crate) fn parts(&self) -> &[Part] {
        &self.parts
    }

    pub(crate) fn robot_part_count(&self) -> usize {
        self.robot_part_count
    }

    /// Returns the number of the link of one of the robot's bodies.
    pub(crate) fn link_of(&self, body: usize) -> usize {
        self.places[body][0]
    }

    /// Returns the pose of one of the robot's bodies in its link.
    pub(crate) fn pose_in_link(&self, body: usize) -> Pose {
        let [link, number] = self.places[body];
        self.robot.links()[link].bodies[number].pose
    }

    /// Returns the name of an obstacle by its number among all bodies.
    pub(crate) fn obstacle_name(&self, body: usize) -> &str {
        &self.obstacle_names[body - self.places.len()]
    }

    /// Iterates over the pairs of the robot's own parts that are checked, each with the nearest frame above both.
    pub(crate) fn own_pairs(&self) -> impl Iterator<Item = ([usize; 2], usize)> {
        let parts_of = move |link: usize| {
            (0..self.robot_part_count)
                .filter(move |&part| self.link_of(self.parts[part].owner) == link)
        };
        let pairs = self.pairs.checked();
        let pairs = pairs.flat_map(move |[one, other]| {
            parts_of(one).flat_map(move |a| parts_of(other).map(move |b| [b, a]))
        });
        pairs.map(move |pair| {
            let frames = pair.map(|part| self.parts[part].frame);
            (pair, self.kinematics.common_frame(frames))
        })
    }
}
