//! The closest approach along trajectories.

use super::Journey;
use super::leg::{Leg, Span};
use super::stretches::Stretches;
use crate::distance::oracle::DistanceOracle;
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::outcome::{Answer, Contact, Limit, Overlap};
use crate::schedule::DepthFirst;
use crate::schedule::closest_approach::{Beyond, ClosestApproach};
use crate::tolerance::STRAY_SHARE;

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
        let journey = &journey.measuring();
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
            if let Some(time) = stretches.looks_too_long(&leg) {
                let length =
                    self.worthwhile(journey, oracle, &leg, time, &mut found, &mut stretches)?;
                if stretches.cut_about(leg.span, time, 2.0 * length) {
                    continue;
                }
            }
            let problem = leg.problem(journey, &config)?;
            let beyond = found.upper() + leg.stray;
            let answer = self.approach_below(&problem, beyond, oracle);
            stretches.add(&answer.stats);
            let seen = match answer.outcome {
                Err(Beyond { lower }) => Seen {
                    lower,
                    upper: beyond,
                    // Bodies beyond the least distance so far are so with their strays.
                    blur: 0.0,
                    time: 0.0,
                },
                Ok(ClosestApproach::Overlapping { .. }) if stretches.look_at_start(&leg)? => {
                    continue;
                }
                Ok(outcome @ ClosestApproach::Overlapping { .. })
                    if stretches.begins_at_start(&leg)? =>
                {
                    return Ok(found.answer(journey, &stretches, outcome));
                }
                Ok(outcome) => match found.see(&leg, &outcome) {
                    Ok(seen) => seen,
                    Err(reason) => return Ok(found.unresolved(journey, &stretches, reason)),
                },
            };
            let lower = greater(0.0, leg.at_least(seen.lower));
            let (upper, tolerance) = (found.upper(), journey.config.tolerance);
            let is_loose = seen.is_loose(tolerance);
            if lower >= upper - tolerance || is_loose || stretches.is_fine(&leg)? {
                found.lower = lesser(found.lower, lower);
                stretches.prove(&leg);
            } else {
                let time = leg.time(seen.time);
                let length =
                    self.worthwhile(journey, oracle, &leg, time, &mut found, &mut stretches)?;
                if !stretches.cut_about(leg.span, time, length) {
                    return Ok(found.unresolved(journey, &stretches, Limit::Stalled));
                }
            }
            if found.upper() <= tolerance {
                found.lower = 0.0;
                break;
            }
        }
        let nearest = found.nearest(journey, &stretches);
        match nearest.outcome.meets_later(journey.config.tolerance) {
            true => self.or_overlap_along(journey, oracle, nearest, &mut stretches),
            false => Ok(nearest),
        }
    }

    /// Returns the answer for bodies that meet, unless they overlap at the start as well.
    fn or_overlap_along(
        &mut self,
        journey: &Journey<'_>,
        oracle: &mut O,
        nearest: Answer<ClosestApproach>,
        stretches: &mut Stretches<'_, '_>,
    ) -> Result<Answer<ClosestApproach>, InputError> {
        let start = self.measure(journey, oracle, 0.0, stretches)?;
        Ok(Answer {
            outcome: match start {
                Some(overlapping @ ClosestApproach::Overlapping { .. }) => overlapping,
                _ => nearest.outcome,
            },
            stats: stretches.stats,
            ..nearest
        })
    }

    /// Measures the bodies at a time of a leg, and returns the length of a stretch whose strays leave no doubt there.
    fn worthwhile(
        &mut self,
        journey: &Journey<'_>,
        oracle: &mut O,
        leg: &Leg,
        time: f64,
        found: &mut Found,
        stretches: &mut Stretches<'_, '_>,
    ) -> Result<f64, InputError> {
        let distance = match self.measure(journey, oracle, time, stretches)? {
            Some(ClosestApproach::Nearest { contact, .. }) => {
                found.take(time, contact);
                contact.separation.upper
            }
            _ => 0.0,
        };
        let beyond = greater(journey.config.tolerance, distance - found.upper());
        Ok(leg.length_for(STRAY_SHARE * beyond))
    }

    /// Measures the bodies at a time, with bounds that hold where they stray from their poses by rounding; none if
    /// no work is left.
    fn measure(
        &mut self,
        journey: &Journey<'_>,
        oracle: &mut O,
        time: f64,
        stretches: &mut Stretches<'_, '_>,
    ) -> Result<Option<ClosestApproach>, InputError> {
        let Ok(config) = stretches.config() else {
            return Ok(None);
        };
        let span = Span {
            from: time,
            to: time,
        };
        let leg = Leg::new(journey, span)?;
        let answer = self.closest_approach(&leg.problem(journey, &config)?, oracle);
        stretches.stats.add(&answer.stats);
        Ok(Some(match answer.outcome {
            ClosestApproach::Nearest {
                lower,
                time,
                contact,
            } => ClosestApproach::Nearest {
                lower,
                time,
                contact: leg.contact(contact),
            },
            other => other,
        }))
    }
}

impl Journey<'_> {
    /// Returns the journey that asks for distances: the margin plays no role.
    fn measuring(&self) -> Self {
        let mut measuring = self.clone();
        measuring.config.margin = 0.0;
        measuring
    }
}

/// What a stretch shows: bounds of the distance of its motions.
struct Seen {
    lower: f64,
    upper: f64,
    /// By how much strays widen these bounds.
    blur: f64,
    /// The time in the stretch at which they are nearest.
    time: f64,
}

impl Seen {
    /// Returns true if f64 does not certify the tolerance for the motions: then cutting does not help.
    fn is_loose(&self, tolerance: f64) -> bool {
        let width = self.upper - self.lower;
        width > tolerance && self.blur <= width
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

    /// Takes what the motions of a leg show.
    ///
    /// # Errors
    /// The limit that was reached.
    fn see(&mut self, leg: &Leg, outcome: &ClosestApproach) -> Result<Seen, Limit> {
        let mut seen = Seen {
            lower: 0.0,
            upper: 0.0,
            blur: leg.stray,
            time: 0.0,
        };
        match *outcome {
            ClosestApproach::Nearest {
                lower,
                time,
                contact,
            } => {
                self.take(leg.time(time), leg.contact(contact));
                seen.lower = lower;
                seen.upper = contact.separation.upper;
                seen.time = time;
            }
            ClosestApproach::Overlapping { overlap } => {
                if let Overlap::Pieces(contact) = overlap {
                    self.take(leg.span.from, leg.contact(contact));
                }
            }
            ClosestApproach::Unresolved { nearest, reason } => {
                if let Some((time, contact)) = nearest {
                    self.take(leg.time(time), leg.contact(contact));
                }
                return Err(reason);
            }
        }
        Ok(seen)
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
