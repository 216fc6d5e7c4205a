//! Tests the same properties for every backend, schedule and kind of piece.
//!
//! `CCD_TEST_CASES` multiplies the number of random cases, and `CCD_TEST_SEED` picks other ones: the default is a
//! sample, and ten times as many a search before a release. `CCD_TEST_SLOW` adds the scenes that take minutes.

mod bad_inputs;
mod circles;
mod contact_normals;
mod contacts;
mod decomposition;
mod dense_hulls;
mod equal_bits;
mod exact;
mod feature_names;
mod flat_ground;
mod folds;
mod generators;
mod liars;
mod limits;
mod margin;
mod million;
mod models;
mod monotone;
mod motions;
mod near_misses;
mod never_late;
mod pages;
mod patch_liars;
mod project_files;
mod proven_bounds;
mod published_bound;
mod questions;
mod referee;
mod regressions;
mod same_names;
mod scenes;
mod shells;
mod start;
mod statuses;
mod symmetries;
mod units;
mod unsafe_code;
