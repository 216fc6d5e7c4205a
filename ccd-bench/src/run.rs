//! Runs methods on scenes: each method gets the same queries, is timed and judged.

pub mod contest;
pub mod evaluation;
pub mod export;
pub mod measured;
