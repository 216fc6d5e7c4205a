//! The first contact and any contact along trajectories.

use super::Journey;
use super::leg::{Leg, Span};
use super::stretches::Stretches;
use crate::distance::oracle::DistanceOracle;
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::outcome::{Answer, Contact, Limit, Outcome, Overlap};
use crate::schedule::any_contact::AnyContact;
use crate::schedule::{BestFirst, DepthFirst, Schedule};
use crate::tolerance::STRAY_SHARE;

impl<O: DistanceOracle> BestFirst<O> {
    /// Answers when the bodies first touch along their trajectories.
    ///
    /// # Guarantee
    /// [Never late](crate#guarantee), for the trajectories themselves; ends on every input.
    ///
    /// # Errors
    /// An [`InputError`] if a trajectory has no motion at some time, or one out of range.
    pub fn first_contact_along(
        &mut self,
        journey: &Journey<'_>,
        oracle: &mut O,
    ) -> Result<Answer, InputError> {
        let mut stretches = Stretches::new(journey);
        let mut kept = SoFar::new(journey);
        while let Some(span) = stretches.next() {
            let config = match stretches.config() {
                Ok(config) => config,
                Err(reason) => return Ok(kept.unresolved(&stretches, span.from, reason)),
            };
            let leg = stretches.leg(span)?;
            let answer = self.solve(&leg.problem(journey, &config)?, oracle);
            stretches.add(&answer.stats);
            let (s, contact) = match answer.outcome {
                Outcome::Free { proven_gap } => {
                    kept.keep(&leg, proven_gap);
                    continue;
                }
                Outcome::Unresolved { safe_until, reason } => {
                    return Ok(kept.unresolved(&stretches, leg.time(safe_until), reason));
                }
                Outcome::Contact { time, contact } => (time, Some(contact)),
                Outcome::Touching { contact } => (0.0, Some(contact)),
                Outcome::Overlapping { overlap } => {
                    if stretches.look_at_start(&leg)? {
                        continue;
                    }
                    (0.0, contact_of(&overlap))
                }
            };
            if stretches.is_fine(&leg)? {
                return kept.found(&stretches, &leg, answer.outcome);
            }
            let rest = Span {
                from: leg.time(s),
                to: leg.span.to,
            };
            if stretches.cut(rest, share(journey, &leg, contact)) {
                continue;
            }
            if rest.from > leg.span.from {
                stretches.push(rest);
            } else {
                return Ok(kept.unresolved(&stretches, rest.from, Limit::Stalled));
            }
        }
        Ok(kept.free(&stretches))
    }
}

impl<O: DistanceOracle> DepthFirst<O> {
    /// Answers whether the bodies touch at all along their trajectories.
    ///
    /// # Guarantee
    /// That of [`AnyContact`], for the trajectories themselves; ends on every input.
    ///
    /// # Errors
    /// An [`InputError`] if a trajectory has no motion at some time, or one out of range.
    pub fn any_contact_along(
        &mut self,
        journey: &Journey<'_>,
        oracle: &mut O,
    ) -> Result<Answer<AnyContact>, InputError> {
        let mut stretches = Stretches::new(journey);
        let mut kept = SoFar::new(journey);
        // The first time at which one body is inside the other.
        let mut undecided = f64::INFINITY;
        while let Some(span) = stretches.next() {
            let unresolved = |kept: &SoFar, stretches: &Stretches<'_, '_>, until, reason| {
                let until = lesser(lesser(until, undecided), stretches.first());
                kept.unresolved(stretches, until, reason)
                    .map(AnyContact::from)
            };
            let config = match stretches.config() {
                Ok(config) => config,
                Err(reason) => return Ok(unresolved(&kept, &stretches, span.from, reason)),
            };
            let leg = stretches.leg(span)?;
            let answer = self.any_contact(&leg.problem(journey, &config)?, oracle);
            stretches.add(&answer.stats);
            let (s, outcome) = match answer.outcome {
                AnyContact::Free { proven_gap } => {
                    kept.keep(&leg, proven_gap);
                    continue;
                }
                AnyContact::Unresolved { safe_until, reason } => {
                    return Ok(unresolved(&kept, &stretches, leg.time(safe_until), reason));
                }
                AnyContact::Contact { time, contact } => (time, Outcome::Contact { time, contact }),
                AnyContact::Overlapping { overlap } => {
                    if stretches.look_at_start(&leg)? {
                        continue;
                    }
                    (0.0, Outcome::Overlapping { overlap })
                }
            };
            if stretches.is_fine(&leg)? {
                let found = kept.found(&stretches, &leg, outcome)?;
                // One is inside the other: they have met before, or overlap at the start.
                if let Outcome::Unresolved { safe_until, .. } = found.outcome {
                    undecided = lesser(undecided, safe_until);
                    continue;
                }
                return Ok(found.map(AnyContact::from));
            }
            if !stretches.cut_about(leg.span, leg.time(s)) {
                return Ok(unresolved(&kept, &stretches, leg.span.from, Limit::Stalled));
            }
        }
        Ok(match undecided.is_finite() {
            true => kept.unresolved(&stretches, undecided, Limit::Undecided),
            false => kept.free(&stretches),
        }
        .map(AnyContact::from))
    }
}

/// What is proven of the stretches so far.
struct SoFar {
    gap: f64,
    margin: f64,
    tolerance: f64,
}

impl SoFar {
    fn new(journey: &Journey<'_>) -> Self {
        SoFar {
            gap: f64::INFINITY,
            margin: journey.config.margin,
            tolerance: journey.config.tolerance,
        }
    }

    fn keep(&mut self, leg: &Leg, proven_gap: f64) {
        self.gap = lesser(self.gap, leg.at_least(proven_gap));
    }

    fn answer(&self, stretches: &Stretches<'_, '_>, outcome: Outcome) -> Answer {
        Answer {
            outcome,
            tolerance: self.tolerance,
            stats: stretches.stats,
        }
    }

    fn free(&self, stretches: &Stretches<'_, '_>) -> Answer {
        let proven_gap = greater(self.gap, self.margin);
        self.answer(stretches, Outcome::Free { proven_gap })
    }

    fn unresolved(&self, stretches: &Stretches<'_, '_>, safe_until: f64, reason: Limit) -> Answer {
        self.answer(stretches, Outcome::Unresolved { safe_until, reason })
    }

    /// Returns the answer for a contact of the motions of a leg.
    fn found(
        &mut self,
        stretches: &Stretches<'_, '_>,
        leg: &Leg,
        outcome: Outcome,
    ) -> Result<Answer, InputError> {
        let at = |time: f64, contact: Contact| {
            let contact = leg.contact(contact);
            match time > 0.0 {
                true => Outcome::Contact { time, contact },
                false => Outcome::Touching { contact },
            }
        };
        let outcome = match outcome {
            Outcome::Contact { time, contact } => at(leg.time(time), contact),
            Outcome::Touching { contact } => at(leg.span.from, contact),
            Outcome::Overlapping { overlap } if stretches.begins_at_start(leg)? => {
                Outcome::Overlapping { overlap }
            }
            // Bodies that were apart until then overlap by no more than they stray.
            Outcome::Overlapping { overlap } => match contact_of(&overlap) {
                Some(contact) => at(leg.span.from, contact),
                None => Outcome::Unresolved {
                    safe_until: leg.span.from,
                    reason: Limit::Undecided,
                },
            },
            Outcome::Free { .. } | Outcome::Unresolved { .. } => outcome,
        };
        if let Outcome::Contact { contact, .. } | Outcome::Touching { contact } = &outcome {
            let shown = (contact.separation.upper - self.margin).next_up();
            self.tolerance = greater(self.tolerance, shown);
        }
        Ok(self.answer(stretches, outcome))
    }
}

pub(super) fn contact_of(overlap: &Overlap) -> Option<Contact> {
    match overlap {
        Overlap::Pieces(contact) => Some(*contact),
        Overlap::AInsideB(_) | Overlap::BInsideA(_) => None,
    }
}

/// Returns the share of a stretch in which the bodies stray by about a quarter of the distance that they have
/// at a contact of the motions: strays shrink with the square of the time.
fn share(journey: &Journey<'_>, leg: &Leg, contact: Option<Contact>) -> f64 {
    let upper = contact.map_or(0.0, |contact| contact.separation.upper);
    let gap = greater(upper - journey.config.margin, journey.config.tolerance);
    (STRAY_SHARE * gap / leg.stray).sqrt()
}
