//! Trajectories with bounds on their speeds, from which others are built.

use ccd_core::vector::length;
use ccd_core::{Accelerations, Motion, Smooth};

/// A smooth trajectory with bounds on its speeds, as the carrier of a [`Carried`](super::Carried) trajectory or the
/// inner one of a [`Timed`](super::Timed) needs.
pub trait Bounded: Smooth {
    /// Bounds the linear and angular speed between two times.
    fn speeds(&self, from: f64, to: f64) -> Speeds;
}

/// Bounds on speeds, per unit of time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Speeds {
    /// A bound on the speed of the tangents' centre, in the scene's unit of length per unit of time.
    pub linear: f64,
    /// A bound on the angular speed, in radians per unit of time.
    pub angular: f64,
}

/// Returns the speeds of a motion at constant velocities.
pub(super) fn speeds(motion: &Motion) -> Speeds {
    Speeds {
        linear: length(motion.velocity()),
        angular: length(motion.spin()),
    }
}

impl Speeds {
    /// Bounds the speed of a body's origin at distance `arm` from the centre.
    pub(super) fn of_origin(self, arm: f64) -> Self {
        Speeds {
            linear: self.linear + self.angular * arm,
            ..self
        }
    }
}

/// Bounds the accelerations of a body's origin at distance `arm` from the centre.
pub(super) fn of_origin(accelerations: Accelerations, speeds: Speeds, arm: f64) -> Accelerations {
    let Accelerations { linear, angular } = accelerations;
    Accelerations {
        linear: linear + (angular + speeds.angular * speeds.angular) * arm,
        angular,
    }
}
