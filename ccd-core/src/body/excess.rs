//! The distance by which a body may exceed the shape that it represents.

use super::Body;
use crate::error::{InputError, check_shape_length};

impl Body {
    /// Declares the body an enclosure of a shape, which it exceeds by at most `excess`.
    ///
    /// The body of an [`EnclosingPolytope`](crate::EnclosingPolytope) states its own excess; that of all others is 0.
    ///
    /// # Guarantee
    /// The guarantee of distances holds for the shape if the body contains the shape, and no point of the body is
    /// farther than the excess from the shape; neither is checked. Lower bounds and times are those of the body.
    /// Upper bounds of the [least distance](crate::schedule::DepthFirst::closest_approach) are larger by the
    /// excess of both bodies. A first contact states the distance of the bodies themselves.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for a length that is not from 0 to [`MAX_COORDINATE`](crate::limits::MAX_COORDINATE).
    ///
    /// ```
    /// use ccd_core::Body;
    /// // About a ball of radius 1, of which it touches six points.
    /// let about = Body::cuboid([1.0; 3])?.with_excess(3f64.sqrt() - 0.99)?;
    /// assert!(about.excess() > 0.73 && Body::sphere(1.0)?.excess() == 0.0);
    /// assert!(about.with_excess(-1.0).is_err());
    /// # Ok::<(), ccd_core::InputError>(())
    /// ```
    pub fn with_excess(self, excess: f64) -> Result<Self, InputError> {
        check_shape_length("excess", excess)?;
        Ok(Body { excess, ..self })
    }

    /// Returns the distance by which the body may exceed its shape, in the body's unit of length; 0 for exact bodies.
    pub fn excess(&self) -> f64 {
        self.excess
    }
}

/// The distance by which two bodies together may exceed their shapes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ExcessSum(f64);

impl ExcessSum {
    pub(crate) fn sum_of_bodies(a: &Body, b: &Body) -> Self {
        ExcessSum(match (a.excess, b.excess) {
            (0.0, other) | (other, 0.0) => other,
            (one, other) => (one + other).next_up(),
        })
    }

    /// Returns an upper bound of the distance of two shapes whose enclosing bodies overlap.
    pub(crate) fn shape_distance_bound_at_overlap(self) -> f64 {
        self.0
    }

    /// Converts an upper bound of the distance of two bodies to an upper bound of the distance of their shapes.
    pub(crate) fn shape_distance_upper_bound(self, upper: f64) -> f64 {
        if self.0 > 0.0 {
            (upper + self.0).next_up()
        } else {
            upper
        }
    }

    /// Returns the threshold such that shapes are certainly nearer than `distance` if their bodies are nearer than the
    /// threshold. A threshold of 0 or less never applies.
    pub(crate) fn certain_nearness_threshold(self, distance: f64) -> f64 {
        if self.0 > 0.0 {
            (distance - self.0).next_down()
        } else {
            distance
        }
    }
}

#[cfg(test)]
mod tests;
