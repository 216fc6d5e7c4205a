//! Helpers for the rivals' tests.

pub(super) mod samples;
pub(super) mod trials;
