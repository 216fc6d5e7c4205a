//! Schedules: the order in which the clocks of pairs are advanced.

mod answer;
mod best_first;
mod contract;
#[cfg(feature = "hull-tree")]
mod fast;
mod meter;
mod naive;
mod nodes;
mod pieces;
mod proven;
mod queue;
mod start;

pub use best_first::BestFirst;
pub use contract::Schedule;
#[cfg(feature = "hull-tree")]
pub use fast::Fast;
pub use naive::Naive;
