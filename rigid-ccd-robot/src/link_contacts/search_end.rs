//! The deadline and the stop flag of a search over all pairs of links.

use super::LinkContactSettings;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// The time at which a search ends, and the flag with which another thread can end it.
#[derive(Clone, Debug)]
pub(super) struct SearchEnd {
    end_time: Option<Instant>,
    pub(super) stop: Option<Arc<AtomicBool>>,
}

impl SearchEnd {
    /// Creates the end of a search that starts now.
    pub(super) fn starting_now(settings: &LinkContactSettings) -> Self {
        SearchEnd {
            // A deadline beyond the range of the clock is no deadline.
            end_time: settings
                .deadline
                .and_then(|deadline| Instant::now().checked_add(deadline)),
            stop: settings.stop.clone(),
        }
    }

    pub(super) fn is_reached(&self) -> bool {
        let stop = self.stop.as_ref();
        stop.is_some_and(|stop| stop.load(Ordering::Relaxed))
            || self.end_time.is_some_and(|end| Instant::now() >= end)
    }
}
