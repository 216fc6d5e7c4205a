//! How far points of a link are from the axes of the joints that move it, and what follows for their motion.

use super::Kinematics;
use ccd_core::order::greater;
use rigid_ccd::glam::DVec3;

/// Enlarges bounds to allow for rounding: a few sums and products for each joint.
const ROUNDING_FACTOR: f64 = 1.0 + 1e-11;

/// The joints between a frame and an ancestor, the nearest to the frame first.
#[derive(Clone, Debug)]
pub(crate) struct JointArms(Vec<JointArm>);

/// A joint between a frame and an ancestor.
#[derive(Clone, Copy, Debug)]
struct JointArm {
    joint: usize,
    is_prismatic: bool,
    /// An upper bound of the distance of the frame's points from the joint's axis, in any configuration in which all
    /// prismatic joints after it are at 0.
    length: f64,
}

/// Bounds of the motion of a joint, as absolute values.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct JointMotion {
    pub(crate) position: f64,
    pub(crate) rate: f64,
    /// The derivative of the rate.
    pub(crate) acceleration: f64,
}

impl JointArms {
    /// Returns the joints between a frame and its ancestor `seen_from`, with bounds for some points of the frame.
    pub(crate) fn new(
        kinematics: &Kinematics,
        (frame, points): (usize, &[DVec3]),
        seen_from: usize,
    ) -> Self {
        let lengths = points.iter().map(|point| point.length());
        let mut farthest = lengths.fold(0.0, greater);
        let mut arms = Vec::new();
        let mut at = frame;
        while at != seen_from {
            let joint = &kinematics.joints()[at - 1];
            let own_length = || {
                let axis = joint.axis_in_own_frame();
                let lengths = points.iter().map(|point| axis.cross(*point).length());
                lengths.fold(0.0, greater)
            };
            arms.push(JointArm {
                joint: at - 1,
                is_prismatic: joint.is_prismatic,
                length: ROUNDING_FACTOR * if at == frame { own_length() } else { farthest },
            });
            farthest += joint.origin.length();
            at = joint.parent;
        }
        JointArms(arms)
    }

    /// Bounds the second derivative of the points' positions relative to the ancestor frame, for the motions of all
    /// joints.
    ///
    /// Let `y` be the vector from a joint's origin to a point, seen from the frame after the joint, and `ρ` its largest
    /// distance from the joint's axis. The joint turns it at the rate `r`. Seen from the frame before the joint, the
    /// speed grows by at most `|r| ρ`, and the second derivative, with `ω × (ω × y)`, the Coriolis term `2 ω × ẏ` and
    /// `ω̇ × y`, by at most `r² ρ + 2 |r| |ẏ| + |ṙ| ρ`. A prismatic joint adds `|r|` to the speed, and `|ṙ|` to the
    /// second derivative.
    #[inline]
    pub(crate) fn acceleration_bound(&self, motion: impl Fn(usize) -> JointMotion) -> f64 {
        let (mut speed, mut acceleration, mut travel) = (0.0, 0.0, 0.0);
        for arm in &self.0 {
            let motion = motion(arm.joint);
            if arm.is_prismatic {
                speed += motion.rate;
                acceleration += motion.acceleration;
                travel += motion.position;
            } else {
                let length = arm.length + travel;
                let own_speed = motion.rate * length;
                acceleration +=
                    motion.rate * (own_speed + 2.0 * speed) + motion.acceleration * length;
                speed += own_speed;
            }
        }
        acceleration * ROUNDING_FACTOR
    }

    /// Bounds how far the points get if each joint deviates by at most some amount.
    #[inline]
    pub(crate) fn displacement_bound(&self, deviations: &[f64], motions: &[JointMotion]) -> f64 {
        let (mut displacement, mut travel) = (0.0, 0.0);
        for arm in &self.0 {
            let deviation = deviations[arm.joint];
            if arm.is_prismatic {
                displacement += deviation;
                travel += motions[arm.joint].position;
            } else {
                displacement += deviation * (arm.length + travel);
            }
        }
        displacement * ROUNDING_FACTOR
    }

    /// Returns the revolute joints with the lengths of their arms; `None` if there is a prismatic joint.
    pub(crate) fn revolute(&self) -> Option<Vec<(usize, f64)>> {
        let joints = self.0.iter();
        joints
            .map(|arm| (!arm.is_prismatic).then_some((arm.joint, arm.length)))
            .collect()
    }
}

#[cfg(test)]
mod tests;
