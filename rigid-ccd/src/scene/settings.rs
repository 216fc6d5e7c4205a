//! What is common to all pairs of a scene.

use ccd_core::{Config, InputError, Moving, Problem};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// Tolerance and limits of all pairs.
#[derive(Default)]
pub(super) struct Settings {
    pub(super) config: Config,
    pub(super) stop: Option<Arc<AtomicBool>>,
}

/// The duration that is asked about, and the time that is left to answer.
#[derive(Clone, Copy)]
pub(super) struct Clock {
    pub(super) duration: f64,
    pub(super) deadline: Option<(Instant, Duration)>,
}

impl Settings {
    /// Starts the time for the answer.
    pub(super) fn clock(&self, duration: f64) -> Clock {
        Clock {
            duration,
            deadline: self.config.deadline.map(|limit| (Instant::now(), limit)),
        }
    }

    /// Poses the problem of two bodies that are to keep that much more than the margin.
    pub(super) fn problem<'a>(
        &'a self,
        [a, b]: [Moving<'a>; 2],
        clock: &Clock,
        more: f64,
    ) -> Result<Problem<'a>, InputError> {
        let left = |(begun, limit): (Instant, Duration)| limit.saturating_sub(begun.elapsed());
        let config = Config {
            margin: self.config.margin + more,
            deadline: clock.deadline.map(left),
            ..self.config
        };
        let problem = Problem::new(a, b, clock.duration, &config)?;
        Ok(match &self.stop {
            Some(stop) => problem.stopped_by(stop),
            None => problem,
        })
    }
}
