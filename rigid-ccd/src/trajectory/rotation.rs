//! Conversion of quaternions to rotation vectors.

use ccd_core::glam::{DQuat, DVec3};
use ccd_core::vector::length;

/// Returns the shortest rotation vector of a unit quaternion, in radians.
pub(super) fn rotation_vector(q: DQuat) -> DVec3 {
    let q = if q.w < 0.0 { -q } else { q };
    let sine = length(q.xyz());
    if sine > 0.0 {
        q.xyz() * (2.0 * sine.atan2(q.w) / sine)
    } else {
        DVec3::ZERO
    }
}
