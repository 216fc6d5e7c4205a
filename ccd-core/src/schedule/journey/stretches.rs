//! The stretches of time that are still to be examined, and the work left for them.

use super::leg::{Leg, Span};
use super::{Journey, Travelling};
use crate::config::Config;
use crate::error::InputError;
use crate::limits::MAX_COORDINATE;
use crate::math::order::{greater, lesser};
use crate::outcome::{Limit, Stats};
use crate::tolerance::{LEAST_CUT, STRAY_SHARE};
use std::time::Instant;

/// The stretches that wait, the next one last, and the work so far.
pub(super) struct Stretches<'j, 'a> {
    journey: &'j Journey<'a>,
    waiting: Vec<Span>,
    pub(super) stats: Stats,
    looked_at_start: bool,
    /// None if there is no deadline; then no clock is read.
    begun: Option<Instant>,
}

impl<'j, 'a> Stretches<'j, 'a> {
    /// Starts with the whole duration.
    pub(super) fn new(journey: &'j Journey<'a>) -> Self {
        Stretches {
            journey,
            waiting: vec![Span {
                from: 0.0,
                to: journey.duration,
            }],
            stats: Stats::default(),
            looked_at_start: false,
            begun: journey.config.deadline.map(|_| Instant::now()),
        }
    }

    pub(super) fn next(&mut self) -> Option<Span> {
        self.waiting.pop()
    }

    /// Returns the first time of all stretches that wait; infinite if none does.
    pub(super) fn first(&self) -> f64 {
        let starts = self.waiting.iter().map(|span| span.from);
        starts.fold(f64::INFINITY, lesser)
    }

    /// Returns the settings with what is left of budget and deadline.
    pub(super) fn config(&self) -> Result<Config, Limit> {
        let config = &self.journey.config;
        let budget = config.budget.checked_sub(self.stats.work());
        let deadline = match (config.deadline, self.begun) {
            (Some(deadline), Some(begun)) => match deadline.checked_sub(begun.elapsed()) {
                Some(left) => Some(left),
                None => return Err(Limit::Deadline),
            },
            _ => None,
        };
        Ok(Config {
            budget: budget.filter(|&left| left > 0).ok_or(Limit::Budget)?,
            deadline,
            ..*config
        })
    }

    /// Adds the work on a stretch.
    pub(super) fn add(&mut self, stats: &Stats) {
        // A stretch is worth a visit, even if it takes none.
        self.stats.iterations += 1;
        self.stats.add(stats);
    }

    /// Returns the motions in a stretch, cut until the bodies stray from them by a length that queries
    /// take.
    pub(super) fn leg(&mut self, mut span: Span) -> Result<Leg, InputError> {
        loop {
            let leg = Leg::new(self.journey, span)?;
            let most = MAX_COORDINATE - self.journey.config.margin;
            // Written so that NaN is too much.
            if leg.stray <= most || !self.cut(span, 0.5) {
                return Ok(leg);
            }
            span = self.waiting.pop().unwrap_or(span);
        }
    }

    /// Returns true if a contact of a leg's motions is one of the bodies, as well as can be told: within the
    /// tolerance, or cutting does not make it any better.
    pub(super) fn is_fine(&self, leg: &Leg) -> Result<bool, InputError> {
        Ok(leg.stray <= STRAY_SHARE * self.journey.config.tolerance || self.is_shortest(leg)?)
    }

    /// Returns true if the bodies stray hardly farther than in a stretch of no length: by rounding.
    fn is_shortest(&self, leg: &Leg) -> Result<bool, InputError> {
        let from = leg.span.from;
        let least = Leg::new(self.journey, Span { from, to: from })?;
        Ok(leg.stray <= 2.0 * least.stray)
    }

    /// Returns true if the poses at the start of a leg's motions are those of the bodies at the start, up to
    /// rounding.
    pub(super) fn begins_at_start(&self, leg: &Leg) -> Result<bool, InputError> {
        Ok(leg.span.from == 0.0 && (leg.stray == 0.0 || self.is_shortest(leg)?))
    }

    /// Lets the pose at the start be next, and then the leg again, if the leg's motions begin beside it: where
    /// they overlap at the start, the bodies need not. Returns false once the start was looked at, and for legs
    /// that begin later.
    pub(super) fn look_at_start(&mut self, leg: &Leg) -> Result<bool, InputError> {
        let Span { from, .. } = leg.span;
        if from > 0.0 || self.looked_at_start || self.begins_at_start(leg)? {
            return Ok(false);
        }
        self.looked_at_start = true;
        self.waiting.extend([leg.span, Span { from, to: from }]);
        Ok(true)
    }

    /// Lets a stretch be next.
    pub(super) fn push(&mut self, span: Span) {
        self.waiting.push(span);
    }

    /// Cuts a stretch in two, at a corner or after a share of it, and lets the earlier part be next. Returns
    /// false if it cannot be cut.
    pub(super) fn cut(&mut self, span: Span, share: f64) -> bool {
        let Some([early, late]) = self.parts(span, share) else {
            return false;
        };
        self.waiting.extend([late, early]);
        true
    }

    /// Cuts a stretch in two, and lets the part with a time be next. Returns false if it cannot be cut.
    pub(super) fn cut_about(&mut self, span: Span, time: f64) -> bool {
        let Some([early, late]) = self.parts(span, 0.5) else {
            return false;
        };
        match time < late.from {
            true => self.waiting.extend([late, early]),
            false => self.waiting.extend([early, late]),
        }
        true
    }

    fn parts(&self, span: Span, share: f64) -> Option<[Span; 2]> {
        let Span { from, to } = span;
        let Journey { a, b, .. } = self.journey;
        let corner = |body: &Travelling<'_>| {
            let corner = body.trajectory.corner(from, to)?;
            (corner > from && corner < to).then_some(corner)
        };
        let share = greater(LEAST_CUT, lesser(share, 0.5));
        let at = corner(a)
            .or_else(|| corner(b))
            .unwrap_or(from + share * (to - from));
        (at > from && at < to).then_some([Span { from, to: at }, Span { from: at, to }])
    }
}
