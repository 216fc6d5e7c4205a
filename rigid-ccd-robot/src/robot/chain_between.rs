//! The motion of one link of a robot in the frame of another link.

use super::Robot;
use crate::error::RobotError;
use rigid_ccd::trajectory::Chain;

/// The chain of joints that moves one link of a robot in the frame of another link.
///
/// ```
/// # use rigid_ccd_robot::{Joint, Link, PositionRule, Robot};
/// # use rigid_ccd::{Pose, trajectory};
/// # let finger = |name: &str, y: f64, position_rule| -> Result<Joint, rigid_ccd::InputError> { Ok(Joint {
/// #     name: name.into(), parent: "hand".into(), child: format!("{name} finger"),
/// #     geometry: trajectory::Joint::prismatic(Pose::at([0.0, y, 0.0])?, [0.0, y.signum(), 0.0])?, position_rule }) };
/// # let follows = PositionRule::Follows { joint: "left".into(), multiplier: 1.0, offset: 0.0 };
/// # let joints = vec![finger("left", 0.1, PositionRule::Independent)?, finger("right", -0.1, follows)?];
/// # let links = ["hand", "left finger", "right finger"].map(Link::named).to_vec();
/// let gripper = Robot::new(links, joints)?;
/// let [left, right] = [gripper.link_number("left finger")?, gripper.link_number("right finger")?];
/// let right_from_left = gripper.chain_between(left, right);
/// // Both fingers move by 0.04, so the right finger moves by 0.08 in the frame of the left finger.
/// let open = right_from_left.positions(&gripper, &[0.04])?;
/// let closed = right_from_left.positions(&gripper, &[0.0])?;
/// let closing = right_from_left.chain().link(2, &open, &closed, 1.0)?;
/// # use rigid_ccd::trajectory::Trajectory;
/// let displacement = closing.pose(1.0)?.translation().y - closing.pose(0.0)?.translation().y;
/// assert!((displacement - 0.08).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ChainBetween {
    chain: Chain,
    /// For each joint of the chain, its index in the robot.
    joints: Vec<usize>,
}

impl ChainBetween {
    pub(super) fn new(chain: Chain, joints: Vec<usize>) -> Self {
        ChainBetween { chain, joints }
    }

    /// Returns the chain. Its last link is the link that moves.
    pub fn chain(&self) -> &Chain {
        &self.chain
    }

    /// Returns, for each joint of the chain, its index in the robot.
    pub(crate) fn joint_indices(&self) -> &[usize] {
        &self.joints
    }

    /// Returns the positions of the chain's joints at a configuration of the robot. The position of a mimic joint is
    /// rounded once. If a mimic joint follows another mimic joint, its multiplier and offset are also rounded, once for
    /// each joint that is followed.
    ///
    /// # Errors
    /// [`RobotError::WrongPositionCount`], [`RobotError::InvalidPosition`].
    pub fn positions(&self, robot: &Robot, configuration: &[f64]) -> Result<Vec<f64>, RobotError> {
        robot.check_configuration(configuration)?;
        let joints = self.joints.iter();
        Ok(joints
            .map(|&joint| robot.position(joint, configuration))
            .collect())
    }
}
