//! Schedules: the order in which the clocks of pairs are advanced.
//!
//! A pair consists of two nodes (`nodes/`: eight at once, in f32) or of two pieces (`pieces/`: one at a time, in
//! f64). A schedule keeps the waiting pairs (`queue.rs`, `stack.rs`, `fast/front.rs`) and the proven facts
//! (`proven.rs`). The steps of a search are in `search.rs`. Each question draws its own conclusions from them: the
//! first contact (`best_first.rs`, in steps `first_contact.rs`), any contact (`any_contact.rs`), the closest approach
//! (`closest_approach.rs`). `nearest.rs` measures the distance of the bodies at one clock, and `start.rs` that of
//! bodies in contact at the start. `answer.rs` runs the schedule under the query's policy for the start. `along.rs`
//! has the questions about trajectories. `rounds.rs` searches one period of bodies that turn many times, for all
//! periods that repeat it. `out_of_reach.rs` proves that bodies far from each other never touch.

mod along;
mod answer;
mod any_contact;
mod best_first;
mod capacity;
mod closest_approach;
mod contract;
mod depth_first;
#[cfg(feature = "hull-tree")]
mod fast;
mod first_contact;
mod meter;
mod naive;
mod nearest;
mod nodes;
mod out_of_reach;
mod pieces;
mod proven;
mod queue;
mod rounds;
mod scratch;
mod search;
pub(crate) mod solve;
mod stack;
mod start;
mod waiting;

pub use best_first::BestFirst;
pub use contract::Schedule;
pub use depth_first::DepthFirst;
#[cfg(feature = "hull-tree")]
pub use fast::Fast;
pub use first_contact::{FirstContact, Progress};
pub use naive::Naive;
