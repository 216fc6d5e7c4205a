//! The search for contacts: conservative advancement in which each pair has its own clock.
//!
//! A pair consists of two nodes (`nodes/`: eight at once, in f32) or of two pieces (`pieces/`: one at a time, in
//! f64). `search.rs` has the steps of every search: the next waiting pair is proven apart for longer, or split.
//! `best_first.rs` takes the pair of least clock from `queue.rs`, up to a time or to the end. `proven.rs` keeps what is
//! proven on the way. `subproblems.rs` has the problems of a query, which are searched one after another: those that the
//! policy for the start asks for, and the periods of motions that repeat (`rounds.rs`). `answer.rs` answers queries by
//! schedules that search a problem at once, within the limits of `meter.rs`. `start.rs` measures bodies in contact at the
//! start, `nearest.rs` the bodies at one clock. `given_bodies.rs` translates an answer to the bodies that the caller
//! gave. What `shortcuts/` holds proves at once what a search would prove in many steps.

pub(crate) mod answer;
pub(crate) mod best_first;
pub(crate) mod capacity;
pub(crate) mod closer_look;
pub(crate) mod given_bodies;
pub(crate) mod meter;
pub(crate) mod nearest;
pub(crate) mod nodes;
pub(crate) mod pieces;
pub(crate) mod proven;
pub(crate) mod queue;
pub(crate) mod rounds;
pub(crate) mod scratch;
pub(crate) mod search;
pub(crate) mod search_buffers;
pub(crate) mod shortcuts;
pub(crate) mod start;
pub(crate) mod subproblems;
