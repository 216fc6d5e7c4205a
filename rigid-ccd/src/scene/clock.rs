//! The time limit of a query on a scene, shared by all pairs.

use ccd_core::Settings;
use std::time::{Duration, Instant};

/// The duration of the motions, and the deadline for all pairs together.
#[derive(Clone, Copy)]
pub(super) struct TimeLimits {
    pub(super) duration: f64,
    deadline: Option<(Instant, Duration)>,
}

impl TimeLimits {
    /// Starts to measure the time until the deadline.
    pub(super) fn new(duration: f64, settings: &Settings) -> Self {
        TimeLimits {
            duration,
            deadline: settings.deadline.map(|limit| (Instant::now(), limit)),
        }
    }

    /// Returns the time left until the deadline; `None` without a deadline.
    pub(super) fn remaining_time(&self) -> Option<Duration> {
        let (begun, limit) = self.deadline?;
        Some(limit.saturating_sub(begun.elapsed()))
    }
}
