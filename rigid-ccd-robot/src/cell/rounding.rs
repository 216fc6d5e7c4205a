//! Bounds the rounding errors of poses that are computed along a path.

use super::part::HullPart;
use crate::kinematics::Kinematics;
use crate::kinematics::magnitude::Magnitude;
use ccd_core::order::greater;

/// The unit roundoff of f64: half the distance from 1 to the next number.
pub(crate) const U: f64 = 0.5 * f64::EPSILON;

/// The error that each joint adds to a rotation matrix, in units of `U`. The product of two rotations adds at most 9,
/// because each entry is rounded by at most 3. The rotation of the joint is a sum of three matrices, each the product
/// of two. Its entries are rounded by at most 8, which adds at most 24. The quaternion of the joint's origin adds 8,
/// sine and cosine add 2. A support point is searched along a rotated direction, whose error is included as well. The
/// sum is below 64.
const ROTATION_ERROR_PER_JOINT: f64 = 64.0;

/// The rounding error of an interpolated joint position, in units of `U` times its [`Magnitude::rounding`].
/// Interpolation rounds a difference, a product and a sum. A deviation from the position at an interval's midpoint has
/// the errors of two positions. The magnitude already covers the errors that the multiplier and the offset of a mimic
/// joint add, and grows with the degree of a polynomial.
const POSITION_ERROR_ULPS: f64 = 16.0;

/// An answer does not report a larger tolerance than the settings if it exceeds theirs by at most this fraction. With
/// usual tolerances and near the base, rounding errors are below a millionth of the tolerance.
pub(crate) const UNREPORTED_TOLERANCE_SHARE: f64 = 1e-3;

/// Error bounds of points and directions that are transformed by link frames.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PoseRounding {
    /// An upper bound of the error of a part's point.
    pub(crate) of_points: f64,
    /// An upper bound of the error of a unit vector.
    pub(crate) of_directions: f64,
}

/// Upper bounds of the numbers from which the corners of parts were computed, see [`HullPart::coordinate_bound`].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CoordinateBounds {
    of_moving_parts: f64,
    of_static_parts: f64,
}

impl CoordinateBounds {
    pub(crate) fn of_parts(parts: &[HullPart]) -> Self {
        let mut bounds = CoordinateBounds::default();
        for part in parts {
            let bound = if part.frame > 0 {
                &mut bounds.of_moving_parts
            } else {
                &mut bounds.of_static_parts
            };
            *bound = greater(*bound, part.coordinate_bound);
        }
        bounds
    }
}

/// Bounds the errors of points and of directions that are computed through the link frames.
pub(crate) fn pose_rounding(
    kinematics: &Kinematics,
    coordinates: CoordinateBounds,
    magnitudes: impl Iterator<Item = Magnitude> + Clone,
) -> PoseRounding {
    let joints = kinematics.joints();
    let (mut angles, mut translations) = (0.0, 0.0);
    for (joint, magnitude) in joints.iter().zip(magnitudes.clone()) {
        if joint.is_prismatic {
            translations += magnitude.rounding;
        } else {
            angles += magnitude.rounding;
        }
    }
    let rotation = ROTATION_ERROR_PER_JOINT * (kinematics.total_joint_count + 2) as f64
        + POSITION_ERROR_ULPS * angles;
    let error_of_moving =
        (rotation + POSITION_ERROR_ULPS) * largest_arm(kinematics, coordinates, magnitudes);
    // No joint rotates a static part.
    let error_of_static =
        (2.0 * ROTATION_ERROR_PER_JOINT + POSITION_ERROR_ULPS) * coordinates.of_static_parts;
    PoseRounding {
        of_points: U * greater(error_of_moving, error_of_static)
            + U * POSITION_ERROR_ULPS * translations,
        of_directions: U * (rotation + POSITION_ERROR_ULPS),
    }
}

/// Returns an upper bound of the distance from any point of a moving part to the base and to any joint axis. Prismatic
/// joints without a magnitude are assumed to be at 0.
pub(crate) fn largest_arm(
    kinematics: &Kinematics,
    coordinates: CoordinateBounds,
    magnitudes: impl Iterator<Item = Magnitude>,
) -> f64 {
    let joints = kinematics.joints().iter().zip(magnitudes);
    let prismatic = joints.filter(|(joint, _)| joint.is_prismatic);
    let chain_length = prismatic.fold(kinematics.arm_length_sum, |length, (_, magnitude)| {
        length + magnitude.position
    });
    chain_length + coordinates.of_moving_parts
}
