//! The first contact and any contact along trajectories.

use super::Journey;
use super::leg::{Leg, Span};
use super::stretches::Stretches;
use crate::config::Config;
use crate::distance::oracle::DistanceOracle;
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::outcome::{Answer, Contact, Limit, Outcome, Overlap};
use crate::schedule::any_contact::AnyContact;
use crate::schedule::memory::Kept;
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
            if let Some(time) = stretches.looks_too_long(&leg)
                && let Some(seen) = stretches.measure(time, oracle, &mut self.kept)?
                && stretches.cut(leg.span, worthwhile(journey, &leg, seen))
            {
                continue;
            }
            let answer = self.solve(&leg.problem(journey, &config)?, oracle);
            stretches.add(&answer.stats);
            let (s, contact) = match answer.outcome {
                Outcome::Free { proven_gap } => {
                    kept.keep(&leg, proven_gap);
                    stretches.prove(&leg);
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
            let seen = (s, contact);
            let length = length(&mut stretches, &leg, seen, oracle, &mut self.kept)?;
            // Much shorter than before, its strays are as well.
            let is_short = rest.length() <= lesser(length, 0.5 * leg.span.length());
            if !is_short && stretches.cut(rest, length) {
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
            if let Some(time) = stretches.looks_too_long(&leg)
                && let Some((contact, approach)) =
                    stretches.measure(time, oracle, &mut self.kept)?
            {
                // Backwards in time, rates have the other sign.
                let rate = if time > leg.span.from {
                    -approach
                } else {
                    approach
                };
                let length = 2.0 * worthwhile(journey, &leg, (contact, rate));
                if stretches.cut_about(leg.span, time, length) {
                    continue;
                }
            }
            let answer = self.any_contact(&leg.problem(journey, &config)?, oracle);
            stretches.add(&answer.stats);
            let (s, contact, outcome) = match answer.outcome {
                AnyContact::Free { proven_gap } => {
                    kept.keep(&leg, proven_gap);
                    stretches.prove(&leg);
                    continue;
                }
                AnyContact::Unresolved { safe_until, reason } => {
                    return Ok(unresolved(&kept, &stretches, leg.time(safe_until), reason));
                }
                AnyContact::Contact { time, contact } => {
                    (time, Some(contact), Outcome::Contact { time, contact })
                }
                AnyContact::Overlapping { overlap } => {
                    if stretches.look_at_start(&leg)? {
                        continue;
                    }
                    let contact = contact_of(&overlap);
                    (0.0, contact, Outcome::Overlapping { overlap })
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
            let seen = (s, contact);
            let length = 2.0 * length(&mut stretches, &leg, seen, oracle, &mut self.kept)?;
            if !stretches.cut_about(leg.span, leg.time(s), length) {
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

/// Returns the length of a stretch worth a look after a contact of the motions at a time of a leg.
fn length<O: DistanceOracle>(
    stretches: &mut Stretches<'_, '_>,
    leg: &Leg,
    (time, seen): (f64, Option<Contact>),
    oracle: &mut O,
    kept: &mut Kept,
) -> Result<f64, InputError> {
    let seen = match time > 0.0 {
        true => seen.map(|contact| (contact, leg.approach(time, &contact))),
        // The motions begin beside the bodies: how near these are is not seen.
        false => stretches.measure(leg.span.from, oracle, kept)?,
    };
    let journey = stretches.journey();
    Ok(match seen {
        Some(seen) => worthwhile(journey, leg, seen),
        None => leg.length_for(STRAY_SHARE * journey.config.tolerance),
    })
}

/// Returns the length of a stretch worth a look where the bodies are as near as a contact shows, and approach each
/// other at a rate: they stray by a part of their distance, and get where they meet, or where they are nearest.
///
/// Bodies at a distance `d` that approach each other at a rate `r` meet after `d/r`. If they approach ever slower,
/// and pass each other closely, they are nearest after about `2 d/r`.
fn worthwhile(journey: &Journey<'_>, leg: &Leg, (contact, approach): (Contact, f64)) -> f64 {
    let Config {
        margin, tolerance, ..
    } = journey.config;
    let gap = greater(contact.separation.upper - margin, tolerance);
    let nearest = 2.0 * gap / approach;
    // Written so that NaN is no time.
    match nearest > 0.0 {
        true => lesser(leg.length_for(STRAY_SHARE * gap), nearest),
        false => leg.length_for((1.0 - STRAY_SHARE) * gap),
    }
}
