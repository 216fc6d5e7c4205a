//! The deadline and the stop flag of a search over all pairs of links.

use super::LinkContactSettings;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// The time at which a search ends, and the flag with which another thread ends it.
#[derive(Clone, Debug)]
pub(super) struct SearchEnd {
    time: Option<Instant>,
    pub(super) stop: Option<Arc<AtomicBool>>,
}

impl SearchEnd {
    /// Starts the time of the deadline.
    pub(super) fn starting_now(settings: &LinkContactSettings) -> Self {
        SearchEnd {
            // A deadline beyond the range of the clock is no deadline.
            time: settings
                .deadline
                .and_then(|deadline| Instant::now().checked_add(deadline)),
            stop: settings.stop.clone(),
        }
    }

    pub(super) fn is_reached(&self) -> bool {
        let stop = self.stop.as_ref();
        stop.is_some_and(|stop| stop.load(Ordering::Relaxed))
            || self.time.is_some_and(|time| Instant::now() >= time)
    }
}
