//! Bounds of the times for which pairs of pieces stay apart, one pair at a time in f64.
//!
//! `pair.rs` advances a pair. A `placed_pair.rs` has its pieces at one clock, and asks the oracle for their distance.
//! `contact_rule.rs` decides whether that is a contact. If it is not, `planes.rs` proves for how long planes keep the
//! pieces apart: by the rates of their points at present (`present_rate.rs`), or by their `heights.rs` over time.
//! `level.rs` has the pieces that come to touch on the ground that the bodies rest on.

pub(crate) mod contact_rule;
pub(crate) mod heights;
mod level;
pub(crate) mod pair;
pub(crate) mod placed_pair;
pub(crate) mod planes;
mod present_rate;
