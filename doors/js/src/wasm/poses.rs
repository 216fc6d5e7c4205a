//! Poses as seven numbers: the position, then the quaternion x, y, z, w.

use super::host::tell;
use rigid_ccd::{InputError, Pose, Remark};

/// The number of values of a pose.
pub(crate) const POSE_LENGTH: usize = 7;

/// Makes a pose from numbers, and normalises its quaternion.
pub(crate) fn pose_from_numbers(numbers: &[f64]) -> Result<Pose, InputError> {
    let number = |k: usize| numbers.get(k).copied().unwrap_or(f64::NAN);
    let quaternion = [3, 4, 5, 6].map(number);
    let is_zero = quaternion == [0.0; 4];
    tell(Remark::remark_on_quaternion(quaternion).filter(|_| !is_zero));
    Pose::new([number(0), number(1), number(2)], quaternion)
}

/// Returns a pose as numbers.
pub(crate) fn pose_to_numbers(pose: &Pose) -> Vec<f64> {
    let position = pose.translation().to_array();
    [&position[..], &pose.rotation().to_array()].concat()
}
