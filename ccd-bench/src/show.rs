//! Tables, charts and the page that show measurements.

pub mod chart;
pub mod presentation;
pub mod report;
pub mod tables;
