//! Schedules: the order in which the clocks of pairs are advanced.
//!
//! A pair consists of two nodes (`nodes/`: eight at once, in f32) or of two pieces (`pieces/`: one
//! at a time, in f64). A schedule keeps the waiting pairs (`queue.rs`, `fast/front.rs`) and the
//! proven facts (`proven.rs`). `start.rs` measures bodies in contact at the start; `answer.rs` runs
//! the schedule as the policy for the start demands. `out_of_reach.rs` tells bodies apart that are far
//! from each other all the time.

mod answer;
mod best_first;
mod contract;
#[cfg(feature = "hull-tree")]
mod fast;
mod memory;
mod meter;
mod naive;
mod nodes;
mod out_of_reach;
mod pieces;
mod proven;
mod queue;
mod start;

pub use best_first::BestFirst;
pub use contract::Schedule;
#[cfg(feature = "hull-tree")]
pub use fast::Fast;
pub use naive::Naive;
