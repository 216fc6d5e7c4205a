//! The interface between schedules and the engine.

use super::scratch::Scratch;
use crate::answer::Answer;
use crate::distance::oracle::DistanceOracle;
use crate::problem::Problem;

/// A schedule as the engine calls it.
pub(crate) trait Solve<O: DistanceOracle> {
    /// Returns whether the schedule handles accelerations of the bodies' centres. Otherwise they count as deviations
    /// from a straight path.
    fn takes_accelerations(&self) -> bool;

    /// Answers a query about the first contact of moving bodies.
    fn solve(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer;

    /// Returns the scratch memory that is kept between queries.
    fn scratch(&mut self) -> &mut Scratch;
}
