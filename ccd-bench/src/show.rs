//! Shows measurements as tables, charts and a page.

pub mod chart;
pub mod comparable;
pub mod page;
pub mod presentation;
pub mod sentences;
pub mod splice;
pub mod tables;
pub mod views;
