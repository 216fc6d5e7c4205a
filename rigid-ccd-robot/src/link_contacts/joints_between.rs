//! The joints that move two links relative to each other.

use super::joint_box::JointBox;
use crate::cell::Cell;
use crate::cell::rounding::{CoordinateBounds, PoseRounding, pose_rounding};
use ccd_core::order::greater;
use std::f64::consts::PI;

/// The moving joints between two links, and their positions in a configuration.
#[derive(Debug)]
pub(super) struct JointsBetween {
    /// The moving joints, from the first link to the second.
    pub(super) joints: Vec<JointBetween>,
    /// The indices of the same joints, parents first.
    pub(super) parents_first: Vec<usize>,
    /// The nearest common ancestor of both links' frames.
    pub(super) common_frame: usize,
    /// The box of all positions of these joints within their limits.
    pub(super) all_positions: JointBox,
    /// The rounding errors of the frames, for any position in the box.
    pub(super) rounding: PoseRounding,
    /// For each position of a box, its index in a configuration.
    position_indices: Vec<usize>,
    /// A configuration for the joints that are not between the links: each at 0, or at its limit nearest to 0.
    default_configuration: Vec<f64>,
}

/// A moving joint between two links.
#[derive(Clone, Copy, Debug)]
pub(super) struct JointBetween {
    /// The index among the moving joints.
    pub(super) moving_index: usize,
    /// The index of its position in a [`JointBox`].
    pub(super) box_index: usize,
    /// The absolute value of the multiplier from that position to the joint's position.
    pub(super) abs_multiplier: f64,
}

impl JointsBetween {
    /// Finds the joints between two links. Returns `None` if their positions cannot be bounded: an unlimited joint does
    /// not repeat after a turn, or a prismatic joint moves a body beyond the reach of the planes.
    pub(super) fn new(cell: &Cell, links: [usize; 2]) -> Option<Self> {
        let (robot, kinematics) = (cell.robot(), cell.kinematics());
        let link_chain = robot.chain_between(links[0], links[1]);
        let mut position_indices = Vec::new();
        let joint_indices = link_chain.joint_indices().iter();
        let moving_indices =
            joint_indices.filter_map(|&joint| kinematics.moving_joint_index(joint));
        let joints = moving_indices.map(|moving_index| {
            let source = kinematics.joints()[moving_index].source;
            let index = source.position_index;
            let known = position_indices.iter().position(|&other| other == index);
            let box_index = known.unwrap_or_else(|| {
                position_indices.push(index);
                position_indices.len() - 1
            });
            JointBetween {
                moving_index,
                box_index,
                abs_multiplier: source.multiplier.abs(),
            }
        });
        let joints: Vec<JointBetween> = joints.collect();
        let all_positions = all_positions(cell, &joints, &position_indices)?;
        let mut largest_positions = robot.configuration_nearest_zero();
        for (&index, &[low, high]) in position_indices.iter().zip(&all_positions.ranges) {
            largest_positions[index] = greater(low.abs(), high.abs());
        }
        cell.check_plane_reach(kinematics.magnitudes(&largest_positions))
            .ok()?;
        let mut parents_first: Vec<usize> = joints.iter().map(|joint| joint.moving_index).collect();
        parents_first.sort_unstable();
        let magnitudes: Vec<_> = kinematics.magnitudes(&largest_positions).collect();
        let magnitudes = magnitudes.iter().copied();
        Some(JointsBetween {
            rounding: pose_rounding(
                kinematics,
                CoordinateBounds::of_parts(cell.parts()),
                magnitudes,
            ),
            common_frame: kinematics
                .common_frame(links.map(|link| kinematics.link_frame_and_pose(link).0)),
            default_configuration: robot.configuration_nearest_zero(),
            joints,
            parents_first,
            all_positions,
            position_indices,
        })
    }

    /// Returns a configuration with the positions of these joints. All other joints have default positions.
    pub(super) fn configuration(&self, positions: &[f64]) -> Vec<f64> {
        let mut configuration = self.default_configuration.clone();
        for (&index, &position) in self.position_indices.iter().zip(positions) {
            configuration[index] = position;
        }
        configuration
    }
}

/// Returns the box of all positions of the joints between two links; `None` if it is unbounded.
fn all_positions(cell: &Cell, joints: &[JointBetween], indices: &[usize]) -> Option<JointBox> {
    let limits: Vec<[f64; 2]> = cell.robot().limits().collect();
    let mut ranges: Vec<[f64; 2]> = indices.iter().map(|&index| limits[index]).collect();
    for joint in joints {
        let moving = &cell.kinematics().joints()[joint.moving_index];
        let [low, high] = limits[indices[joint.box_index]];
        if !(low.is_finite() && high.is_finite()) {
            let repeats_after_turn = !moving.is_prismatic && moving.source.has_integer_multiplier();
            ranges[joint.box_index] = repeats_after_turn.then_some([-PI, PI])?;
        }
    }
    Some(JointBox::new(ranges))
}
