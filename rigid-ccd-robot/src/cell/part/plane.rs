//! A half-space, and the distance of hulls from it.

use super::HullPart;
use ccd_core::order::greater;
use ccd_distance_gjk::DistanceBounds;
use rigid_ccd::Pose;
use rigid_ccd::glam::DVec3;
use rigid_ccd::oracle::Frame;

/// A plane in the frame of the base, and the half-space below it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    /// The unit normal, which points out of the half-space.
    pub(crate) normal: DVec3,
    /// The signed distance of the plane from the origin, along the normal.
    pub(crate) offset: f64,
}

impl Plane {
    /// Returns the plane `z = 0` of a frame at `pose`.
    pub(super) fn below(pose: &Pose) -> Self {
        let normal = pose.rotation() * DVec3::Z;
        Plane {
            normal,
            offset: normal.dot(pose.translation()),
        }
    }

    /// Returns the signed distance of a part's lowest corner above the plane, for the part's frame at `frame`.
    #[inline(always)]
    pub(crate) fn lowest_corner_height(&self, part: &HullPart, frame: &Frame) -> f64 {
        let (_, corner) = part.extremal_corner(frame.inverse_transform_vector(-self.normal));
        self.normal.dot(frame.transform_point(corner)) - self.offset
    }

    /// Returns the distance of a part's corners from the half-space, for the part's frame at `frame`.
    #[inline(always)]
    pub(crate) fn distance_bounds(&self, part: &HullPart, frame: &Frame) -> DistanceBounds {
        let height = self.lowest_corner_height(part, frame);
        DistanceBounds {
            lower: height,
            upper: greater(height, 0.0),
            axis: -self.normal,
        }
    }

    /// Returns a lower bound of the signed distance of a part above the plane, from its bounding box. The part's frame
    /// is at `frame`, and its center at `center` in the base frame.
    #[inline(always)]
    pub(crate) fn height_of(&self, part: &HullPart, frame: &Frame, center: DVec3) -> f64 {
        let normal_components = frame.inverse_transform_vector(self.normal).abs();
        self.normal.dot(center) - self.offset - normal_components.dot(part.half_extents)
    }
}
