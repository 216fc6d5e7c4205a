//! The contract of schedules.

use crate::distance::oracle::DistanceOracle;
use crate::outcome::Answer;
use crate::problem::Problem;

/// An order in which to advance the pairs of two bodies until the first contact is certain.
///
/// A schedule owns its working memory: keep it, and the oracle, between queries.
///
/// ```
/// use ccd_core::{schedule::{BestFirst, Naive, Schedule}, *};
/// # struct Balls;
/// # impl DistanceOracle for Balls {
/// #     type Cache = ();
/// #     fn separation(&mut self, pair: &PiecePair<'_>, _: &mut ()) -> Result<Claim, GiveUp> {
/// #         let axis = pair.b_to_a.point(pair.b.points[0]) - pair.a.points[0];
/// #         Ok(Claim { axis, a: Combination::point(0), b: Combination::point(0) })
/// #     }
/// # }
/// fn outcome(mut schedule: impl Schedule<Balls>, problem: &Problem<'_>) -> Outcome {
///     schedule.solve(problem, &mut Balls).outcome
/// }
/// let ball = Body::ball(0.5)?;
/// let flying = Motion::new(Pose::at([-3.0, 0.0, 0.0])?, [1.0, 0.0, 0.0], [0.0; 3])?;
/// let problem = Problem::new((&ball, flying), (&ball, Motion::STILL), 1.0, &Config::default())?;
/// assert!(matches!(outcome(BestFirst::default(), &problem), Outcome::Free { .. }));
/// assert!(matches!(outcome(Naive::default(), &problem), Outcome::Free { .. }));
/// # Ok::<(), InputError>(())
/// ```
pub trait Schedule<O: DistanceOracle> {
    /// Answers a query.
    ///
    /// # Guarantee
    /// [Never late](crate#guarantee); ends on every input; the same call gives the same bits, unless a
    /// [deadline](crate::Config::deadline) ends it.
    fn solve(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer;
}
