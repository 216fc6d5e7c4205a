//! Boxes of joint positions.

use crate::cell::Cell;
use crate::robot::PositionSource;
use ccd_core::order::greater;
use rigid_ccd::trajectory::JointKind;
use std::f64::consts::PI;

/// A range of positions for each joint of a configuration. Those that do not matter have the width 0.
#[derive(Clone, Debug)]
pub(crate) struct JointBox {
    ranges: Vec<[f64; 2]>,
    /// The share of the volume of the box that was halved first.
    pub(crate) volume_share: f64,
}

impl JointBox {
    /// Returns the box of all positions of the joints that move two links against each other; `None` if a joint without
    /// limits does not come back to where it was after a turn, or if one slides beyond the reach of planes.
    pub(crate) fn of_joints_between(cell: &Cell, links: [usize; 2]) -> Option<Self> {
        let robot = cell.robot();
        let limits: Vec<[f64; 2]> = robot.limits().collect();
        let mut ranges: Vec<[f64; 2]> = limits
            .iter()
            .map(|&limits| [position_nearest_zero(limits); 2])
            .collect();
        let between = robot.chain_between(links[0], links[1]);
        for &joint in between.joint_numbers() {
            let Some(source) = robot.source(joint) else {
                continue;
            };
            let number = source.position_index();
            let [low, high] = limits[number];
            ranges[number] = if low.is_finite() && high.is_finite() {
                [low, high]
            } else {
                let kind = robot.joints()[joint].axis_and_limits.kind();
                let comes_back =
                    matches!(kind, JointKind::Revolute(_)) && source.has_integer_multiplier();
                comes_back.then_some([-PI, PI])?
            };
        }
        let ends = ranges.iter();
        let farthest: Vec<f64> = ends
            .map(|[low, high]| greater(low.abs(), high.abs()))
            .collect();
        cell.check_plane_reach(cell.kinematics().magnitudes(&farthest))
            .ok()?;
        Some(JointBox {
            ranges,
            volume_share: 1.0,
        })
    }

    /// Returns the configuration in the middle.
    pub(crate) fn middle(&self) -> Vec<f64> {
        self.ranges.iter().map(middle).collect()
    }

    /// Returns how far the position of a joint is at most from that in the middle.
    pub(crate) fn max_deviation(&self, source: PositionSource) -> f64 {
        let range = &self.ranges[source.position_index()];
        let ([low, high], middle) = (*range, middle(range));
        let half = if high - middle > middle - low {
            high - middle
        } else {
            middle - low
        };
        source.factor().abs() * half
    }

    /// Returns both halves along the joint whose width has the largest effect: its width times a weight for each joint.
    /// `None` for a box that cannot be halved.
    pub(crate) fn halves(&self, weights: &[f64]) -> Option<[Self; 2]> {
        let effect =
            |joint: usize| weights[joint] * (self.ranges[joint][1] - self.ranges[joint][0]);
        let joints = 0..self.ranges.len();
        let widest = joints.max_by(|&a, &b| effect(a).total_cmp(&effect(b)))?;
        let [low, high] = self.ranges[widest];
        let middle = middle(&self.ranges[widest]);
        if !(low < middle && middle < high) {
            return None;
        }
        Some([[low, middle], [middle, high]].map(|range| {
            let mut half = self.clone();
            half.ranges[widest] = range;
            half.volume_share *= 0.5;
            half
        }))
    }
}

fn middle([low, high]: &[f64; 2]) -> f64 {
    0.5 * low + 0.5 * high
}

/// Returns a position within limits for a joint that does not matter: that nearest to 0.
fn position_nearest_zero([low, high]: [f64; 2]) -> f64 {
    0.0f64.clamp(low, high)
}
