//! The parts of the property suite: generated models, an independent referee, scenes with closed-form answers, and the
//! code that runs one property over every backend, schedule and kind of piece.

pub mod analytic;
pub mod backends;
pub mod case;
pub mod checks;
pub mod corpus;
pub mod courses;
pub mod distances;
pub mod exact;
pub mod liars;
pub mod mixed;
pub mod models;
pub mod patches;
pub mod query;
pub mod questions;
pub mod referee;
pub mod solids;
pub mod strategies;
pub mod tolerance;

/// An item whose documentation is the README, so that the README's code runs as doctests.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct ReadmeDoctests;
