//! Questions other than that for the first contact.

use super::Solver;
use crate::{Error, Hit};
use ccd_core::schedule::{AnyContact, ClosestApproach, ContactInterval, GreatestDistance};
use ccd_core::{Answer, Body, DistanceOracle, InputError, Motion, Moving, Pose, Travelling};

impl<O: DistanceOracle> Solver<O> {
    /// Returns whether two moving bodies stay apart, by more than the margin.
    ///
    /// It costs as much as the first contact for bodies that stay apart, and less for others.
    ///
    /// # Guarantee
    /// Bodies that are free never touch. For others there is a time at which they are within margin +
    /// tolerance.
    ///
    /// # Errors
    /// Those of [`first_contact`](crate::first_contact).
    ///
    /// ```
    /// use rigid_ccd::{Body, Motion, Pose, Solver};
    /// let ball = Body::ball(0.5)?;
    /// let passes = Motion::new(Pose::at([-3.0, 1.01, 0.0])?, [4.0, 0.0, 0.0], [0.0; 3])?;
    /// assert!(Solver::new().is_free((&ball, passes), (&ball, Motion::STILL), 1.0)?);
    /// # Ok::<(), rigid_ccd::Error>(())
    /// ```
    pub fn is_free<'b>(
        &mut self,
        a: impl Into<Moving<'b>>,
        b: impl Into<Moving<'b>>,
        duration: f64,
    ) -> Result<bool, Error> {
        is_free(&self.any_contact(a, b, duration)?)
    }

    /// Returns any contact of two moving bodies: perhaps not the first one.
    ///
    /// # Errors
    /// The errors of [`Problem::new`](crate::Problem::new): a duration or a motion out of range.
    pub fn any_contact<'b>(
        &mut self,
        a: impl Into<Moving<'b>>,
        b: impl Into<Moving<'b>>,
        duration: f64,
    ) -> Result<Answer<AnyContact>, InputError> {
        let problem = self.settings.problem(a, b, duration)?;
        Ok(self.depth_first.any_contact(&problem, &mut self.oracle))
    }

    /// Brackets the least distance of two moving bodies, to within the tolerance, with its time and the nearest
    /// pieces; or answers whether they keep a required [clearance](crate::Config::clearance), which costs about as much
    /// as [`Solver::is_free`] with that margin.
    ///
    /// The margin and the start policy play no role.
    ///
    /// # Guarantee
    /// The bodies are never nearer than the lower bound, and at that time at most the upper bound apart; so are the shapes
    /// that they [exceed](Body::with_excess).
    ///
    /// # Errors
    /// The errors of [`Problem::new`](crate::Problem::new): a duration or a motion out of range.
    ///
    /// ```
    /// use rigid_ccd::schedule::Clearance;
    /// use rigid_ccd::{Body, Config, Motion, Pose, Solver};
    /// let ball = Body::ball(0.5)?;
    /// let passes = Motion::new(Pose::at([-3.0, 1.2, 0.0])?, [6.0, 0.0, 0.0], [0.0; 3])?;
    /// let closest = Solver::new().closest_approach((&ball, passes), (&ball, Motion::STILL), 1.0)?;
    /// assert!(closest.outcome.lower() <= 0.2 && closest.outcome.upper() >= 0.2);
    /// assert_eq!(closest.outcome.clearance(0.19), Clearance::Kept);
    ///
    /// let keeping = Config { clearance: Some(0.1), ..Config::default() };
    /// let mut solver = Solver::new().with_config(keeping);
    /// let closest = solver.closest_approach((&ball, passes), (&ball, Motion::STILL), 1.0)?;
    /// assert_eq!(closest.outcome.clearance(0.1), Clearance::Kept);
    /// # Ok::<(), rigid_ccd::Error>(())
    /// ```
    pub fn closest_approach<'b>(
        &mut self,
        a: impl Into<Moving<'b>>,
        b: impl Into<Moving<'b>>,
        duration: f64,
    ) -> Result<Answer<ClosestApproach>, InputError> {
        let problem = self.settings.problem(a, b, duration)?;
        Ok(self
            .depth_first
            .closest_approach(&problem, &mut self.oracle))
    }

    /// Brackets the greatest distance of two moving bodies, to within the tolerance, with its time and the nearest
    /// pieces then.
    ///
    /// The distance is that of the nearest points at each time, and 0 where the bodies overlap. The margin and the start
    /// policy play no role.
    ///
    /// # Guarantee
    /// The bodies are never farther apart than the upper bound, and at that time at least the lower bound; so are the shapes
    /// that they [exceed](Body::with_excess).
    ///
    /// # Errors
    /// The errors of [`Journey::new`](crate::Journey::new): a duration or a motion out of range.
    ///
    /// ```
    /// use rigid_ccd::{Body, Motion, Pose, Solver};
    /// // A lid lifts from its case, and must stay within 3 mm.
    /// let (lid, case) = (Body::cuboid([100.0, 100.0, 2.0])?, Body::cuboid([100.0, 100.0, 50.0])?);
    /// let lifts = Motion::new(Pose::at([0.0, 0.0, 52.1])?, [0.0, 0.0, 2.0], [0.0; 3])?;
    /// let found = Solver::new().greatest_distance((&lid, lifts), (&case, Motion::STILL), 1.0)?.outcome;
    /// assert!(found.upper() < 3.0 && found.lower() > 2.0);
    /// # Ok::<(), rigid_ccd::Error>(())
    /// ```
    pub fn greatest_distance<'b>(
        &mut self,
        a: impl Into<Moving<'b>>,
        b: impl Into<Moving<'b>>,
        duration: f64,
    ) -> Result<Answer<GreatestDistance>, InputError> {
        let (a, b): (Moving<'b>, Moving<'b>) = (a.into(), b.into());
        let (a, b) = ((a.body, &a.motion), (b.body, &b.motion));
        self.greatest_distance_along(a, b, duration)
    }

    /// Brackets the distance of two bodies at rest, as narrowly as f64 allows, with the nearest pieces.
    ///
    /// # Errors
    /// The errors of [`Problem::new`](crate::Problem::new): a pose out of range.
    ///
    /// ```
    /// use rigid_ccd::{Body, Pose, Solver};
    /// let (ball, cube) = (Body::ball(0.5)?, Body::cuboid([1.0; 3])?);
    /// let beside = Pose::at([4.0, 0.0, 0.0])?;
    /// let found = Solver::new().distance((&ball, beside), (&cube, Pose::IDENTITY))?.outcome;
    /// assert!((found.lower() - 2.5).abs() < 1e-4 && (found.upper() - 2.5).abs() < 1e-12);
    /// # Ok::<(), rigid_ccd::Error>(())
    /// ```
    pub fn distance(
        &mut self,
        a: (&Body, Pose),
        b: (&Body, Pose),
    ) -> Result<Answer<ClosestApproach>, InputError> {
        let [a, b] = [a, b].map(|(body, pose)| (body, Motion::still(pose)));
        self.closest_approach(a, b, 0.0)
    }

    /// Finds the first contact of two bodies on [trajectories](crate::trajectory), from their time 0 to the time
    /// `duration`.
    ///
    /// Contacts at the start are reported: a start policy to leave them plays no role.
    ///
    /// # Errors
    /// Those of [`first_contact`](crate::first_contact), and those of the trajectories.
    ///
    /// ```
    /// use rigid_ccd::trajectory::Ballistic;
    /// use rigid_ccd::{Body, Motion, Pose, Solver};
    /// let (ball, ground) = (Body::ball(0.5)?, Body::cuboid([9.0, 9.0, 1.0])?);
    /// let thrown = Motion::new(Pose::at([0.0, 0.0, 3.0])?, [1.0, 0.0, 0.0], [0.0; 3])?;
    /// let falls = Ballistic::new(thrown, [0.0, 0.0, -10.0])?;
    /// let hit = Solver::new().first_contact_along((&ball, &falls), (&ground, &Motion::STILL), 1.0)?;
    /// // It falls by 1.5.
    /// assert!((hit.expect("it lands").time - 0.3f64.sqrt()).abs() < 1e-3);
    /// # Ok::<(), rigid_ccd::Error>(())
    /// ```
    pub fn first_contact_along<'b>(
        &mut self,
        a: impl Into<Travelling<'b>>,
        b: impl Into<Travelling<'b>>,
        duration: f64,
    ) -> Result<Option<Hit>, Error> {
        Hit::from_answer(&self.answer_along(a, b, duration)?)
    }

    /// Returns the full answer for two bodies on [trajectories](crate::trajectory), as [`Solver::answer`] does
    /// for motions.
    ///
    /// # Errors
    /// Those of [`Journey::new`](crate::Journey::new), and those of the trajectories.
    pub fn answer_along<'b>(
        &mut self,
        a: impl Into<Travelling<'b>>,
        b: impl Into<Travelling<'b>>,
        duration: f64,
    ) -> Result<Answer, InputError> {
        let journey = self.settings.journey(a, b, duration)?;
        (self.schedule).first_contact_along(&journey, &mut self.oracle)
    }

    /// Returns whether two bodies on [trajectories](crate::trajectory) stay apart, by more than the margin.
    ///
    /// # Errors
    /// Those of [`first_contact`](crate::first_contact), and those of the trajectories.
    pub fn is_free_along<'b>(
        &mut self,
        a: impl Into<Travelling<'b>>,
        b: impl Into<Travelling<'b>>,
        duration: f64,
    ) -> Result<bool, Error> {
        is_free(&self.any_contact_along(a, b, duration)?)
    }

    /// Returns any contact of two bodies on [trajectories](crate::trajectory): perhaps not the first one.
    ///
    /// # Errors
    /// Those of [`Journey::new`](crate::Journey::new), and those of the trajectories.
    pub fn any_contact_along<'b>(
        &mut self,
        a: impl Into<Travelling<'b>>,
        b: impl Into<Travelling<'b>>,
        duration: f64,
    ) -> Result<Answer<AnyContact>, InputError> {
        let journey = self.settings.journey(a, b, duration)?;
        (self.depth_first).any_contact_along(&journey, &mut self.oracle)
    }

    /// Brackets the least distance of two bodies on [trajectories](crate::trajectory).
    ///
    /// # Errors
    /// Those of [`Journey::new`](crate::Journey::new), and those of the trajectories.
    pub fn closest_approach_along<'b>(
        &mut self,
        a: impl Into<Travelling<'b>>,
        b: impl Into<Travelling<'b>>,
        duration: f64,
    ) -> Result<Answer<ClosestApproach>, InputError> {
        let journey = self.settings.journey(a, b, duration)?;
        (self.depth_first).closest_approach_along(&journey, &mut self.oracle)
    }

    /// Brackets the greatest distance of two bodies on [trajectories](crate::trajectory), as
    /// [`Solver::greatest_distance`] does of motions.
    ///
    /// # Errors
    /// Those of [`Journey::new`](crate::Journey::new), and those of the trajectories.
    pub fn greatest_distance_along<'b>(
        &mut self,
        a: impl Into<Travelling<'b>>,
        b: impl Into<Travelling<'b>>,
        duration: f64,
    ) -> Result<Answer<GreatestDistance>, InputError> {
        let journey = self.settings.journey(a, b, duration)?;
        (self.depth_first).greatest_distance_along(&journey, &mut self.oracle)
    }

    /// Returns when two bodies on [trajectories](crate::trajectory) first and last touch.
    ///
    /// # Guarantee
    /// They do not touch before the first time nor after the last.
    ///
    /// # Errors
    /// Those of [`Journey::new`](crate::Journey::new), and those of the trajectories.
    ///
    /// ```
    /// use rigid_ccd::schedule::ContactInterval;
    /// use rigid_ccd::{Body, Motion, Pose, Solver};
    /// let ball = Body::ball(0.5)?;
    /// let flies = Motion::new(Pose::at([-3.0, 0.0, 0.0])?, [6.0, 0.0, 0.0], [0.0; 3])?;
    /// let found = Solver::new().contact_interval_along((&ball, &flies), (&ball, &Motion::STILL), 1.0)?;
    /// let ContactInterval::Within { first, last } = found.outcome else { panic!("it passes through") };
    /// assert!((first.time - 2.0 / 6.0).abs() < 1e-3 && (last.time - 4.0 / 6.0).abs() < 1e-3);
    /// # Ok::<(), rigid_ccd::Error>(())
    /// ```
    pub fn contact_interval_along<'b>(
        &mut self,
        a: impl Into<Travelling<'b>>,
        b: impl Into<Travelling<'b>>,
        duration: f64,
    ) -> Result<Answer<ContactInterval>, InputError> {
        let journey = self.settings.journey(a, b, duration)?;
        (self.schedule).contact_interval_along(&journey, &mut self.oracle)
    }
}

fn is_free(answer: &Answer<AnyContact>) -> Result<bool, Error> {
    match answer.outcome {
        AnyContact::Free { .. } => Ok(true),
        AnyContact::Contact { .. } | AnyContact::Overlapping { .. } => Ok(false),
        AnyContact::Unresolved { safe_until, reason } => {
            Err(Error::Unresolved { safe_until, reason })
        }
    }
}

#[cfg(test)]
mod tests;
