//! Runs methods on scenes, so that each method gets the same queries, is timed, and is judged.

pub mod contest;
pub mod evaluation;
pub mod export;
pub mod measured;
pub mod verdict;
