//! Any contact along trajectories.

use super::Journey;
use super::first::{SoFar, contact_of};
use super::lengths::{cut_at_once, length};
use super::stretches::Stretches;
use crate::distance::oracle::DistanceOracle;
use crate::error::InputError;
use crate::math::order::lesser;
use crate::outcome::{Answer, Limit, Outcome};
use crate::schedule::DepthFirst;
use crate::schedule::any_contact::AnyContact;

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
            let (leg, config) = match stretches.leg(span)? {
                Ok(leg) => leg,
                Err(reason) => return Ok(unresolved(&kept, &stretches, span.from, reason)),
            };
            if cut_at_once(&mut stretches, &leg, oracle, &mut self.kept)? {
                continue;
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
        Ok(if undecided.is_finite() {
            kept.unresolved(&stretches, undecided, Limit::Undecided)
        } else {
            kept.free(&stretches)
        }
        .map(AnyContact::from))
    }
}
