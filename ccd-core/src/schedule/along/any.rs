//! The search for any contact along trajectories.

use super::first::SoFar;
use super::lengths::{cut_at_once, length};
use super::stretches::Stretches;
use crate::answer::{Answer, Limit, Outcome};
use crate::distance::oracle::DistanceOracle;
use crate::error::InputError;
use crate::math::order::lesser;
use crate::query::Query;
use crate::schedule::DepthFirst;
use crate::schedule::any_contact::any;

impl<O: DistanceOracle> DepthFirst<O> {
    /// Answers whether the bodies touch at all along their trajectories.
    pub(in crate::schedule) fn any_contact_along(
        &mut self,
        query: &Query<'_>,
        oracle: &mut O,
    ) -> Result<Answer, InputError> {
        let mut stretches = Stretches::new(query);
        let mut kept = SoFar::new(query);
        // The first time at which one body is inside the other.
        let mut undecided = f64::INFINITY;
        while let Some(span) = stretches.next() {
            let unresolved = |kept: &SoFar, stretches: &Stretches<'_, '_>, until, reason| {
                let until = lesser(lesser(until, undecided), stretches.first());
                kept.unresolved(stretches, until, reason)
            };
            let (leg, terms) = match stretches.leg(span, true)? {
                Ok(leg) => leg,
                Err(reason) => return Ok(unresolved(&kept, &stretches, span.from, reason)),
            };
            if cut_at_once(&mut stretches, &leg, oracle, &mut self.scratch)? {
                continue;
            }
            let answer = self.any_contact_of(&leg.problem(query, &terms)?, oracle);
            stretches.add(&answer.stats);
            let (s, contact) = match answer.outcome {
                Outcome::Free { proven_gap } => {
                    kept.keep(&leg, proven_gap);
                    stretches.prove(&leg);
                    continue;
                }
                Outcome::Unresolved(known) => {
                    let until = leg.time(known.safe_until);
                    return Ok(unresolved(&kept, &stretches, until, known.limit));
                }
                Outcome::Contact { time, contact } => (time, Some(contact)),
                Outcome::Overlapping { overlap, .. } => {
                    if stretches.look_at_start(&leg)? {
                        continue;
                    }
                    (0.0, overlap.contact())
                }
                Outcome::Touching { .. } | Outcome::Interval { .. } | Outcome::Measured { .. } => {
                    unreachable!("no outcome of a search for any contact")
                }
            };
            if stretches.is_fine(&leg)? {
                let found = kept.found(&stretches, &leg, answer.outcome)?;
                // One body is inside the other: they have met before, or overlap at the start.
                if let Outcome::Unresolved(known) = found.outcome {
                    undecided = lesser(undecided, known.safe_until);
                    continue;
                }
                return Ok(any(found));
            }
            let seen = (s, contact);
            let length = 2.0 * length(&mut stretches, &leg, seen, oracle, &mut self.scratch)?;
            if !stretches.cut_about(leg.span, leg.time(s), length) {
                return Ok(unresolved(&kept, &stretches, leg.span.from, Limit::Stalled));
            }
        }
        Ok(if undecided.is_finite() {
            kept.unresolved(&stretches, undecided, Limit::Undecided)
        } else {
            kept.free(&stretches)
        })
    }
}
