//! The interface of schedules to the engine.

use super::scratch::Scratch;
use crate::answer::Answer;
use crate::distance::oracle::DistanceOracle;
use crate::problem::Problem;

/// A schedule, as the engine calls it.
pub(crate) trait Solve<O: DistanceOracle> {
    /// Returns whether the search takes accelerations of the bodies' centres into account. Otherwise they count as
    /// deviations.
    fn takes_accelerations(&self) -> bool;

    /// Answers a query about motions.
    fn solve(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer;

    /// Returns the memory kept between queries.
    fn scratch(&mut self) -> &mut Scratch;
}
