//! The chain of joints that moves one body of a cell relative to another.

use crate::cell::Cell;
use rigid_ccd::Pose;
use rigid_ccd::trajectory::{Chain, Joint};

/// The chain of joints that moves one body relative to another.
pub(crate) struct PairChain {
    pub(crate) chain: Chain,
    /// For each joint of the chain, its index among the moving joints; `None` for a fixed joint.
    pub(crate) moving_joint_indices: Vec<Option<usize>>,
}

/// Creates the chain to body `a` from body `b` on another link, or from the base if `b` is `None`.
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
    // Removes the limits: configurations are checked already, and rounding may put a position between them outside.
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
