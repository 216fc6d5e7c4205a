//! Queries, one or many.

mod questions;
mod settings;

use crate::{Error, Hit};
use ccd_core::schedule::{BestFirst, DepthFirst, Schedule};
use ccd_core::{Answer, Config, DistanceOracle, InputError, Moving};
use ccd_distance_gjk::Direct;
use settings::Settings;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Finds the first contact of two moving bodies, from time 0 to `duration`; none when they stay apart.
///
/// Each body comes with its motion. Lengths are in the scene's unit, times in the motions' unit, angles
/// in radians. A contact is a distance of at most 0.001; a [`Solver`] takes another tolerance.
///
/// # Guarantee
/// No contact happens before the time of the hit. Without a hit, no contact happens within the duration.
///
/// # Errors
/// [`Error::Input`] for a duration or a motion out of range, [`Error::Unresolved`] when a limit is reached
/// first.
///
/// ```
/// use rigid_ccd::{Body, Motion, Pose, first_contact};
/// let ball = Body::ball(0.5)?;
/// let flies = Motion::new(Pose::at([-3.0, 0.0, 0.0])?, [4.0, 0.0, 0.0], [0.0; 3])?;
/// let hit = first_contact((&ball, flies), (&ball, Motion::STILL), 1.0)?.expect("they meet");
/// assert!(hit.time <= 0.5 && hit.time > 0.499);
/// # Ok::<(), rigid_ccd::Error>(())
/// ```
pub fn first_contact<'b>(
    a: impl Into<Moving<'b>>,
    b: impl Into<Moving<'b>>,
    duration: f64,
) -> Result<Option<Hit>, Error> {
    Solver::new().first_contact(a, b, duration)
}

/// A solver for many queries, which reuses its memory. A [`ParallelSolver`](crate::ParallelSolver) has one
/// for each thread.
///
/// ```
/// use rigid_ccd::{Body, Config, Motion, Pose, Solver};
/// let mut solver = Solver::new().with_config(Config { tolerance: 1e-6, ..Config::default() });
/// let (ball, wall) = (Body::ball(0.5)?, Body::cuboid([0.1, 5.0, 5.0])?);
/// for speed in [1.0, 2.0, 4.0] {
///     let flies = Motion::new(Pose::at([-3.0, 0.0, 0.0])?, [speed, 0.0, 0.0], [0.0; 3])?;
///     match solver.first_contact((&ball, flies), (&wall, Motion::STILL), 1.0)? {
///         Some(hit) => assert!(hit.time > 0.599 && speed > 2.0),
///         None => assert!(speed <= 2.0),
///     }
/// }
/// # Ok::<(), rigid_ccd::Error>(())
/// ```
pub struct Solver<O: DistanceOracle = Direct> {
    schedule: BestFirst<O>,
    depth_first: DepthFirst<O>,
    oracle: O,
    settings: Settings,
}

impl Solver {
    /// Creates a solver with the default distance backend, [`Direct`].
    pub fn new() -> Self {
        Solver::with_oracle(Direct::default())
    }
}

impl Default for Solver {
    fn default() -> Self {
        Solver::new()
    }
}

impl<O: DistanceOracle> Solver<O> {
    /// Creates a solver with another distance backend, such as [`Gjk`](crate::Gjk) or your own.
    pub fn with_oracle(oracle: O) -> Self {
        Solver {
            schedule: BestFirst::default(),
            depth_first: DepthFirst::default(),
            oracle,
            settings: Settings::default(),
        }
    }

    /// Sets tolerance, margin, start policy, budget and deadline.
    pub fn with_config(mut self, config: Config) -> Self {
        self.set_config(config);
        self
    }

    /// Changes tolerance, margin, start policy, budget and deadline of the queries that follow.
    pub fn set_config(&mut self, config: Config) {
        self.settings.config = config;
    }

    /// Lets other threads stop queries: once the flag is set, each ends soon, unresolved, with a certified
    /// time ([`Limit::Stopped`](crate::Limit::Stopped)).
    ///
    /// ```
    /// use rigid_ccd::Solver;
    /// use std::sync::{Arc, atomic::AtomicBool};
    /// let stop = Arc::new(AtomicBool::new(false));
    /// let solver = Solver::new().with_stop(&stop);
    /// ```
    #[must_use]
    pub fn with_stop(mut self, stop: &Arc<AtomicBool>) -> Self {
        self.settings.stop = Some(Arc::clone(stop));
        self
    }

    /// Finds the first contact of two moving bodies, as the function [`first_contact`] does.
    ///
    /// # Errors
    /// The errors of [`first_contact`].
    pub fn first_contact<'b>(
        &mut self,
        a: impl Into<Moving<'b>>,
        b: impl Into<Moving<'b>>,
        duration: f64,
    ) -> Result<Option<Hit>, Error> {
        Hit::from_answer(&self.answer(a, b, duration)?)
    }

    /// Returns the full answer: the outcome, the tolerance and the statistics.
    ///
    /// A query that reaches a limit is an outcome here,
    /// [`Outcome::Unresolved`](crate::Outcome::Unresolved), not an error. The time of every outcome has
    /// the guarantee of [`first_contact`].
    ///
    /// # Errors
    /// The errors of [`Problem::new`](crate::Problem::new): a duration or a motion out of range.
    ///
    /// ```
    /// use rigid_ccd::{Body, Motion, Outcome, Pose, Solver};
    /// let ball = Body::ball(0.5)?;
    /// let apart = Motion::still(Pose::at([3.0, 0.0, 0.0])?);
    /// let answer = Solver::new().answer((&ball, apart), (&ball, Motion::STILL), 1.0)?;
    /// assert!(matches!(answer.outcome, Outcome::Free { proven_gap } if proven_gap > 0.0));
    /// # Ok::<(), rigid_ccd::Error>(())
    /// ```
    pub fn answer<'b>(
        &mut self,
        a: impl Into<Moving<'b>>,
        b: impl Into<Moving<'b>>,
        duration: f64,
    ) -> Result<Answer, InputError> {
        let problem = self.settings.problem(a, b, duration)?;
        Ok(self.schedule.solve(&problem, &mut self.oracle))
    }

    #[cfg(feature = "command")]
    pub(crate) fn solve(&mut self, problem: &ccd_core::Problem<'_>) -> Answer {
        self.schedule.solve(problem, &mut self.oracle)
    }
}
