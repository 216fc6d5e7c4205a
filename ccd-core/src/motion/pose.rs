//! Rigid transforms: poses of bodies and frames.

use crate::error::{InputError, check_finite};
use crate::math::vector::scale_and_inverse;
use glam::{DMat3, DQuat, DVec3};

/// The position and orientation of a body in the world: `x ↦ rotation · x + translation`.
///
/// ```
/// use ccd_core::{glam::{DQuat, DVec3}, Pose};
/// let pose = Pose::new(DVec3::X, DQuat::from_rotation_z(1.0)).unwrap();
/// assert_eq!(pose.transform_point(DVec3::ZERO), DVec3::X);
/// assert_eq!(Pose::at([1.0, 0.0, 0.0]).unwrap().translation(), DVec3::X);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    translation: DVec3,
    rotation: DQuat,
}

impl Pose {
    /// The pose of a body whose frame equals the world's.
    pub const IDENTITY: Pose = Pose {
        translation: DVec3::ZERO,
        rotation: DQuat::IDENTITY,
    };

    /// Creates a pose from a translation and a quaternion. The quaternion has the order x, y, z, w, and is normalised.
    ///
    /// Both parts are arrays, or types that convert to arrays: vectors of `glam` and `nalgebra`,
    /// quaternions of `glam`, the `coords` of quaternions of `nalgebra`.
    ///
    /// # Errors
    /// [`InputError::NotFinite`] for a NaN or infinite part, [`InputError::ZeroQuaternion`].
    pub fn new(
        translation: impl Into<[f64; 3]>,
        rotation: impl Into<[f64; 4]>,
    ) -> Result<Self, InputError> {
        let translation = DVec3::from_array(translation.into());
        let rotation = DQuat::from_array(rotation.into());
        check_finite("position", translation.is_finite())?;
        check_finite("quaternion", rotation.is_finite())?;
        match unit_quaternion(rotation) {
            Some(rotation) => Ok(Pose::from_unit_quaternion(translation, rotation)),
            None => Err(InputError::ZeroQuaternion),
        }
    }

    /// Creates a pose from a translation and a unit quaternion.
    pub(crate) fn from_unit_quaternion(translation: DVec3, rotation: DQuat) -> Self {
        Pose {
            translation,
            rotation,
        }
    }

    /// Creates a pose at a position, with the world's orientation.
    ///
    /// # Errors
    /// [`InputError::NotFinite`].
    pub fn at(translation: impl Into<[f64; 3]>) -> Result<Self, InputError> {
        Pose::new(translation, DQuat::IDENTITY)
    }

    /// Returns the position of the body's origin in the world.
    pub fn translation(&self) -> DVec3 {
        self.translation
    }

    /// Returns the body's orientation, a unit quaternion.
    pub fn rotation(&self) -> DQuat {
        self.rotation
    }

    /// Returns the composition `self ∘ inner`: the pose of a body that has the pose `inner` in this body's frame.
    ///
    /// ```
    /// use ccd_core::{glam::{DQuat, DVec3}, Pose};
    /// let arm = Pose::new(DVec3::X, DQuat::from_rotation_z(1.0))?;
    /// let hand = Pose::at(2.0 * DVec3::X)?;
    /// let point = arm.compose(&hand).transform_point(DVec3::Y);
    /// assert!(point.distance(arm.transform_point(hand.transform_point(DVec3::Y))) < 1e-15);
    /// # Ok::<(), ccd_core::InputError>(())
    /// ```
    pub fn compose(&self, inner: &Pose) -> Pose {
        Pose::from_unit_quaternion(
            self.transform_point(inner.translation),
            (self.rotation * inner.rotation).normalize(),
        )
    }

    /// Returns the inverse pose: the pose of the world in the body's frame.
    pub fn inverse(&self) -> Pose {
        let rotation = self.rotation.conjugate();
        Pose::from_unit_quaternion(rotation * -self.translation, rotation)
    }

    /// Returns the pose translated by a vector.
    pub(crate) fn translated(&self, by: DVec3) -> Pose {
        Pose::from_unit_quaternion(self.translation + by, self.rotation)
    }

    /// Converts a point from the body's frame to the world's.
    pub fn transform_point(&self, point: DVec3) -> DVec3 {
        self.rotation * point + self.translation
    }
}

/// Normalises a finite quaternion of any length; `None` for zero.
fn unit_quaternion(rotation: DQuat) -> Option<DQuat> {
    let (scale, _) = scale_and_inverse(rotation.length_squared());
    let scaled = rotation * scale;
    let length = scaled.length();
    (length > 0.0).then(|| (scaled * length.recip()).normalize())
}

/// A rigid transform as a rotation matrix and a translation, the form that is cheapest to apply.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The rotation matrix; its columns are the images of the axes.
    pub rotation: DMat3,
    /// The translation; it is the image of the origin.
    pub translation: DVec3,
}

impl Frame {
    /// The identity transform.
    pub const IDENTITY: Frame = Frame {
        rotation: DMat3::IDENTITY,
        translation: DVec3::ZERO,
    };

    /// Transforms a point: `rotation · point + translation`.
    #[inline(always)]
    pub fn transform_point(&self, point: DVec3) -> DVec3 {
        self.rotation * point + self.translation
    }

    /// Transforms a point back: `rotationᵀ · (point − translation)`, the inverse of [`Frame::transform_point`].
    #[inline(always)]
    pub fn inverse_transform_point(&self, point: DVec3) -> DVec3 {
        self.inverse_transform_vector(point - self.translation)
    }

    /// Rotates a vector back: `rotationᵀ · vector`.
    #[inline(always)]
    pub fn inverse_transform_vector(&self, vector: DVec3) -> DVec3 {
        DVec3::new(
            self.rotation.x_axis.dot(vector),
            self.rotation.y_axis.dot(vector),
            self.rotation.z_axis.dot(vector),
        )
    }

    /// Returns the transform from `other`'s coordinates to this frame's: `self⁻¹ ∘ other`.
    #[inline(always)]
    pub fn transform_from(&self, other: &Frame) -> Frame {
        Frame {
            rotation: self.rotation.transpose() * other.rotation,
            translation: self.inverse_transform_point(other.translation),
        }
    }
}

impl From<Pose> for Frame {
    fn from(pose: Pose) -> Self {
        Frame {
            rotation: DMat3::from_quat(pose.rotation),
            translation: pose.translation,
        }
    }
}

#[cfg(test)]
mod tests;
