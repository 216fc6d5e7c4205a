//! The closest approach along trajectories.

use super::Journey;
use super::leg::{Leg, Span};
use super::stretches::Stretches;
use crate::config::Config;
use crate::distance::oracle::DistanceOracle;
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::outcome::{Answer, Contact, Limit, Overlap};
use crate::schedule::DepthFirst;
use crate::schedule::closest_approach::{Beyond, ClosestApproach};

impl<O: DistanceOracle> DepthFirst<O> {
    /// Brackets the least distance of the bodies along their trajectories, to within the tolerance.
    ///
    /// # Guarantee
    /// That of [`ClosestApproach`], for the trajectories themselves; ends on every input.
    ///
    /// # Errors
    /// An [`InputError`] if a trajectory has no motion at some time, or one out of range.
    pub fn closest_approach_along(
        &mut self,
        journey: &Journey<'_>,
        oracle: &mut O,
    ) -> Result<Answer<ClosestApproach>, InputError> {
        // The margin plays no role.
        let config = Config {
            margin: 0.0,
            ..journey.config
        };
        let journey = &Journey {
            config,
            ..journey.clone()
        };
        let mut stretches = Stretches::new(journey);
        let mut found = Found {
            lower: f64::INFINITY,
            best: None,
        };
        while let Some(span) = stretches.next() {
            let config = match stretches.config() {
                Ok(config) => config,
                Err(reason) => return Ok(found.unresolved(journey, &stretches, reason)),
            };
            let leg = stretches.leg(span)?;
            let problem = leg.problem(journey, &config)?;
            let beyond = found.upper() + leg.stray;
            let answer = self.approach_below(&problem, beyond, oracle);
            stretches.add(&answer.stats);
            let is_beyond = answer.outcome.is_err();
            let (lower, upper, time) = match answer.outcome {
                Err(Beyond { lower }) => (lower, beyond, 0.0),
                Ok(ClosestApproach::Nearest {
                    lower,
                    time,
                    contact,
                }) => {
                    found.take(leg.time(time), leg.contact(contact));
                    (lower, contact.separation.upper, time)
                }
                Ok(ClosestApproach::Overlapping { overlap }) => {
                    if stretches.look_at_start(&leg)? {
                        continue;
                    }
                    if stretches.begins_at_start(&leg)? {
                        let overlapping = ClosestApproach::Overlapping { overlap };
                        return Ok(found.answer(journey, &stretches, overlapping));
                    }
                    if let Overlap::Pieces(contact) = overlap {
                        found.take(leg.span.from, leg.contact(contact));
                    }
                    (0.0, 0.0, 0.0)
                }
                Ok(ClosestApproach::Unresolved { nearest, reason }) => {
                    if let Some((time, contact)) = nearest {
                        found.take(leg.time(time), leg.contact(contact));
                    }
                    return Ok(found.unresolved(journey, &stretches, reason));
                }
            };
            let width = upper - lower;
            let lower = greater(0.0, leg.at_least(lower));
            let (upper, tolerance) = (found.upper(), journey.config.tolerance);
            // Where f64 does not certify the tolerance for the motions, cutting does not help. Bodies beyond the
            // least distance so far are so with their strays.
            let is_loose = width > tolerance && (is_beyond || leg.stray <= width);
            if lower >= upper - tolerance || is_loose || stretches.is_fine(&leg)? {
                found.lower = lesser(found.lower, lower);
            } else if !stretches.cut_about(leg.span, leg.time(time)) {
                return Ok(found.unresolved(journey, &stretches, Limit::Stalled));
            }
            if upper <= tolerance {
                found.lower = 0.0;
                break;
            }
        }
        let nearest = found.nearest(journey, &stretches);
        if nearest.outcome.meets_later(journey.config.tolerance) {
            return self.or_overlap_along(journey, oracle, nearest);
        }
        Ok(nearest)
    }

    /// Returns the answer for bodies that meet, unless they overlap at the start as well.
    fn or_overlap_along(
        &mut self,
        journey: &Journey<'_>,
        oracle: &mut O,
        answer: Answer<ClosestApproach>,
    ) -> Result<Answer<ClosestApproach>, InputError> {
        let leg = Leg::new(journey, Span { from: 0.0, to: 0.0 })?;
        let problem = leg.problem(journey, &journey.config)?;
        let start = self.closest_approach(&problem, oracle);
        let mut stats = answer.stats;
        stats.add(&start.stats);
        let outcome = match start.outcome {
            ClosestApproach::Overlapping { .. } => start.outcome,
            ClosestApproach::Nearest { .. } | ClosestApproach::Unresolved { .. } => answer.outcome,
        };
        Ok(Answer {
            outcome,
            stats,
            ..answer
        })
    }
}

/// The least distance found so far.
struct Found {
    /// A lower bound on all stretches that are done.
    lower: f64,
    best: Option<(f64, Contact)>,
}

impl Found {
    fn upper(&self) -> f64 {
        let upper = |(_, contact): (f64, Contact)| contact.separation.upper;
        self.best.map_or(f64::INFINITY, upper)
    }

    fn take(&mut self, time: f64, contact: Contact) {
        if contact.separation.upper < self.upper() {
            self.best = Some((time, contact));
        }
    }

    fn nearest(
        &self,
        journey: &Journey<'_>,
        stretches: &Stretches<'_, '_>,
    ) -> Answer<ClosestApproach> {
        let Some((time, contact)) = self.best else {
            return self.unresolved(journey, stretches, Limit::OracleGaveUp);
        };
        let lower = lesser(self.lower, contact.separation.upper);
        let nearest = ClosestApproach::Nearest {
            lower,
            time,
            contact: contact.no_nearer_than(lower),
        };
        self.answer(journey, stretches, nearest)
    }

    fn unresolved(
        &self,
        journey: &Journey<'_>,
        stretches: &Stretches<'_, '_>,
        reason: Limit,
    ) -> Answer<ClosestApproach> {
        let nearest = self
            .best
            .map(|(time, contact)| (time, contact.no_nearer_than(0.0)));
        let unresolved = ClosestApproach::Unresolved { nearest, reason };
        self.answer(journey, stretches, unresolved)
    }

    fn answer(
        &self,
        journey: &Journey<'_>,
        stretches: &Stretches<'_, '_>,
        outcome: ClosestApproach,
    ) -> Answer<ClosestApproach> {
        Answer {
            tolerance: greater(journey.config.tolerance, outcome.width()),
            outcome,
            stats: stretches.stats,
        }
    }
}
