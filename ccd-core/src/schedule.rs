//! The public interface of schedules, which choose the order in which pairs of nodes are advanced.

use crate::answer::Answer;
use crate::distance::oracle::DistanceOracle;
use crate::engine::answer::EngineSchedule;
pub use crate::engine::best_first::{BestFirst, Progress};
use crate::error::InputError;
#[cfg(feature = "hull-tree")]
pub use crate::paper::fast::Fast;
pub use crate::paper::naive::Naive;
use crate::query::Query;
use crate::questions::along::contacts::first_contact;
pub use crate::questions::depth_first::DepthFirst;
pub use crate::questions::steps::FirstContactSearch;
pub use crate::settings::{EngineOptions, Shortcut, Shortcuts, VectorInstructions};

/// An algorithm that answers queries, by choosing the order in which the pairs of nodes of two bodies are advanced.
///
/// A schedule owns its working memory. Keep the schedule and the oracle between queries.
///
/// ```
/// use ccd_core::{schedule::{BestFirst, Naive, Schedule}, *};
/// # struct Balls;
/// # impl DistanceOracle for Balls {
/// #     type Cache = ();
/// #     fn separation(&mut self, pair: &PiecePair<'_>, _: &mut ()) -> Result<Claim, GiveUpReason> {
/// #         let axis = pair.b_to_a.transform_point(pair.b.points[0]) - pair.a.points[0];
/// #         Ok(Claim { axis, a: ConvexCombination::from_single_point(0), b: ConvexCombination::from_single_point(0) })
/// #     }
/// # }
/// fn outcome(mut schedule: impl Schedule<Balls>, query: &Query<'_>) -> Result<Outcome, InputError> {
///     Ok(schedule.first_contact(query, &mut Balls)?.outcome)
/// }
/// let ball = Body::sphere(0.5)?;
/// let flying = Motion::new(Pose::at([-3.0, 0.0, 0.0])?, [1.0, 0.0, 0.0], [0.0; 3])?;
/// let query = Query::new((&ball, flying), (&ball, Motion::STILL), 1.0, &Settings::DEFAULT)?;
/// assert!(matches!(outcome(BestFirst::default(), &query)?, Outcome::Free { .. }));
/// assert!(matches!(outcome(Naive::default(), &query)?, Outcome::Free { .. }));
/// # Ok::<(), InputError>(())
/// ```
pub trait Schedule<O: DistanceOracle> {
    /// Finds the time at which the bodies first touch.
    ///
    /// # Guarantee
    /// [Never late](crate#guarantee); ends on every input; the same call gives the same bits, unless a
    /// [deadline](crate::Settings::deadline) ends it.
    ///
    /// # Errors
    /// An [`InputError`] if a trajectory has no motion at some time, or one out of range. Queries about two motions
    /// have no errors.
    fn first_contact(&mut self, query: &Query<'_>, oracle: &mut O) -> Result<Answer, InputError>;
}

impl<O: DistanceOracle, S: EngineSchedule<O>> Schedule<O> for S {
    fn first_contact(&mut self, query: &Query<'_>, oracle: &mut O) -> Result<Answer, InputError> {
        match &query.constant_velocity_problem {
            Some(problem) => Ok(self.answer_first_contact(problem, oracle)),
            None => first_contact(self, query, oracle),
        }
    }
}
