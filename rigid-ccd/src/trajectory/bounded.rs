//! Trajectories with bounds on their speeds, which may be followed at another pace.

use ccd_core::Smooth;

/// A smooth trajectory with bounds on its speeds, as the inner one of a [`Timed`](super::Timed) needs.
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
