//! Schedules: the order in which the clocks of pairs are advanced.

mod best_first;
mod expand;
#[cfg(feature = "hull-tree")]
mod fast;
mod given;
mod group;
#[cfg(feature = "hull-tree")]
mod hulls;
mod lanes;
mod meter;
mod moment;
mod naive;
mod nearest;
mod pair;
mod queue;
mod start;

pub use best_first::BestFirst;
#[cfg(feature = "hull-tree")]
pub use fast::Fast;
pub use naive::Naive;

use crate::oracle::DistanceOracle;
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
