//! Answers single queries about two bodies, with a solver that reuses its memory.

mod questions;

use crate::Error;
use ccd_core::{
    Answer, Body, DistanceOracle, InputError, MovingBody, Pose, Query, Question, Settings,
};
use ccd_distance_gjk::Direct;
use questions::{Engine, Questions};

/// Finds the first contact of two moving bodies, from time 0 to `duration`.
///
/// Each body comes with its motion, its [trajectory](crate::trajectory), or the pose at which it rests. Lengths are in
/// the scene's unit, times in the motions' unit, angles in radians. A contact is a distance of at most 0.001; a [`Solver`]
/// takes other settings.
///
/// # Guarantee
/// No contact happens before the time of a [hit](Answer::hit). Without a hit, no contact happens within the duration.
///
/// # Errors
/// An [`InputError`] for a duration or a motion out of range. A query that reaches a limit is no error here: its outcome
/// is [unresolved](crate::Outcome::Unresolved), with a time before which no contact happens. [`Answer::hit`] makes an error
/// of it.
///
/// ```
/// use rigid_ccd::{Body, Motion, Pose, first_contact};
/// let ball = Body::sphere(0.5)?;
/// let flies = Motion::new(Pose::at([-3.0, 0.0, 0.0])?, [4.0, 0.0, 0.0], [0.0; 3])?;
/// let hit = first_contact((&ball, flies), (&ball, Motion::STILL), 1.0)?.hit()?.expect("they meet");
/// assert!(hit.time <= 0.5 && hit.time > 0.499);
/// # Ok::<(), rigid_ccd::Error>(())
/// ```
pub fn first_contact<'b>(
    a: impl Into<MovingBody<'b>>,
    b: impl Into<MovingBody<'b>>,
    duration: f64,
) -> Result<Answer, InputError> {
    Solver::new().first_contact(a, b, duration)
}

/// A solver for many queries, which reuses its memory. A [`ParallelSolver`](crate::ParallelSolver) has one
/// for each thread.
///
/// There is one method for each question. Each takes two bodies with anything that moves them: a
/// [motion](crate::Motion), a [trajectory](crate::trajectory), or a pose.
///
/// ```
/// use rigid_ccd::{Body, Motion, Pose, Settings, Solver};
/// let mut solver = Solver::new().with_settings(Settings { tolerance: 1e-6, ..Settings::DEFAULT });
/// let (ball, wall) = (Body::sphere(0.5)?, Body::cuboid([0.1, 5.0, 5.0])?);
/// for speed in [1.0, 2.0, 4.0] {
///     let flies = Motion::new(Pose::at([-3.0, 0.0, 0.0])?, [speed, 0.0, 0.0], [0.0; 3])?;
///     match solver.first_contact((&ball, flies), (&wall, Pose::IDENTITY), 1.0)?.hit()? {
///         Some(hit) => assert!(hit.time > 0.599 && speed > 2.0),
///         None => assert!(speed <= 2.0),
///     }
/// }
/// # Ok::<(), rigid_ccd::Error>(())
/// ```
pub struct Solver<O: DistanceOracle = Direct> {
    engine: Engine<O>,
    settings: Settings,
}

impl Solver {
    /// Creates a solver with the default distance backend, [`Direct`].
    pub fn new() -> Self {
        // Not generic: compiled here, and not where it is called.
        Solver::with_questions(Direct::default(), Questions::COMPILED)
    }
}

impl Default for Solver {
    fn default() -> Self {
        Solver::new()
    }
}

impl<O: DistanceOracle> Solver<O> {
    /// Creates a solver with another distance backend, such as [`Gjk`](crate::oracle::Gjk) or your own.
    pub fn with_oracle(oracle: O) -> Self {
        Solver::with_questions(oracle, Questions::COMPILED)
    }

    fn with_questions(oracle: O, questions: Questions<O>) -> Self {
        Solver {
            engine: Engine::new(oracle, questions),
            settings: Settings::DEFAULT,
        }
    }

    /// Sets tolerance, margin, start policy, budget, deadline, and a flag by which other threads stop queries.
    #[must_use]
    pub fn with_settings(mut self, settings: Settings) -> Self {
        self.settings = settings;
        self
    }

    /// Changes the settings of the queries that follow.
    pub fn set_settings(&mut self, settings: Settings) {
        self.settings = settings;
    }

    /// Finds the first contact of two moving bodies, as the function [`first_contact`] does.
    ///
    /// Along trajectories other than motions, contacts at the start are always reported.
    ///
    /// # Errors
    /// An [`InputError`] for a duration or a motion out of range, and those of trajectories.
    ///
    /// ```
    /// use rigid_ccd::trajectory::Ballistic;
    /// use rigid_ccd::{Body, Motion, Pose, Solver};
    /// let (ball, ground) = (Body::sphere(0.5)?, Body::cuboid([9.0, 9.0, 1.0])?);
    /// let thrown = Motion::new(Pose::at([0.0, 0.0, 3.0])?, [1.0, 0.0, 0.0], [0.0; 3])?;
    /// let falls = Ballistic::new(thrown, [0.0, 0.0, -10.0])?;
    /// let answer = Solver::new().first_contact((&ball, &falls), (&ground, Motion::STILL), 1.0)?;
    /// // It falls by 1.5.
    /// assert!((answer.hit()?.expect("it lands").time - 0.3f64.sqrt()).abs() < 1e-3);
    /// # Ok::<(), rigid_ccd::Error>(())
    /// ```
    pub fn first_contact<'b>(
        &mut self,
        a: impl Into<MovingBody<'b>>,
        b: impl Into<MovingBody<'b>>,
        duration: f64,
    ) -> Result<Answer, InputError> {
        self.answer(Question::FirstContact, a, b, duration)
    }

    /// Returns whether two moving bodies stay apart, by more than the margin.
    ///
    /// It costs as much as the first contact for bodies that stay apart, and less for others.
    ///
    /// # Guarantee
    /// Bodies that are free never touch. For others there is a time at which they are within margin +
    /// tolerance.
    ///
    /// # Errors
    /// Those of [`Solver::first_contact`], and [`Error::Unresolved`] if a limit is reached first.
    ///
    /// ```
    /// use rigid_ccd::{Body, Motion, Pose, Solver};
    /// let ball = Body::sphere(0.5)?;
    /// let passes = Motion::new(Pose::at([-3.0, 1.01, 0.0])?, [4.0, 0.0, 0.0], [0.0; 3])?;
    /// assert!(Solver::new().is_free((&ball, passes), (&ball, Motion::STILL), 1.0)?);
    /// # Ok::<(), rigid_ccd::Error>(())
    /// ```
    pub fn is_free<'b>(
        &mut self,
        a: impl Into<MovingBody<'b>>,
        b: impl Into<MovingBody<'b>>,
        duration: f64,
    ) -> Result<bool, Error> {
        Ok(self.any_contact(a, b, duration)?.hit()?.is_none())
    }

    /// Finds some contact of two moving bodies, perhaps not the first one, or proves that there is none.
    ///
    /// # Errors
    /// Those of [`Solver::first_contact`].
    pub fn any_contact<'b>(
        &mut self,
        a: impl Into<MovingBody<'b>>,
        b: impl Into<MovingBody<'b>>,
        duration: f64,
    ) -> Result<Answer, InputError> {
        self.answer(Question::AnyContact, a, b, duration)
    }

    /// Returns when two moving bodies first and last touch.
    ///
    /// # Guarantee
    /// They do not touch before the first time nor after the last.
    ///
    /// # Errors
    /// Those of [`Solver::first_contact`].
    ///
    /// ```
    /// use rigid_ccd::{Body, Motion, Outcome, Pose, Solver};
    /// let ball = Body::sphere(0.5)?;
    /// let flies = Motion::new(Pose::at([-3.0, 0.0, 0.0])?, [6.0, 0.0, 0.0], [0.0; 3])?;
    /// let answer = Solver::new().contact_interval((&ball, flies), (&ball, Motion::STILL), 1.0)?;
    /// let Outcome::Interval { first, last } = answer.outcome else { panic!("it passes through") };
    /// assert!((first.time - 2.0 / 6.0).abs() < 1e-3 && (last.time - 4.0 / 6.0).abs() < 1e-3);
    /// # Ok::<(), rigid_ccd::Error>(())
    /// ```
    pub fn contact_interval<'b>(
        &mut self,
        a: impl Into<MovingBody<'b>>,
        b: impl Into<MovingBody<'b>>,
        duration: f64,
    ) -> Result<Answer, InputError> {
        self.answer(Question::ContactInterval, a, b, duration)
    }

    /// Brackets the least distance of two moving bodies to within the tolerance, with its time and the nearest pieces.
    ///
    /// With a required [clearance](Settings::clearance), it only answers whether the bodies keep it, which costs about
    /// as much as [`Solver::is_free`] with that margin. The margin and the start policy play no role.
    ///
    /// # Guarantee
    /// The bodies are never nearer than the lower bound, and at that time at most the upper bound apart; so are the shapes
    /// that they [exceed](Body::with_excess).
    ///
    /// # Errors
    /// Those of [`Solver::first_contact`].
    ///
    /// ```
    /// use rigid_ccd::answer::ClearanceVerdict;
    /// use rigid_ccd::{Body, Motion, Pose, Settings, Solver};
    /// let ball = Body::sphere(0.5)?;
    /// let passes = Motion::new(Pose::at([-3.0, 1.2, 0.0])?, [6.0, 0.0, 0.0], [0.0; 3])?;
    /// let closest = Solver::new().closest_approach((&ball, passes), (&ball, Motion::STILL), 1.0)?;
    /// assert!(closest.outcome.lower() <= 0.2 && closest.outcome.upper() >= 0.2);
    /// assert_eq!(closest.outcome.clearance_verdict(0.19), ClearanceVerdict::Kept);
    ///
    /// let keeping = Settings { clearance: Some(0.1), ..Settings::DEFAULT };
    /// let mut solver = Solver::new().with_settings(keeping);
    /// let closest = solver.closest_approach((&ball, passes), (&ball, Motion::STILL), 1.0)?;
    /// assert_eq!(closest.outcome.clearance_verdict(0.1), ClearanceVerdict::Kept);
    /// # Ok::<(), rigid_ccd::Error>(())
    /// ```
    pub fn closest_approach<'b>(
        &mut self,
        a: impl Into<MovingBody<'b>>,
        b: impl Into<MovingBody<'b>>,
        duration: f64,
    ) -> Result<Answer, InputError> {
        self.answer(Question::ClosestApproach, a, b, duration)
    }

    /// Brackets the distance of two bodies at rest, as narrowly as f64 allows, with the nearest pieces.
    ///
    /// # Errors
    /// An [`InputError`] for a pose out of range.
    ///
    /// ```
    /// use rigid_ccd::{Body, Pose, Solver};
    /// let (ball, cube) = (Body::sphere(0.5)?, Body::cuboid([1.0; 3])?);
    /// let beside = Pose::at([4.0, 0.0, 0.0])?;
    /// let found = Solver::new().distance((&ball, beside), (&cube, Pose::IDENTITY))?.outcome;
    /// assert!((found.lower() - 2.5).abs() < 1e-4 && (found.upper() - 2.5).abs() < 1e-12);
    /// # Ok::<(), rigid_ccd::Error>(())
    /// ```
    pub fn distance(&mut self, a: (&Body, Pose), b: (&Body, Pose)) -> Result<Answer, InputError> {
        self.closest_approach(a, b, 0.0)
    }

    /// Answers a question that is chosen at run time, as the method of that question does. A distance is that at the start.
    ///
    /// # Errors
    /// Those of [`Solver::first_contact`].
    ///
    /// ```
    /// use rigid_ccd::{Body, Motion, Pose, Question, Solver};
    /// let ball = Body::sphere(0.5)?;
    /// let flies = Motion::new(Pose::at([-3.0, 0.0, 0.0])?, [6.0, 0.0, 0.0], [0.0; 3])?;
    /// let mut solver = Solver::new();
    /// for question in Question::ALL {
    ///     let answer = solver.answer(question, (&ball, flies), (&ball, Motion::STILL), 1.0)?;
    ///     println!("{question}: {:?}", answer.outcome);
    /// }
    /// # Ok::<(), rigid_ccd::Error>(())
    /// ```
    pub fn answer<'b>(
        &mut self,
        question: Question,
        a: impl Into<MovingBody<'b>>,
        b: impl Into<MovingBody<'b>>,
        duration: f64,
    ) -> Result<Answer, InputError> {
        let (a, b): (MovingBody<'b>, MovingBody<'b>) = (a.into(), b.into());
        let query = Query::new(a, b, duration, &self.settings)?;
        self.engine.answer(question, &query)
    }

    /// Answers a question about the bodies of a query, with the settings of the query instead of the solver's.
    ///
    /// # Errors
    /// Those of trajectories, and for a distance those of [`Query::at_start`].
    pub fn answer_query(
        &mut self,
        question: Question,
        query: &Query<'_>,
    ) -> Result<Answer, InputError> {
        self.engine.answer(question, query)
    }
}

#[cfg(test)]
mod tests;
