//! Rows answered one by one: resumed, counted, certified, timed.

pub(crate) mod bad_rows;
pub(crate) mod certificates;
pub(crate) mod contacts;
pub(crate) mod counts;
pub(crate) mod raised_tolerances;
pub(crate) mod resumable;
pub(crate) mod time_histogram;
pub(crate) mod timed;
