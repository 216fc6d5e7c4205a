//! Methods on scenes: each asked the same queries, timed and judged.

pub mod contest;
pub mod evaluation;
pub mod joined;
pub mod measured;
