//! The contract of schedules.

use crate::distance::oracle::DistanceOracle;
use crate::outcome::Answer;
use crate::problem::Problem;

/// An order in which to advance the pairs of two bodies until the first contact is certain.
///
/// A schedule owns the memory that it works in: keep it, and the oracle, between queries.
pub trait Schedule<O: DistanceOracle> {
    /// Answers a query.
    ///
    /// # Guarantee
    /// [Never late](crate#guarantee); ends on every input; the same call gives the same bits, unless a
    /// [deadline](crate::Config::deadline) ends it.
    fn solve(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer;
}
