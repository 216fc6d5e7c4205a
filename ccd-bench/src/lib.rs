//! The `ccd` command's library: queries from tables, scenes, models, measurements.
//!
//! | to … | see |
//! |---|---|
//! | read motions, write results and contacts | [`motions`], [`results`], [`contacts`] |
//! | answer many queries, each timed alone | [`query`] |
//! | choose schedule and oracle at run time | [`engine`] |
//! | make the bodies and motions of the paper's scenes | [`model`], [`scene`] |
//! | compare every method on every scene | [`demo`] |

pub mod cli;
pub mod contacts;
pub mod demo;
pub mod engine;
pub mod model;
pub mod motions;
pub mod progress;
pub mod query;
pub mod results;
pub mod scene;
pub mod summary;
mod text;
