//! Trajectories with bounds of their speeds, which others are made of.

use ccd_core::vector::length;
use ccd_core::{Accelerations, Motion, Smooth};

/// A smooth trajectory with bounds of its speeds: one that can [carry](super::Carried) a body that moves itself,
/// or be followed at another [pace](super::Timed).
pub trait Bounded: Smooth {
    /// Bounds the speeds from a time to a later one.
    fn speeds(&self, from: f64, to: f64) -> Speeds;
}

/// Bounds of speeds, per unit of time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Speeds {
    /// Of the tangents' centre, in the scene's unit of length.
    pub linear: f64,
    /// Of the orientation, in radians.
    pub angular: f64,
}

/// A motion has constant velocities.
pub(super) fn speeds(motion: &Motion) -> Speeds {
    Speeds {
        linear: length(motion.velocity()),
        angular: length(motion.spin()),
    }
}

impl Speeds {
    /// Bounds the speeds of a body's origin; `arm` is its distance from the centre.
    pub(super) fn of_origin(self, arm: f64) -> Self {
        Speeds {
            linear: self.linear + self.angular * arm,
            ..self
        }
    }
}

/// Bounds the accelerations of a body's origin; `arm` is its distance from the centre.
pub(super) fn of_origin(accelerations: Accelerations, speeds: Speeds, arm: f64) -> Accelerations {
    let Accelerations { linear, angular } = accelerations;
    Accelerations {
        linear: linear + (angular + speeds.angular * speeds.angular) * arm,
        angular,
    }
}
