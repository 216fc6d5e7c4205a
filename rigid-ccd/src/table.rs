//! Tables as CSV: motions in, results and contacts out.

pub mod contacts;
mod lines;
pub mod motions;
mod quotes;
pub mod results;

pub use lines::Lines;
pub use quotes::Quotes;
