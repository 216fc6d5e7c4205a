//! What is common to all queries of a solver.

use ccd_core::{Config, InputError, Journey, Moving, Problem, Travelling};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Tolerance and limits of all queries.
#[derive(Default)]
pub(super) struct Settings {
    pub(super) config: Config,
    pub(super) stop: Option<Arc<AtomicBool>>,
}

impl Settings {
    /// Poses a query over two moving bodies.
    pub(super) fn problem<'s, 'b: 's>(
        &'s self,
        a: impl Into<Moving<'b>>,
        b: impl Into<Moving<'b>>,
        duration: f64,
    ) -> Result<Problem<'s>, InputError> {
        let (a, b): (Moving<'s>, Moving<'s>) = (a.into(), b.into());
        let problem = Problem::new(a, b, duration, &self.config)?;
        Ok(match &self.stop {
            Some(stop) => problem.stopped_by(stop),
            None => problem,
        })
    }

    /// Poses a query over two bodies on trajectories.
    pub(super) fn journey<'s, 'b: 's>(
        &'s self,
        a: impl Into<Travelling<'b>>,
        b: impl Into<Travelling<'b>>,
        duration: f64,
    ) -> Result<Journey<'s>, InputError> {
        let (a, b): (Travelling<'s>, Travelling<'s>) = (a.into(), b.into());
        let journey = Journey::new(a, b, duration, &self.config)?;
        Ok(match &self.stop {
            Some(stop) => journey.stopped_by(stop),
            None => journey,
        })
    }
}
