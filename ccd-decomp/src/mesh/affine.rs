//! Affine maps that transform meshes.

use crate::exact::predicates::determinant_sign;
use ccd_core::Pose;
use ccd_core::glam::{DAffine3, DVec3};

/// An affine map of space: `x ↦ matrix · x + translation`. It may mirror, shear, or flatten.
///
/// It is made from a [`Pose`], from a pose and a factor, or from any `DAffine3` of `glam`.
///
/// ```
/// use ccd_core::Pose;
/// use ccd_core::glam::{DAffine3, DVec3, dvec3};
/// use ccd_decomp::AffineMap;
/// let doubled = AffineMap::from_scale_and_pose(2.0, Pose::at([0.0, 0.0, 5.0])?);
/// assert_eq!(doubled.apply(DVec3::ONE), dvec3(2.0, 2.0, 7.0));
/// let mirror = AffineMap::from(DAffine3::from_scale(dvec3(-1.0, 1.0, 1.0)));
/// assert!(mirror.reverses_orientation() && !doubled.reverses_orientation());
/// # Ok::<(), ccd_core::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AffineMap(DAffine3);

impl AffineMap {
    /// The identity map, which leaves every point in its place.
    pub const IDENTITY: AffineMap = AffineMap(DAffine3::IDENTITY);

    /// Creates the map that scales by a factor about the origin, and then applies a pose.
    pub fn from_scale_and_pose(factor: f64, pose: Pose) -> Self {
        AffineMap(DAffine3::from_scale_rotation_translation(
            DVec3::splat(factor),
            pose.rotation(),
            pose.translation(),
        ))
    }

    /// Returns the image of a point under the map.
    ///
    /// # Guarantee
    /// Exact for the identity. Otherwise each coordinate is off by at most `4u (|m x| + |n y| + |o z| + |t|)`, where
    /// `m n o` is its row of the matrix, `t` its translation, and `u` is 2⁻⁵³. Equal points have equal images.
    pub fn apply(&self, point: DVec3) -> DVec3 {
        if self.is_identity() {
            point
        } else {
            self.0.transform_point3(point)
        }
    }

    /// Returns whether the map reverses orientation, because its determinant is negative. The sign is exact for
    /// elements from 1e-45 to 1e45.
    pub fn reverses_orientation(&self) -> bool {
        let matrix = self.0.matrix3;
        determinant_sign([matrix.x_axis, matrix.y_axis, matrix.z_axis]).is_lt()
    }

    /// Returns the composition of two maps, which applies `first` before `self`. It is rounded, unless either is the
    /// identity.
    #[cfg(any(feature = "collada", feature = "gltf"))]
    pub(crate) fn compose_after(&self, first: &AffineMap) -> AffineMap {
        match (self.is_identity(), first.is_identity()) {
            (true, _) => *first,
            (_, true) => *self,
            (false, false) => AffineMap(self.0 * first.0),
        }
    }

    /// Returns whether the map takes all points to one point: its matrix is zero.
    #[cfg(feature = "gltf")]
    pub(crate) fn collapses_to_point(&self) -> bool {
        self.0.matrix3.to_cols_array() == [0.0; 9]
    }

    pub(crate) fn is_identity(&self) -> bool {
        self.0 == DAffine3::IDENTITY
    }
}

impl From<DAffine3> for AffineMap {
    fn from(map: DAffine3) -> Self {
        AffineMap(map)
    }
}

impl From<Pose> for AffineMap {
    fn from(pose: Pose) -> Self {
        AffineMap(DAffine3::from_rotation_translation(
            pose.rotation(),
            pose.translation(),
        ))
    }
}

#[cfg(test)]
mod tests;
