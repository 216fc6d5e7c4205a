//! Trajectories other than motions at constant velocities, and the types and traits to build your own.
//!
//! Anything that implements [`Trajectory`] can carry a body. Queries along trajectories are as certain as those
//! along motions: every stretch of a trajectory knows how far it strays from a [`Motion`].
//!
//! | a body that … | is moved by |
//! |---|---|
//! | turns and advances along an axis | [`screw`], exact |
//! | hangs on a joint | [`Joint::motion`], exact |
//! | follows the poses of a planner or of a simulator's log | [`PosePath`], exact between two poses |
//! | is thrown | [`Ballistic`] |
//! | follows a Bézier curve or a B-spline | [`Spline`] of a [`Curve`] and of [`OrientationCurve`] |
//! | is the link of an arm whose joints all move | [`LinkTrajectory`] of a [`Chain`] |
//! | moves in a way of your own | [`SmoothTrajectory`], or [`Trajectory`] |
//!
//! [`worst_deviation`] tests a trajectory of your own: it seeks the times and points at which it deviates by more than
//! its bound.

mod ballistic;
mod chain;
mod checks;
mod curve;
mod joint;
mod link;
pub(crate) mod poses;
mod screw;
mod segments;
mod spline;
mod turns;
mod worst_deviation;

pub use ballistic::Ballistic;
pub use ccd_core::{
    Acceleration, AccelerationBounds, DeviationBound, Motion, Movement, MovingBody,
    SmoothTrajectory, Stretch, Trajectory,
};
pub use chain::Chain;
pub use curve::Curve;
pub use joint::{Joint, JointKind};
pub use link::LinkTrajectory;
pub use poses::PosePath;
pub use screw::screw;
pub use spline::Spline;
pub use turns::OrientationCurve;
pub use worst_deviation::{WorstDeviation, worst_deviation};

/// The unit roundoff of f64: the largest relative error of one operation.
const U: f64 = f64::EPSILON / 2.0;

#[cfg(test)]
mod tests;
