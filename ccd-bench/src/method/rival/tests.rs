//! What the rivals' tests share.

pub(super) mod samples;
pub(super) mod trials;
