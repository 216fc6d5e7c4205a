//! Bounds on the velocities and accelerations of a link, accumulated joint by joint.

use crate::trajectory::joint::{Direction, Joint, JointKind};
use ccd_core::AccelerationBounds;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::order::lesser;
use ccd_core::vector::length;

/// Bounds on the derivatives of a link's pose, accumulated joint by joint.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LinkBounds {
    /// An upper bound of the angular speed, in radians per unit of time.
    max_angular_speed: f64,
    pub(super) acceleration_bounds: AccelerationBounds,
    /// The bounds on the derivatives of the accelerations.
    pub(super) jerk_bounds: AccelerationBounds,
    /// The common axis of all rotations so far, in the link's frame; `None` if their axes differ.
    common_rotation_axis: Option<DVec3>,
    /// The number of joints so far; a reversed joint counts twice, because its pose is rounded once more.
    pub(super) joint_count: f64,
    /// The sum of the lengths of the arms between joints; that of a joint which is passed backward counts twice.
    pub(super) arm_length_sum: f64,
    /// The sum of the joints' largest angles, in radians.
    pub(super) max_angle_sum: f64,
}

/// Bounds on a joint's position and rate over an interval of time, in radians or as a length.
pub(super) struct JointPositionBounds {
    /// The largest absolute value of the position in the interval.
    pub(super) max_abs_position: f64,
    /// The largest absolute value of the position in the interval and at time 0. All positions are computed from the
    /// one at time 0.
    pub(super) max_abs_with_start: f64,
    pub(super) first_position: f64,
    /// The absolute value of the joint's rate.
    pub(super) joint_speed: f64,
}

impl JointPositionBounds {
    /// Returns the largest distance by which a prismatic joint slides; 0 for other joints.
    fn max_slide_distance(&self, joint: &Joint) -> f64 {
        match joint.kind() {
            JointKind::Prismatic(_) => self.max_abs_with_start,
            JointKind::Fixed | JointKind::Revolute(_) => 0.0,
        }
    }
}

impl LinkBounds {
    /// Updates the bounds from the link before a joint to the link after it.
    pub(super) fn move_past_joint(&mut self, joint: &Joint, positions: &JointPositionBounds) {
        let arm = length(joint.origin().translation());
        // The frame of the joint's axis as seen from the link before the joint.
        let frame = joint.origin().rotation();
        match joint.direction() {
            Direction::Forward => {
                self.joint_count += 1.0;
                self.arm_length_sum += arm + positions.max_slide_distance(joint);
                self.add_arm_motion(arm);
                self.common_rotation_axis = self
                    .common_rotation_axis
                    .map(|axis| frame.conjugate() * axis);
                self.add_joint_motion(joint, positions);
            }
            Direction::Backward => {
                // The inverse of a pose is rounded once more, at most as the product with another one.
                self.joint_count += 2.0;
                self.arm_length_sum += 2.0 * (arm + positions.max_slide_distance(joint));
                self.add_joint_motion(joint, positions);
                self.add_arm_motion(arm);
                self.common_rotation_axis = self.common_rotation_axis.map(|axis| frame * axis);
            }
        }
    }

    /// Adds the bounds due to a joint's motion about or along its axis. The common axis is in the frame of the joint's
    /// axis.
    fn add_joint_motion(&mut self, joint: &Joint, positions: &JointPositionBounds) {
        let JointPositionBounds {
            joint_speed: rate, ..
        } = *positions;
        match joint.kind() {
            JointKind::Fixed => {}
            JointKind::Prismatic(_) => {
                self.add_arm_motion(positions.max_abs_position);
                let (turn, turning) = (
                    self.max_angular_speed,
                    self.acceleration_bounds.angular_acceleration,
                );
                self.jerk_bounds.linear_acceleration += 3.0 * rate * (turning + turn * turn);
                self.acceleration_bounds.linear_acceleration += 2.0 * turn * rate;
            }
            JointKind::Revolute(axis) => {
                self.max_angle_sum += positions.max_abs_with_start;
                if rate > 0.0 {
                    self.add_rotation(axis, rate);
                } else {
                    let position = match joint.direction() {
                        Direction::Forward => positions.first_position,
                        Direction::Backward => -positions.first_position,
                    };
                    let held = DQuat::from_axis_angle(axis, -position);
                    self.common_rotation_axis =
                        self.common_rotation_axis.map(|before| held * before);
                }
            }
        }
    }

    /// Adds the bounds due to the rotation of an arm of a given length that is fixed to the link.
    fn add_arm_motion(&mut self, length: f64) {
        let angular = self.max_angular_speed;
        let turning = self.acceleration_bounds.angular_acceleration;
        self.jerk_bounds.linear_acceleration += (self.jerk_bounds.angular_acceleration
            + (3.0 * turning + angular * angular) * angular)
            * length;
        self.acceleration_bounds.linear_acceleration += (turning + angular * angular) * length;
    }

    /// Adds the bounds due to a rotation at a nonzero rate about an axis, which is given in the joint's frame.
    fn add_rotation(&mut self, axis: DVec3, rate: f64) {
        let (across, common) = match (self.max_angular_speed > 0.0, self.common_rotation_axis) {
            (false, _) => (0.0, Some(axis)),
            (true, Some(common)) => {
                let across = length(common.cross(axis));
                // Axes that count as parallel may differ by as much each.
                let most = across + MAX_SINE_OF_PARALLEL_AXES * self.joint_count;
                (most, (across < MAX_SINE_OF_PARALLEL_AXES).then_some(common))
            }
            (true, None) => (1.0, None),
        };
        let swept = self.max_angular_speed * lesser(across, 1.0);
        self.jerk_bounds.angular_acceleration +=
            rate * (self.acceleration_bounds.angular_acceleration + self.max_angular_speed * swept);
        self.acceleration_bounds.angular_acceleration += rate * swept;
        self.max_angular_speed += rate;
        self.common_rotation_axis = common;
    }
}

/// The sine of the angle below which two axes count as parallel; it is far above rounding errors.
const MAX_SINE_OF_PARALLEL_AXES: f64 = 1e-12;
