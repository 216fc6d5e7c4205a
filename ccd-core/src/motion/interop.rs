//! Conversions from and to the pose types of other libraries.

use super::pose::Pose;
use crate::error::InputError;
use glam::{DQuat, DVec3};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

impl TryFrom<Isometry3<f64>> for Pose {
    type Error = InputError;

    /// Converts a nalgebra isometry to a pose.
    ///
    /// # Errors
    /// [`InputError::NotFinite`] for a NaN or infinite part.
    fn try_from(isometry: Isometry3<f64>) -> Result<Self, InputError> {
        let t = isometry.translation.vector;
        let q = isometry.rotation.coords;
        Pose::new(
            DVec3::new(t.x, t.y, t.z),
            DQuat::from_xyzw(q.x, q.y, q.z, q.w),
        )
    }
}

impl From<Pose> for Isometry3<f64> {
    fn from(pose: Pose) -> Self {
        let (t, q) = (pose.translation(), pose.rotation());
        Isometry3::from_parts(
            Translation3::new(t.x, t.y, t.z),
            UnitQuaternion::new_normalize(Quaternion::new(q.w, q.x, q.y, q.z)),
        )
    }
}

#[cfg(test)]
mod tests;
