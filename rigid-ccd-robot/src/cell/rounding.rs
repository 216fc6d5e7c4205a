//! The rounding of poses that are computed along an edge.

use super::part::HullPart;
use crate::kinematics::Kinematics;
use crate::kinematics::magnitude::Magnitude;
use ccd_core::order::greater;

/// Half the distance of 1 to the next number.
pub(crate) const U: f64 = 0.5 * f64::EPSILON;

/// The error of a rotation matrix for each joint. The product of two rotations rounds each entry by 3 units, and the
/// matrix by at most 9. The joint's rotation is a sum of three matrices, each a product of two, whose entries are rounded
/// by 8 units together: at most 24 for the matrix, and 8 for the quaternion of which it was made. The sine and the cosine
/// are rounded by 2. That is less than 64. The direction in which the corners of a hull are searched is rotated once more.
const ROTATION_ERROR_PER_JOINT: f64 = 64.0;

/// The rounding error of a joint's position that is interpolated between two configurations, in units of `U` times its
/// [`Magnitude::rounding`]. Interpolation rounds a difference, a product and a sum. For a joint that follows another one,
/// the magnitude includes its factor times the followed position, and its offset. That of a polynomial includes what its
/// degree adds. The difference to the position in the middle of an interval has the errors of both positions.
const POSITION_ERROR_ULPS: f64 = 16.0;

/// The share of the tolerance by which an answer may exceed it without a word. Near the base, and with the usual tolerances,
/// positions are rounded by less than a millionth of the tolerance.
pub(crate) const UNREPORTED_TOLERANCE_SHARE: f64 = 1e-3;

/// Bounds of the errors of what is computed with frames.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PoseRounding {
    /// The distance of a point of a part from the point itself, at most.
    pub(crate) of_points: f64,
    /// The distance of a unit vector from the vector itself, at most.
    pub(crate) of_directions: f64,
}

/// Returns a bound of the distance between points of all parts, as computed with frames along a path, and the points
/// themselves.
pub(crate) fn point_error_bound(
    kinematics: &Kinematics,
    parts: &[HullPart],
    magnitudes: impl Iterator<Item = Magnitude> + Clone,
) -> f64 {
    pose_rounding(kinematics, parts, magnitudes).of_points
}

/// Returns bounds of the errors of points and of directions.
pub(crate) fn pose_rounding(
    kinematics: &Kinematics,
    parts: &[HullPart],
    magnitudes: impl Iterator<Item = Magnitude> + Clone,
) -> PoseRounding {
    let joints = kinematics.joints();
    let (mut angles, mut slides) = (0.0, 0.0);
    for (joint, magnitude) in joints.iter().zip(magnitudes.clone()) {
        if joint.is_prismatic {
            slides += magnitude.rounding;
        } else {
            angles += magnitude.rounding;
        }
    }
    let turn = ROTATION_ERROR_PER_JOINT * (kinematics.total_joint_count + 2) as f64
        + POSITION_ERROR_ULPS * angles;
    let moving = (turn + POSITION_ERROR_ULPS) * largest_arm(kinematics, parts, magnitudes);
    // No joint turns what rests.
    let resting = parts.iter().filter(|part| part.frame == 0);
    let resting = resting.map(|part| part.coordinate_bound);
    let resting =
        (2.0 * ROTATION_ERROR_PER_JOINT + POSITION_ERROR_ULPS) * resting.fold(0.0, greater);
    PoseRounding {
        of_points: U * greater(moving, resting) + U * POSITION_ERROR_ULPS * slides,
        of_directions: U * (turn + POSITION_ERROR_ULPS),
    }
}

/// Returns a bound of the distance of any point of a part that moves from the base, and from any joint's axis. Without magnitudes,
/// joints that slide are at 0.
pub(crate) fn largest_arm(
    kinematics: &Kinematics,
    parts: &[HullPart],
    magnitudes: impl Iterator<Item = Magnitude>,
) -> f64 {
    let joints = kinematics.joints().iter().zip(magnitudes);
    let slides = joints.filter(|(joint, _)| joint.is_prismatic);
    let arms = slides.fold(kinematics.arm_length_sum, |arms, (_, magnitude)| {
        arms + magnitude.position
    });
    let moving = parts.iter().filter(|part| part.frame > 0);
    arms + moving.map(|part| part.coordinate_bound).fold(0.0, greater)
}
