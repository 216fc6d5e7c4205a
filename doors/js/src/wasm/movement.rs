//! Movements of bodies: constant velocities, poses at times, a throw, the link of a robot.

use super::fault::Fault;
use super::poses::{POSE_LENGTH, pose_from_numbers, pose_to_numbers};
use rigid_ccd::glam::DVec3;
use rigid_ccd::trajectory::{Ballistic, LinkTrajectory, MovingBody, PosePath, Trajectory};
use rigid_ccd::{Body, InputError, Motion};
use rigid_ccd_robot::ChainBetween;
use std::rc::Rc;
use wasm_bindgen::prelude::wasm_bindgen;

/// The number of values of a motion: pose, velocity, angular velocity, center.
pub(crate) const MOTION_LENGTH: usize = POSE_LENGTH + 9;

/// The movement of a body. Clones share it.
#[wasm_bindgen]
#[derive(Clone, Debug)]
pub struct Movement(Rc<MovementKind>);

#[derive(Debug)]
enum MovementKind {
    Motion(Motion),
    /// A motion between two poses, and the time of the second pose.
    Between(Motion, f64),
    Ballistic(Ballistic),
    Poses(PosePath),
    Link(LinkMotion),
}

/// The motion of a robot's link while all joints move at constant rates.
#[derive(Debug)]
pub(crate) struct LinkMotion {
    pub(crate) chain: ChainBetween,
    /// The positions of the chain's joints at the start and at the end.
    pub(crate) ends: [Vec<f64>; 2],
    pub(crate) duration: f64,
}

#[wasm_bindgen]
impl Movement {
    /// Makes a motion at constant velocities from its numbers.
    ///
    /// # Errors
    /// A number that is not finite, or a zero quaternion.
    pub fn from_velocities(numbers: &[f64]) -> Result<Self, Fault> {
        Ok(Movement::new(MovementKind::Motion(motion_from_numbers(
            numbers,
        )?)))
    }

    /// Makes a motion from one pose to another.
    ///
    /// # Errors
    /// A number that is not finite, a zero quaternion, or a duration that is not positive.
    pub fn between(
        start: &[f64],
        end: &[f64],
        center: &[f64],
        duration: f64,
    ) -> Result<Self, Fault> {
        let start = pose_from_numbers(start).map_err(Fault::of_element("start"))?;
        let end = pose_from_numbers(end).map_err(Fault::of_element("end"))?;
        let motion = Motion::between(start, end, vector(center), duration)?;
        Ok(Movement::new(MovementKind::Between(motion, duration)))
    }

    /// Makes a throw from the numbers of a motion and an acceleration.
    ///
    /// # Errors
    /// As for [`Movement::from_velocities`].
    pub fn ballistic(numbers: &[f64], acceleration: &[f64]) -> Result<Self, Fault> {
        let ballistic = Ballistic::new(motion_from_numbers(numbers)?, vector(acceleration))?;
        Ok(Movement::new(MovementKind::Ballistic(ballistic)))
    }

    /// Makes a path through poses at times. `angular_velocities` has an angular velocity from each pose to the next, or is
    /// `None`.
    ///
    /// # Errors
    /// An invalid pose (the error names its index), times that do not increase, or wrong angular velocities.
    pub fn pose_path(
        times: &[f64],
        poses: &[f64],
        center: &[f64],
        angular_velocities: Option<Vec<f64>>,
    ) -> Result<Self, Fault> {
        let poses = poses.as_chunks::<POSE_LENGTH>().0.iter().enumerate();
        let timed_poses = times.iter().zip(poses).map(|(&time, (k, numbers))| {
            let pose = pose_from_numbers(numbers);
            let pose = pose.map_err(Fault::of_element(format!("poses[{k}]")))?;
            Ok((time, pose))
        });
        let poses = PosePath::new(timed_poses.collect::<Result<_, Fault>>()?)?;
        let mut poses = poses.about(vector(center))?;
        if let Some(angular_velocities) = angular_velocities {
            poses =
                poses.with_angular_velocities(angular_velocities.as_chunks::<3>().0.to_vec())?;
        }
        Ok(Movement::new(MovementKind::Poses(poses)))
    }

    /// Returns the time at which the movement ends, or `None` if it has no end.
    pub fn end(&self) -> Option<f64> {
        match &*self.0 {
            MovementKind::Motion(_) | MovementKind::Ballistic(_) => None,
            MovementKind::Between(_, duration) => Some(*duration),
            MovementKind::Poses(poses) => Some(poses.end_time()),
            MovementKind::Link(link) => Some(link.duration),
        }
    }

    /// Returns the pose at a time as numbers.
    ///
    /// # Errors
    /// A time that is not finite.
    pub fn pose(&self, time: f64) -> Result<Vec<f64>, Fault> {
        if !time.is_finite() {
            return Err(Fault::of_range(format!("time: {time} is not finite")));
        }
        let pose = match &*self.0 {
            MovementKind::Motion(motion) | MovementKind::Between(motion, _) => motion.pose(time),
            MovementKind::Ballistic(ballistic) => Trajectory::pose(ballistic, time)?,
            MovementKind::Poses(poses) => poses.pose(time)?,
            MovementKind::Link(link) => Trajectory::pose(&link.trajectory()?, time)?,
        };
        Ok(pose_to_numbers(&pose))
    }
}

impl Movement {
    fn new(kind: MovementKind) -> Self {
        Movement(Rc::new(kind))
    }

    /// Makes the movement of a link. Fails if positions exceed the limits of joints.
    pub(crate) fn from_link(link: LinkMotion) -> Result<Self, InputError> {
        link.trajectory()?;
        Ok(Movement::new(MovementKind::Link(link)))
    }

    /// Returns the largest duration of a query. After it, joints could exceed their limits.
    pub(crate) fn latest_duration(&self) -> f64 {
        match &*self.0 {
            MovementKind::Link(link) => link.duration,
            _ => f64::INFINITY,
        }
    }

    /// Returns the angular velocity if this is a motion at constant velocities.
    pub(crate) fn constant_spin(&self) -> Option<DVec3> {
        match &*self.0 {
            MovementKind::Motion(motion) | MovementKind::Between(motion, _) => {
                Some(motion.angular_velocity())
            }
            MovementKind::Ballistic(_) | MovementKind::Poses(_) | MovementKind::Link(_) => None,
        }
    }

    /// Calls a function with the body that moves by this movement.
    pub(crate) fn with_body<T>(
        &self,
        body: &Body,
        call: impl FnOnce(MovingBody<'_>) -> Result<T, InputError>,
    ) -> Result<T, InputError> {
        match &*self.0 {
            MovementKind::Motion(motion) | MovementKind::Between(motion, _) => {
                call((body, *motion).into())
            }
            MovementKind::Ballistic(ballistic) => call((body, ballistic).into()),
            MovementKind::Poses(poses) => call((body, poses).into()),
            MovementKind::Link(link) => call((body, &link.trajectory()?).into()),
        }
    }
}

impl LinkMotion {
    fn trajectory(&self) -> Result<LinkTrajectory<'_>, InputError> {
        let [start, end] = &self.ends;
        let chain = self.chain.chain();
        chain.link(start.len(), start, end, self.duration)
    }
}

/// Makes a motion from its numbers.
pub(crate) fn motion_from_numbers(numbers: &[f64]) -> Result<Motion, InputError> {
    let vector_at = |start: usize| vector(numbers.get(start..).unwrap_or_default());
    Motion::about(
        pose_from_numbers(numbers)?,
        vector_at(POSE_LENGTH),
        vector_at(POSE_LENGTH + 3),
        vector_at(POSE_LENGTH + 6),
    )
}

fn vector(numbers: &[f64]) -> [f64; 3] {
    [0, 1, 2].map(|k| numbers.get(k).copied().unwrap_or(f64::NAN))
}
