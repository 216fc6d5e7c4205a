//! The schedules of the paper: a slow and obvious one, and FAST as published `[FAST06]`.

#[cfg(feature = "hull-tree")]
pub(crate) mod fast;
pub(crate) mod naive;
