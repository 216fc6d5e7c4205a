//! The results so far of a search for the closest approach along trajectories.

use crate::answer::{Answer, Contact, Limit, Outcome, Overlap, Unresolved};
use crate::engine::shortcuts::bounding_volumes::least_distance;
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::motion::span::Span;
use crate::query::Query;
use crate::questions::along::motions::StretchMotions;
use crate::questions::along::stretches::WaitingStretches;
use crate::questions::closest::ladder::{LowerBoundAttempts, MarginQuery};
use crate::tuning::MIN_CUT_LENGTH_SHARE;

impl Query<'_> {
    /// Returns a copy of the query for measuring distances, with a margin of 0 and no required clearance.
    pub(in crate::questions::along) fn query_without_margin(&self) -> Self {
        let mut query = Query {
            constant_velocity_problem: None,
            ..*self
        };
        (query.settings.margin, query.settings.clearance) = (0.0, None);
        query
    }

    /// Returns a copy of the query that asks for contacts with the margin, tolerance and budget of `margin_query`.
    pub(super) fn contact_query(&self, margin_query: MarginQuery) -> Self {
        let mut query = self.query_without_margin();
        query.settings.margin = margin_query.margin;
        query.settings.tolerance = margin_query.tolerance;
        query.settings.budget = margin_query.budget;
        query
    }
}

/// Bounds of the least distance of both bodies in one stretch of time, as they move by its motions, and the time at which
/// they are nearest.
#[derive(Default)]
pub(super) struct StretchDistanceBounds {
    pub(super) lower: f64,
    pub(super) upper: f64,
    /// The sum of both bodies' deviations, which bounds the difference between the bodies' distance and that of the
    /// approximate motions.
    pub(super) total_deviation_bound: f64,
    /// The time at which the motions are nearest, counted from the start of the stretch.
    pub(super) time: f64,
    /// The rate at which the motions approach each other at the time when they are nearest.
    pub(super) approach_rate: f64,
}

impl StretchDistanceBounds {
    /// Creates the result for motions that are farther apart than the least distance found so far. The bodies are so
    /// despite their deviations.
    pub(super) fn for_distant_motions(lower: f64) -> Self {
        StretchDistanceBounds {
            lower,
            upper: lower,
            ..StretchDistanceBounds::default()
        }
    }

    /// Returns whether the bounds are wider than the tolerance only because of rounding. Cutting the stretch does not
    /// help then.
    pub(super) fn is_limited_by_rounding(&self, tolerance: f64) -> bool {
        let width = self.upper - self.lower;
        width > tolerance && self.total_deviation_bound <= width
    }

    /// Returns the end of the stretch beyond which the distance probably decreases further; `None` if there is no such
    /// end. The motions are nearest at about that end. At their rate of approach there, the distance would fall by more
    /// than the deviations over another stretch of this length.
    pub(super) fn stretch_end_nearer_beyond(&self, motions: &StretchMotions) -> Option<f64> {
        let Span { from, end: to, .. } = motions.span;
        let (near, falls) = (
            MIN_CUT_LENGTH_SHARE * motions.span.length(),
            self.approach_rate * motions.span.length(),
        );
        let time = motions.query_time(self.time);
        if time - from <= near && -falls > motions.total_deviation_bound {
            Some(from)
        } else if to - time <= near && falls > motions.total_deviation_bound {
            Some(to)
        } else {
            None
        }
    }
}

/// The bounds of the bodies' least distance that a search along trajectories has found so far.
pub(super) struct LeastDistanceBounds {
    /// A lower bound of the distance in all finished stretches.
    pub(super) lower: f64,
    pub(super) nearest_contact: Option<(f64, Contact)>,
    /// The lower bound of the distance that is proven for all times, with the state of further attempts.
    pub(super) lower_bound_prover: LowerBoundAttempts,
}

impl LeastDistanceBounds {
    pub(super) fn new(query: &Query<'_>) -> Self {
        let is_timed = query.settings.deadline.is_some() || query.settings.stop.is_some();
        LeastDistanceBounds {
            lower: f64::INFINITY,
            nearest_contact: None,
            lower_bound_prover: LowerBoundAttempts::new(0.0, query.settings.budget)
                .with_earlier_first_attempt_if_timed(is_timed),
        }
    }

    pub(super) fn upper(&self) -> f64 {
        let upper = |(_, contact): (f64, Contact)| contact.separation.upper;
        self.nearest_contact.map_or(f64::INFINITY, upper)
    }

    /// Records the outcome of the search for the least distance of a stretch's motions, and returns its bounds.
    ///
    /// # Errors
    /// The limit that was reached.
    pub(super) fn record_stretch_outcome(
        &mut self,
        motions: &StretchMotions,
        outcome: &Outcome,
    ) -> Result<StretchDistanceBounds, Limit> {
        let mut seen = StretchDistanceBounds {
            total_deviation_bound: motions.total_deviation_bound,
            ..StretchDistanceBounds::default()
        };
        match *outcome {
            Outcome::LeastDistance {
                lower,
                time,
                contact,
            } => {
                self.record_contact(
                    motions.query_time(time),
                    motions.widen_separation_bounds(contact),
                );
                seen.lower = lower;
                seen.upper = contact.separation.upper;
                seen.time = time;
                seen.approach_rate = motions.approach_rate(time, &contact);
            }
            Outcome::Overlapping { overlap, .. } => {
                if let Overlap::Pieces(contact) = overlap {
                    self.record_contact(
                        motions.span.from,
                        motions.widen_separation_bounds(contact),
                    );
                }
            }
            Outcome::Unresolved(known) => {
                if let Some((time, contact)) = known.nearest_contact {
                    self.record_contact(
                        motions.query_time(time),
                        motions.widen_separation_bounds(contact),
                    );
                }
                return Err(known.limit);
            }
            _ => unreachable!("no outcome of a search for the least distance"),
        }
        Ok(seen)
    }

    pub(super) fn record_contact(&mut self, time: f64, contact: Contact) {
        if contact.separation.upper < self.upper() {
            self.nearest_contact = Some((time, contact));
        }
    }

    pub(super) fn least_distance_answer(&self, stretches: &WaitingStretches<'_, '_>) -> Answer {
        let Some((time, contact)) = self.nearest_contact else {
            let reason = Limit::OracleGaveUp;
            return self.answer(stretches, self.unresolved_outcome(0.0, reason));
        };
        self.answer(
            stretches,
            Outcome::from_least_distance(self.lower, time, contact),
        )
    }

    /// Returns the unresolved answer for a search that reached a limit in the stretch `span`. For this stretch and the
    /// waiting ones, bounding balls of the bodies give the lower bound.
    pub(super) fn unresolved(
        &self,
        stretches: &WaitingStretches<'_, '_>,
        span: Span,
        reason: Limit,
    ) -> Answer {
        let query = stretches.query;
        let apart = |&span: &Span| {
            let motions = StretchMotions::new(query, span)?;
            let problem = motions.problem(query, &query.settings)?;
            Ok(motions.lower_bound_for_bodies(least_distance(&problem)))
        };
        let spans = stretches.waiting_spans.iter().chain([&span]);
        // Written so that NaN is no bound.
        let known = |apart: Result<f64, InputError>| apart.ok().filter(|&apart| apart > 0.0);
        let apart = spans.map(|span| known(apart(span)).unwrap_or(0.0));
        let lower = apart.fold(self.lower, lesser);
        self.answer(stretches, self.unresolved_outcome(lower, reason))
    }

    /// Returns the unresolved outcome for a search that reached a limit; `lower` is a lower bound of the distance at
    /// all times.
    fn unresolved_outcome(&self, lower: f64, limit: Limit) -> Outcome {
        let lower = lesser(greater(self.lower_bound_prover.lower, lower), self.upper());
        let seen = |(time, contact): (f64, Contact)| (time, contact.cap_lower_bound(lower));
        Outcome::Unresolved(Unresolved::for_least_distance(
            lower,
            self.nearest_contact.map(seen),
            limit,
        ))
    }

    pub(super) fn answer(&self, stretches: &WaitingStretches<'_, '_>, outcome: Outcome) -> Answer {
        Answer {
            tolerance: greater(
                stretches.query.settings.tolerance,
                outcome.least_distance_bracket_width(),
            ),
            outcome,
            stats: stretches.stats,
        }
    }
}
