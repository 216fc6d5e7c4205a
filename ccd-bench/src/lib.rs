//! The `ccd` command's library: queries from tables, scenes, models, measurements.
//!
//! | to … | see |
//! |---|---|
//! | read motions, write results and contacts | [`motions`], [`results`], [`contacts`] |
//! | answer many queries, each timed alone | [`query`] |
//! | choose schedule and oracle at run time | [`engine`] |
//! | make the bodies and motions of the paper's scenes | [`model`], [`scene`] |
//! | know the exact first contact | [`referee`] |
//! | answer by published rivals, or by peer libraries | [`rival`], [`peer`] |
//! | time and judge whoever answers, on every scene | [`contest`], [`evaluation`] |
//! | show what came of it | [`tables`], [`chart`], [`report`] |

pub mod chart;
pub mod cli;
pub mod contacts;
pub mod contender;
pub mod contest;
pub mod crew;
pub mod engine;
pub mod evaluation;
pub mod joined;
mod limits;
mod lines;
pub mod measured;
pub mod model;
pub mod motions;
pub mod peer;
pub mod presentation;
pub mod progress;
pub mod query;
mod quotes;
pub mod referee;
pub mod report;
pub mod results;
pub mod rival;
pub mod scene;
pub mod summary;
pub mod tables;
mod text;
