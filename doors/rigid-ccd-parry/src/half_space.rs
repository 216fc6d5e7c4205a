//! Replaces a half-space by a box that is large enough for one cast.
//!
//! In the half-space's frame, the other body stays within a ball about a point of the half-space during the cast. A box
//! that contains the part of the half-space in this ball, and little more, has the same contacts.

use crate::geometry::ShapeGeometry;
use crate::horizon::{MotionWithExtent, QueryDuration, repetition_time, rotation_period};
use crate::order::{greater, length, lesser};
use crate::tolerance::{MAX_HALF_SPACE_BOX_EXTENT, PLANE_HEIGHT_ROUNDING, ROUNDING_ENLARGEMENT};
use crate::{BodyOfShape, ShapeError};
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::vector::unit;

/// All points on one side of a plane through the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HalfSpace {
    /// The unit normal that points out of the half-space.
    normal: DVec3,
}

impl HalfSpace {
    /// Creates a half-space from the direction of its normal.
    ///
    /// # Errors
    /// [`ShapeError::InvalidSize`] for a normal that has no direction.
    pub(crate) fn new(normal: DVec3) -> Result<Self, ShapeError> {
        let invalid_normal = ShapeError::InvalidSize {
            what: "normal",
            value: length(normal),
        };
        let unit = unit(normal).filter(|_| normal.is_finite());
        unit.map(|normal| HalfSpace { normal })
            .ok_or(invalid_normal)
    }

    /// Returns the duration of the engine's query for a cast over a duration, with the contact distance
    /// `within`.
    ///
    /// `plane` is the half-space's motion, about any point of it.
    pub(crate) fn query_duration(
        &self,
        plane: MotionWithExtent,
        body: MotionWithExtent,
        within: f64,
        duration: f64,
    ) -> QueryDuration {
        let needed = self.duration_until_decided(plane, body, within);
        let needed = needed.map_or(duration, |needed| lesser(duration, needed));
        let horizon = QueryDuration::for_duration([plane, body], needed);
        // The box that replaces a plane is as wide as the displacement along it, and has its rounding.
        let size =
            body.max_radius + within + length(body.start_position() - plane.start_position());
        let speed = length(body.motion.velocity() - plane.motion.velocity());
        let longest_duration = MAX_HALF_SPACE_BOX_EXTENT * size / speed;
        if speed > 0.0 && horizon.duration() > longest_duration {
            QueryDuration::PartOfCast(longest_duration)
        } else {
            horizon
        }
    }

    /// Returns a time after which the body stays inside or outside of the half-space or repeats its motion; `None` if
    /// there is no such time.
    fn duration_until_decided(
        &self,
        plane: MotionWithExtent,
        body: MotionWithExtent,
        within: f64,
    ) -> Option<f64> {
        let [p, b] = [plane.motion, body.motion];
        if p.velocity() == b.velocity() {
            // In the plane's frame the body rotates in place, or moves on a circle.
            return repetition_time([plane, body]);
        }
        if p.angular_velocity() != DVec3::ZERO {
            return None;
        }
        let velocity = b.velocity() - p.velocity();
        let is_upright = p.start().rotation() == DQuat::IDENTITY;
        if is_upright && self.normal * velocity == DVec3::ZERO {
            // The body moves exactly along the plane.
            return Some(rotation_period(b.angular_velocity()));
        }
        let normal = p.start().rotation() * self.normal;
        let (from, to) = (p.start().translation(), body.start_position());
        let rate = normal.dot(velocity);
        let rounding = PLANE_HEIGHT_ROUNDING * length(velocity);
        let magnitude = plane.position_magnitude_sum() + body.position_magnitude_sum();
        let height = normal.dot(to - from);
        let reach =
            (body.max_radius + within + PLANE_HEIGHT_ROUNDING * magnitude) * ROUNDING_ENLARGEMENT;
        let needed = if rate < 0.0 {
            height + reach
        } else {
            reach - height
        };
        let rate = rate.abs() - rounding;
        (rate > 0.0).then(|| greater(0.0, needed) / rate * ROUNDING_ENLARGEMENT)
    }

    /// Returns a bound on the distance from `plane.about` to any point of the half-space that the body may touch.
    pub(crate) fn reach(
        &self,
        plane: MotionWithExtent,
        body: MotionWithExtent,
        within: f64,
        duration: f64,
    ) -> f64 {
        let [p, b] = [plane.start_position(), body.start_position()];
        let speed = length(body.motion.velocity() - plane.motion.velocity());
        let magnitude = plane.position_magnitude_sum() + body.position_magnitude_sum();
        (length(b - p)
            + speed * duration
            + body.max_radius
            + within
            + PLANE_HEIGHT_ROUNDING * magnitude)
            * ROUNDING_ENLARGEMENT
    }

    /// Returns a box that contains all points of the half-space within the distance `reach` of `plane.about`.
    pub(crate) fn covering_box(
        &self,
        plane: MotionWithExtent,
        reach: f64,
    ) -> Result<BodyOfShape, ShapeError> {
        let normal = self.normal;
        let height = normal.dot(plane.about);
        let center = plane.about - height * normal;
        let axis_u = normal.any_orthonormal_vector();
        let axis_v = normal.cross(axis_u);
        // The face is above the plane, whatever rounding does to the corners.
        let above = PLANE_HEIGHT_ROUNDING * (reach + length(plane.about));
        let below = -(reach + above) + lesser(height, 0.0);
        let half_width = reach * ROUNDING_ENLARGEMENT + above;
        let corner = |k: u32| {
            let side = |bit: u32| {
                if k >> bit & 1 == 1 {
                    half_width
                } else {
                    -half_width
                }
            };
            let high = if k & 4 == 4 { above } else { below };
            center + side(0) * axis_u + side(1) * axis_v + high * normal
        };
        let mut geometry = ShapeGeometry::EMPTY;
        geometry.excess = 2.0 * above;
        geometry.push_box_of_corners((0..8).map(corner).collect(), 0.0);
        BodyOfShape::new(&geometry)
    }
}

#[cfg(test)]
mod tests;
