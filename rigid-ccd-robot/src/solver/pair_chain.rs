//! The chain of joints by which one body of a cell moves as another one sees it.

use crate::cell::Cell;
use rigid_ccd::Pose;
use rigid_ccd::trajectory::{Chain, Joint};

/// A chain of joints of the robot, through which one of its bodies moves as another body sees it.
pub(crate) struct PairChain {
    pub(crate) chain: Chain,
    /// For each joint of the chain, the number of the moving joint; `None` for a fixed one.
    pub(crate) moving_joint_indices: Vec<Option<usize>>,
}

/// Makes the chain from a body of another link, or from the base, to a body of a link.
pub(crate) fn pair_chain(cell: &Cell, a: usize, b: Option<usize>) -> PairChain {
    let (robot, kinematics) = (cell.robot(), cell.kinematics());
    let seen_from = b.map_or(robot.base(), |b| cell.link_of(b));
    let between = robot.chain_between(seen_from, cell.link_of(a));
    let mut joints = Vec::new();
    let mut moving = Vec::new();
    if let Some(b) = b {
        joints.push(Joint::fixed(cell.pose_in_link(b)).reversed());
        moving.push(None);
    }
    // Configurations are checked already; positions within an edge are rounded.
    let unlimited = |joint: &Joint| joint.clone().with_limits(f64::NEG_INFINITY..=f64::INFINITY);
    joints.extend(between.chain().joints().iter().map(unlimited));
    let numbers = between.joint_indices().iter();
    moving.extend(numbers.map(|&joint| kinematics.moving_joint_index(joint)));
    joints.push(Joint::fixed(cell.pose_in_link(a)));
    moving.push(None);
    PairChain {
        chain: Chain::new(Pose::IDENTITY, joints),
        moving_joint_indices: moving,
    }
}
