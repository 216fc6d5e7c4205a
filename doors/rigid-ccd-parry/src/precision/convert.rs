//! Converts numbers, vectors, poses and motions between parry's types and the engine's.

use super::library::math::{Pose as ParryPose, Real, Vector};
use super::library::query::NonlinearRigidMotion;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{InputError, Motion, Pose};

/// Converts parry's motion of a body to double precision. The path stays exactly the same.
///
/// parry's motion rotates about `local_center`, a point in the shape's frame that moves with the velocity `linvel`;
/// `angvel` is in the world frame. A [`Motion`] about this center is the same motion. Quaternions are normalised in
/// double precision. parry's own arithmetic scales a shape by the square of the quaternion's length.
///
/// # Errors
/// [`InputError::NotFinite`], [`InputError::ZeroQuaternion`].
#[doc = ""]
#[doc = "```"]
#[doc = concat!("use ", parry!(), "::math::{Pose, Vector};")]
#[doc = concat!("use ", parry!(), "::query::NonlinearRigidMotion;")]
/// let pose = Pose::translation(3.0, 0.0, 0.0);
/// let spins = NonlinearRigidMotion::new(pose, Vector::Y, Vector::X, Vector::Z);
#[doc = concat!("let motion = rigid_ccd_parry::", precision!(), "::motion(&spins)?;")]
/// let there = spins.position_at_time(2.0).translation.x as f64;
/// assert!((motion.pose(2.0).translation().x - there).abs() < 1e-5);
/// # Ok::<(), rigid_ccd::InputError>(())
/// ```
pub fn motion(motion: &NonlinearRigidMotion) -> Result<Motion, InputError> {
    Motion::about(
        pose_from_parry(&motion.start)?,
        point_from_parry(motion.linvel),
        point_from_parry(motion.angvel),
        point_from_parry(motion.local_center),
    )
}

/// Converts parry's pose to the engine's, in double precision.
pub(super) fn pose_from_parry(pose: &ParryPose) -> Result<Pose, InputError> {
    let q = pose.rotation;
    let [x, y, z, w] = [q.x, q.y, q.z, q.w].map(f64::from);
    Pose::new(
        point_from_parry(pose.translation),
        DQuat::from_xyzw(x, y, z, w),
    )
}

/// Converts a point or vector of parry to double precision.
pub(super) fn point_from_parry(v: Vector) -> DVec3 {
    DVec3::new(f64::from(v.x), f64::from(v.y), f64::from(v.z))
}

/// Converts a vector to parry's precision, rounded to nearest.
pub(super) fn vector(v: DVec3) -> Vector {
    Vector::new(v.x as Real, v.y as Real, v.z as Real)
}

/// Converts a time to parry's precision, rounded down.
pub(super) fn time(time: f64) -> Real {
    let nearest = time as Real;
    if f64::from(nearest) > time {
        nearest.next_down()
    } else {
        nearest
    }
}

#[cfg(test)]
mod tests;
