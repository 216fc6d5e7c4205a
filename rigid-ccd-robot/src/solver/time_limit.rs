//! The time after which a search ends, and the flag that stops it.

use rigid_ccd::Settings;
use rigid_ccd::answer::Limit;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// The time after which a search ends, and the flag by which another thread stops it.
#[derive(Clone, Debug)]
pub(crate) struct StopCondition {
    end: Option<Instant>,
    stop: Option<Arc<AtomicBool>>,
}

impl StopCondition {
    pub(crate) const NONE: StopCondition = StopCondition {
        end: None,
        stop: None,
    };

    /// Returns the limit of a search that starts now.
    pub(crate) fn starting_now(settings: &Settings) -> Self {
        StopCondition {
            // A time beyond the end of the clock is none.
            end: settings
                .deadline
                .and_then(|deadline| Instant::now().checked_add(deadline)),
            stop: settings.stop.clone(),
        }
    }

    /// Returns the limit that ends the search now; `None` if it goes on.
    pub(crate) fn reached_limit(&self) -> Option<Limit> {
        if self.end.is_some_and(|end| Instant::now() >= end) {
            return Some(Limit::Deadline);
        }
        let stop = self.stop.as_ref();
        let is_stopped = stop.is_some_and(|stop| stop.load(Ordering::Relaxed));
        is_stopped.then_some(Limit::Stopped)
    }

    /// Returns the time that is left.
    pub(crate) fn remaining(&self) -> Option<Duration> {
        self.end
            .map(|end| end.saturating_duration_since(Instant::now()))
    }
}
