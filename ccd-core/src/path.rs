//! A motion in a problem's own units.
pub(crate) struct Path;
