//! Questions, one or many.

use crate::{Error, Hit};
use ccd_core::schedule::{BestFirst, Schedule};
use ccd_core::{Answer, Config, DistanceOracle, InputError, Moving, Problem};
use ccd_distance_gjk::Direct;

/// When do two bodies first touch, from time 0 to a duration? None when they stay apart.
///
/// The tolerance is 0.001 in the scene's unit of length; a [`Solver`] takes another one.
///
/// # Guarantee
/// Nothing touches before the time of the hit, or at all where there is none.
///
/// # Errors
/// [`Error::Input`] for what cannot be asked, [`Error::Unresolved`] where a limit is reached first.
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

/// Answers many questions: keeps its memory from one to the next.
///
/// Make one for each thread.
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
    oracle: O,
    config: Config,
}

impl Solver {
    /// With the backend that suits all pieces.
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
    /// With a distance backend of your choice, or of your own.
    pub fn with_oracle(oracle: O) -> Self {
        Solver {
            schedule: BestFirst::default(),
            oracle,
            config: Config::default(),
        }
    }

    /// How accurately to answer from now on, and what to count as a contact.
    pub fn with_config(self, config: Config) -> Self {
        Solver { config, ..self }
    }

    /// As the function [`first_contact`].
    ///
    /// # Errors
    /// As [`first_contact`].
    pub fn first_contact<'b>(
        &mut self,
        a: impl Into<Moving<'b>>,
        b: impl Into<Moving<'b>>,
        duration: f64,
    ) -> Result<Option<Hit>, Error> {
        Hit::of(&self.answer(a, b, duration)?)
    }

    /// The whole answer: what is proven of bodies that stay apart, the tolerance that was kept, what
    /// it took.
    ///
    /// # Errors
    /// As [`Problem::new`].
    pub fn answer<'b>(
        &mut self,
        a: impl Into<Moving<'b>>,
        b: impl Into<Moving<'b>>,
        duration: f64,
    ) -> Result<Answer, InputError> {
        let problem = Problem::new(a, b, duration, &self.config)?;
        Ok(self.schedule.solve(&problem, &mut self.oracle))
    }
}
