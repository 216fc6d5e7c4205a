//! Fuzz targets, and the judge of random queries.
//!
//! A target is a function of bytes that panics if the product has a fault. The same functions are run
//! guided by coverage ([`libfuzzer/`](../libfuzzer)), and over the kept corpus in every `cargo test`.
//! The example `fuzz` draws queries from families of hard cases, for the same judge.
//!
//! The judge shares nothing with the engine or with the referee of `ccd-bench`, except the public interface
//! under test: it has its own arithmetic and verdicts.
#![allow(
    missing_docs,
    unreachable_pub,
    reason = "parts of programs, not a library"
)]

pub mod case;
pub mod double;
pub mod engine;
pub mod judge;
mod memory;
pub mod nearest;
pub mod raw_motion;
pub mod referee;
pub mod solid;
pub mod targets;
pub mod trial;
pub mod vector;

/// Removes libFuzzer's panic hook, which aborts even at panics that the tested code catches, such as those of
/// libraries. Panics that are not caught still abort.
pub fn ignore_caught_panics() {
    drop(std::panic::take_hook());
}
