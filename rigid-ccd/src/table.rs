//! Tables of the command, as CSV: motions and paths are read; results and contacts are written.
//!
//! Public only because `ccd-bench` shares them; no stable interface.

pub(crate) mod contacts;
pub mod courses;
mod error;
mod lines;
pub mod motions;
pub mod paths;
mod position;
mod quotes;
mod records;
pub(crate) mod results;

pub use lines::Lines;
pub use quotes::Quotes;
