//! Test helpers that all rivals share.

pub(super) mod samples;
pub(super) mod trials;
