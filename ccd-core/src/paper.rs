//! The schedules of the paper: a slow and simple one, and FAST as published `[FAST06]`.

#[cfg(feature = "hull-tree")]
pub(crate) mod fast;
pub(crate) mod naive;
