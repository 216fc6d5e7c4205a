//! Bounds of the rounding errors of the ball test, which computes in f32.
//!
//! The derivation follows that of the errors in f64, see `cell/rounding.rs`: each joint adds an error to the rotation of
//! the frames after it, and the error of a point is at most that of the rotations times the longest arm.

use crate::kinematics::Kinematics;
use crate::kinematics::joint_arms::JointMotion;
use std::f64::consts::PI;

/// The unit roundoff of f32: half the distance from 1 to the next number.
pub(super) const UNIT_ROUNDOFF: f64 = 0.5 * f32::EPSILON as f64;

/// The error that each joint adds to a rotation, in units of roundoff. A product of two rotations adds at most 9, the
/// rounding of the joint's constants 2. Each of two columns of the product of sine and cosine with two unit vectors adds
/// 19: 8 for sine and for cosine each, 3 for the sum. The sum is below 64, the Euclidean norm of all columns included.
const ROTATION_ERROR_PER_JOINT: f64 = 64.0;

/// The error of a sum of products of numbers that are given in f32, in units of roundoff.
const SUM_ERROR: f64 = 16.0;

/// The error of an angle, in units of roundoff of the largest angle: it is rounded once to f32, and its center by half a
/// unit of f64.
const ANGLE_ERROR: f64 = 2.0;

/// A factor that enlarges sums and products of a few numbers in f32 beyond their rounding errors.
pub(super) const ENLARGED: f64 = 1.0 + 1e-5;

/// Bounds of the errors on a segment.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LaneErrors {
    /// The error of the position of a ball's center.
    pub(super) position: f64,
    /// The error of its velocity.
    pub(super) velocity: f64,
    /// The error of a joint's angle.
    pub(super) angle: f64,
}

/// What the errors on a segment depend on.
#[derive(Clone, Copy, Debug)]
pub(super) struct ErrorSources<'p> {
    /// The longest distance of any point of a moving part from the base and from any joint axis.
    pub(super) longest_arm: f64,
    /// A bound of the error of poses in f64.
    pub(super) pose_rounding: f64,
    /// The motions of all joints.
    pub(super) motions: &'p [JointMotion],
}

impl LaneErrors {
    pub(super) fn new(kinematics: &Kinematics, sources: &ErrorSources<'_>) -> Self {
        let (mut largest_turn, mut turning, mut sliding, mut travel) = (0.0, 0.0, 0.0, 0.0);
        let joints = kinematics.joints();
        for (joint, motion) in joints.iter().zip(sources.motions) {
            if joint.is_prismatic {
                sliding += motion.rate;
                travel += motion.position;
            } else {
                turning += motion.rate;
                largest_turn = ccd_core::order::greater(largest_turn, motion.rate);
            }
        }
        let count = joints.len() as f64;
        let angle = ANGLE_ERROR * UNIT_ROUNDOFF * (PI + largest_turn);
        let rotation = ROTATION_ERROR_PER_JOINT * UNIT_ROUNDOFF * (count + 2.0) + count * angle;
        let arm = sources.longest_arm;
        LaneErrors {
            // In f64, angles and points have the error `pose_rounding`.
            position: (rotation + SUM_ERROR * UNIT_ROUNDOFF) * arm
                + SUM_ERROR * UNIT_ROUNDOFF * travel
                + 2.0 * sources.pose_rounding,
            // The velocity is the sum of the products of rates, axes and arms, whose errors are both that of rotations.
            // The error of angles in f64 is in `pose_rounding`.
            velocity: 4.0 * rotation * (turning * arm + sliding)
                + 2.0 * (turning + sliding / arm) * sources.pose_rounding,
            angle,
        }
    }
}
