//! Tables of the command, as CSV: motions are read; results and contacts are written.
//!
//! Public only because `ccd-bench` shares them; no stable interface.

pub(crate) mod contacts;
mod lines;
pub mod motions;
mod quotes;
pub(crate) mod results;

pub use lines::Lines;
pub use quotes::Quotes;
