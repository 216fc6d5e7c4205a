//! Motions with constant velocity of a center and constant angular velocity about it.

pub(crate) mod bound;
pub(crate) mod free_time;
pub(crate) mod gap;
#[cfg(feature = "nalgebra")]
mod interop;
pub(crate) mod kind;
pub(crate) mod path;
pub(crate) mod period;
pub(crate) mod pose;
pub(crate) mod relative;
pub(crate) mod span;
pub(crate) mod track;
pub(crate) mod trajectory;

use crate::error::{InputError, check, check_finite};
use crate::math::vector::length;
use glam::{DQuat, DVec3};
use pose::{Frame, Pose};

/// A motion with constant linear velocity of a chosen center, and constant angular velocity about it, for any number of
/// turns `[FAST06 §4.1]`.
///
/// `x(t) = R(t)(x − c) + C₀ + v t`, with `R(t) = exp(t [ω]×) R₀`, `c` the center in the body's
/// frame and `C₀` its position in the world at `t = 0`. Angular velocity is in radians per unit of
/// time, along the world's axes; lengths are in the scene's unit.
///
/// ```
/// use ccd_core::{glam::DVec3, Motion, Pose};
/// let spin = Motion::new(Pose::IDENTITY, DVec3::X, 20.0 * DVec3::Z).unwrap();
/// assert_eq!(spin.pose(1.0).translation(), DVec3::X);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    start: Pose,
    velocity: DVec3,
    spin: DVec3,
    center: DVec3,
}

impl Motion {
    /// The motion at rest whose body frame equals the world's frame.
    pub const STILL: Motion = Motion {
        start: Pose::IDENTITY,
        velocity: DVec3::ZERO,
        spin: DVec3::ZERO,
        center: DVec3::ZERO,
    };

    /// Creates the motion of a body that rests at a pose.
    pub fn still(pose: Pose) -> Self {
        Motion {
            start: pose,
            ..Motion::STILL
        }
    }

    /// Creates a motion about the body's origin, from the pose at `t = 0` and the velocities per unit of time.
    ///
    /// Velocities are arrays, or types that convert to arrays: vectors of `glam` and `nalgebra`.
    ///
    /// # Errors
    /// [`InputError::NotFinite`].
    pub fn new(
        start: Pose,
        velocity: impl Into<[f64; 3]>,
        spin: impl Into<[f64; 3]>,
    ) -> Result<Self, InputError> {
        Motion::about(start, velocity, spin, DVec3::ZERO)
    }

    /// Creates a motion about `center`, a point in the body's frame, from the pose at `t = 0` and the velocities per
    /// unit of time. `velocity` is the velocity of that point.
    ///
    /// # Errors
    /// [`InputError::NotFinite`].
    pub fn about(
        start: Pose,
        velocity: impl Into<[f64; 3]>,
        spin: impl Into<[f64; 3]>,
        center: impl Into<[f64; 3]>,
    ) -> Result<Self, InputError> {
        let [velocity, spin, center] =
            [velocity.into(), spin.into(), center.into()].map(DVec3::from_array);
        for (what, part) in [
            ("velocity", velocity),
            ("angular velocity", spin),
            ("center", center),
        ] {
            check_finite(what, part.is_finite())?;
        }
        Ok(Motion {
            start,
            velocity,
            spin,
            center,
        })
    }

    /// Creates a motion from the poses at `t = 0` and `t = duration`. The body takes the shortest rotation about
    /// `center`, a point in the body's frame that moves on a straight line.
    ///
    /// Velocities are derived from the poses and rounded. A query over at most `duration` accounts for that rounding:
    /// its certificate holds for the motion between the poses as given
    /// (`rounding::distance_rounding`).
    ///
    /// At half a turn both directions are shortest. The motion turns counterclockwise about the
    /// vector part of `end · start⁻¹`, computed from the quaternions as given: the negative of
    /// either one represents the same orientation, but turns the other way. If the scalar part of
    /// that product is 0 up to rounding (within about 1e-15), rounding decides; the same numbers
    /// always give the same direction.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] when `duration` is not positive and finite,
    /// [`InputError::NotFinite`] when the velocities overflow.
    pub fn between(
        start: Pose,
        end: Pose,
        center: impl Into<[f64; 3]>,
        duration: f64,
    ) -> Result<Self, InputError> {
        let center = DVec3::from_array(center.into());
        let allowed = duration > 0.0 && duration.is_finite();
        check("duration", duration, allowed, "positive and finite")?;
        // The differences are computed first: positions far from the world's origin lose no accuracy.
        let turned = Frame::from(end).rotation - Frame::from(start).rotation;
        let travel = (end.translation() - start.translation()) + turned * center;
        let turn = shortest_rotation_vector(end.rotation() * start.rotation().conjugate());
        Motion::about(start, travel / duration, turn / duration, center)
    }

    /// Returns the body's pose at `t = 0`.
    pub fn start(&self) -> Pose {
        self.start
    }

    /// Returns the velocity of the [center](Motion::center), per unit of time.
    pub fn velocity(&self) -> DVec3 {
        self.velocity
    }

    /// Returns the angular velocity in radians per unit of time, in the world's frame.
    pub fn angular_velocity(&self) -> DVec3 {
        self.spin
    }

    /// Returns the center of rotation, a point in the body's frame that moves on a straight line.
    pub fn center(&self) -> DVec3 {
        self.center
    }

    /// Returns the body's pose at time `t`.
    pub fn pose(&self, t: f64) -> Pose {
        let rotation = DQuat::from_scaled_axis(t * self.spin) * self.start.rotation();
        // The displacement of the center, minus that of the origin by the turn about the center.
        let turned = rotation * self.center - self.start.rotation() * self.center;
        Pose::from_unit_quaternion(
            self.start.translation() + (t * self.velocity - turned),
            rotation,
        )
    }
}

/// Returns the rotation vector of a unit quaternion, with a length of at most π.
pub fn shortest_rotation_vector(rotation: DQuat) -> DVec3 {
    let rotation = if rotation.w < 0.0 {
        -rotation
    } else {
        rotation
    };
    let axis = rotation.xyz();
    let sine = length(axis);
    if sine > 0.0 {
        // The function atan2 keeps its digits at small angles, and acos does not.
        axis * (2.0 * sine.atan2(rotation.w) / sine)
    } else {
        DVec3::ZERO
    }
}

#[cfg(test)]
mod tests;
