//! What ends a search about all pairs of links.

use super::LinkContactSettings;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// The time at which a search ends, and the flag by which another thread ends it.
#[derive(Clone, Debug)]
pub(super) struct SearchEnd {
    time: Option<Instant>,
    pub(super) stop: Option<Arc<AtomicBool>>,
}

impl SearchEnd {
    /// Returns the end of a search that starts now.
    pub(super) fn starting_now(settings: &LinkContactSettings) -> Self {
        SearchEnd {
            // A time beyond the end of the clock is none.
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
