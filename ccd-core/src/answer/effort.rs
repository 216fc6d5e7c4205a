//! The work of an oracle.

use crate::math::componentwise::impl_componentwise;

/// Counters for the work of an oracle, over many calls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// The number of steps from one feature or simplex to the next.
    pub steps: u64,
    /// The number of times that a search returned to an earlier state.
    pub cycle_count: u64,
    /// The number of times that the oracle gave up and another one was called.
    pub fallbacks: u64,
}

impl_componentwise!(Add::add for Effort { steps, cycle_count, fallbacks });
// A difference has the counts since an earlier state of the counters.
impl_componentwise!(Sub::sub for Effort { steps, cycle_count, fallbacks });
