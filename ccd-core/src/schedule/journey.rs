//! Questions about bodies that move along trajectories, answered stretch by stretch.
//!
//! On a stretch each body follows a motion, with a constant acceleration of its centre, from which it strays by a
//! known amount. The query about these motions takes both strays for a margin: bodies that keep them are apart. A
//! contact within the strays proves nothing, and the stretch is cut.

mod any;
mod closest;
mod farthest;
mod first;
mod interval;
mod leg;
mod lengths;
mod stretches;

use crate::body::Body;
use crate::body::excess::Excess;
use crate::config::Config;
use crate::error::InputError;
use crate::error::check;
use crate::limits::MAX_DURATION;
use crate::motion::trajectory::Trajectory;
use crate::problem::check_config;
use std::fmt;
use std::sync::atomic::AtomicBool;

pub use farthest::GreatestDistance;
pub use interval::{ContactInterval, Touch};

/// A body and the trajectory that carries it.
///
/// ```
/// use ccd_core::{Body, Motion, Travelling};
/// let ball = Body::ball(0.5)?;
/// let resting: Travelling = (&ball, &Motion::STILL).into();
/// # Ok::<(), ccd_core::InputError>(())
/// ```
#[derive(Clone, Copy)]
pub struct Travelling<'a> {
    /// The body.
    pub body: &'a Body,
    /// The trajectory of the body.
    pub trajectory: &'a dyn Trajectory,
}

impl<'a, T: Trajectory> From<(&'a Body, &'a T)> for Travelling<'a> {
    fn from((body, trajectory): (&'a Body, &'a T)) -> Self {
        Travelling { body, trajectory }
    }
}

impl fmt::Debug for Travelling<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut travelling = f.debug_struct("Travelling");
        travelling.field("body", self.body).finish_non_exhaustive()
    }
}

/// Two bodies on trajectories over `[0, duration]`: what a [`Problem`](crate::Problem) is for motions.
///
/// Bodies that are in contact at the start are never [let go](crate::StartPolicy::Leave).
///
/// ```
/// use ccd_core::{Body, Config, Journey, Motion, Pose};
/// let ball = Body::ball(0.5)?;
/// let flies = Motion::new(Pose::at([-3.0, 0.0, 0.0])?, [1.0, 0.0, 0.0], [0.0; 3])?;
/// let journey = Journey::new((&ball, &flies), (&ball, &Motion::STILL), 4.0, &Config::default())?;
/// # Ok::<(), ccd_core::InputError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Journey<'a> {
    a: Travelling<'a>,
    b: Travelling<'a>,
    duration: f64,
    config: Config,
    stop: Option<&'a AtomicBool>,
}

impl<'a> Journey<'a> {
    /// Poses a query over two bodies on trajectories.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for a negative duration or margin, for a duration above
    /// [`MAX_DURATION`](crate::limits::MAX_DURATION), and for a tolerance that is not positive.
    pub fn new(
        a: impl Into<Travelling<'a>>,
        b: impl Into<Travelling<'a>>,
        duration: f64,
        config: &Config,
    ) -> Result<Self, InputError> {
        check_config(duration, config)?;
        check(
            "duration",
            duration,
            duration <= MAX_DURATION,
            "at most 1e50 along trajectories",
        )?;
        Ok(Journey {
            a: a.into(),
            b: b.into(),
            duration,
            config: *config,
            stop: None,
        })
    }

    /// How far the bodies may exceed their shapes.
    fn excess(&self) -> Excess {
        Excess::of(self.a.body, self.b.body)
    }

    /// Lets other threads stop the query, as [`Problem::stopped_by`](crate::Problem::stopped_by) does.
    #[must_use]
    pub fn stopped_by(self, stop: &'a AtomicBool) -> Self {
        Journey {
            stop: Some(stop),
            ..self
        }
    }
}

#[cfg(test)]
mod tests;
