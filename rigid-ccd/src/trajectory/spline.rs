//! The trajectory of a body that follows a curve and rotates.

use super::checks::check_finite_vector;
use super::curve::Curve;
use super::turns::OrientationCurve;
use ccd_core::glam::DVec3;
use ccd_core::{
    Acceleration, AccelerationBounds, DeviationBound, InputError, Motion, Pose, SmoothTrajectory,
};

/// The trajectory of a body whose origin follows a [`Curve`], and which [rotates](OrientationCurve) about its origin.
///
/// ```
/// use rigid_ccd::trajectory::{Curve, Spline, Trajectory, OrientationCurve};
/// let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
/// let path = Spline::new(Curve::bezier(&points, 2.0)?, OrientationCurve::NONE);
/// assert_eq!(path.pose(1.0)?.translation().to_array(), [0.75, 0.5, 0.0]);
/// # Ok::<(), rigid_ccd::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    curve: Curve,
    orientation_curve: OrientationCurve,
    center: DVec3,
}

impl Spline {
    /// Creates a trajectory from the curve of the body's origin and its rotation.
    pub fn new(curve: Curve, turns: OrientationCurve) -> Self {
        Spline {
            curve,
            orientation_curve: turns,
            center: DVec3::ZERO,
        }
    }

    /// Sets the point of the body, in the body's frame, that follows the curve.
    ///
    /// # Errors
    /// [`InputError::NotFinite`].
    pub fn about(self, center: impl Into<[f64; 3]>) -> Result<Self, InputError> {
        let center = check_finite_vector(center, "center")?;
        Ok(Spline { center, ..self })
    }
}

impl SmoothTrajectory for Spline {
    fn tangent_motion(&self, time: f64) -> Result<Motion, InputError> {
        let (rotation, spin) = self.orientation_curve.at(time);
        let origin = self.curve.position(time) - rotation * self.center;
        let start = Pose::new(origin, rotation)?;
        Motion::about(start, self.curve.velocity(time), spin, self.center)
    }

    fn acceleration_bounds(&self, from: f64, to: f64) -> AccelerationBounds {
        AccelerationBounds {
            linear_acceleration: self.curve.acceleration_bound(from, to),
            angular_acceleration: self.orientation_curve.angular_acceleration_bound(from, to),
        }
    }

    fn osculating_motion(
        &self,
        time: f64,
        from: f64,
        to: f64,
    ) -> Result<(Motion, Option<Acceleration>), InputError> {
        let acceleration = self.curve.acceleration_at(time, from, to);
        Ok((self.tangent_motion(time)?, acceleration))
    }

    fn rounding(&self, _: f64, _: f64) -> DeviationBound {
        DeviationBound {
            center_deviation: self.curve.rounding(),
            max_deviation_angle: self.orientation_curve.rounding(),
        }
    }

    fn acceleration_jump_time(&self, from: f64, to: f64) -> Option<f64> {
        let corner = self.orientation_curve.segments.knot_between(from, to);
        corner.or_else(|| self.curve.segments.knot_between(from, to))
    }
}
