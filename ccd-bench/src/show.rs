//! Shows measurements as tables, charts and a page.

pub mod chart;
pub mod presentation;
pub mod report;
pub mod tables;
