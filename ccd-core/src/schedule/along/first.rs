//! The first contact along trajectories, stretch by stretch in order of time.

use super::leg::{Leg, Span};
use super::lengths::{cut_at_once, length};
use super::stretches::Stretches;
use crate::answer::{Answer, Contact, Limit, Outcome};
use crate::distance::oracle::DistanceOracle;
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::query::Query;
use crate::schedule::solve::Solve;

/// Returns the time at which the bodies first touch along their trajectories.
pub(in crate::schedule) fn first_contact<O: DistanceOracle, S: Solve<O>>(
    schedule: &mut S,
    query: &Query<'_>,
    oracle: &mut O,
) -> Result<Answer, InputError> {
    let mut stretches = Stretches::new(query);
    let mut kept = SoFar::new(query);
    while let Some(span) = stretches.next() {
        let (leg, terms) = match stretches.leg(span, schedule.takes_accelerations())? {
            Ok(leg) => leg,
            Err(reason) => return Ok(kept.unresolved(&stretches, span.from, reason)),
        };
        if cut_at_once(&mut stretches, &leg, oracle, schedule.scratch())? {
            continue;
        }
        let problem = leg.problem(query, &terms)?;
        let answer = schedule.solve(&problem, oracle);
        stretches.add(&answer.stats);
        // The stretches before a contact may not be examined again.
        kept.keep(&leg, problem.proven_gap());
        let (s, contact) = match answer.outcome {
            Outcome::Free { proven_gap } => {
                kept.keep(&leg, proven_gap);
                stretches.prove(&leg);
                continue;
            }
            Outcome::Unresolved(known) => {
                let until = leg.time(known.safe_until);
                return Ok(kept.unresolved(&stretches, until, known.limit));
            }
            Outcome::Contact { time, contact } => (time, Some(contact)),
            Outcome::Touching { contact } => (0.0, Some(contact)),
            Outcome::Overlapping { overlap, .. } => {
                if stretches.look_at_start(&leg)? {
                    continue;
                }
                (0.0, overlap.contact())
            }
            Outcome::Interval { .. } | Outcome::Measured { .. } => {
                unreachable!("no outcome of a search for the first contact")
            }
        };
        if stretches.is_fine(&leg)? {
            return kept.found(&stretches, &leg, answer.outcome);
        }
        let rest = Span {
            from: leg.time(s),
            ..leg.span
        };
        let seen = (s, contact);
        let length = length(&mut stretches, &leg, seen, oracle, schedule.scratch())?;
        // A much shorter stretch also has much smaller deviations.
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

/// The facts proven for the stretches so far.
pub(super) struct SoFar {
    gap: f64,
    margin: f64,
    tolerance: f64,
}

impl SoFar {
    pub(super) fn new(query: &Query<'_>) -> Self {
        SoFar {
            gap: f64::INFINITY,
            margin: query.terms.margin,
            tolerance: query.terms.tolerance,
        }
    }

    pub(super) fn keep(&mut self, leg: &Leg, proven_gap: f64) {
        self.gap = lesser(self.gap, leg.at_least(proven_gap));
    }

    fn answer(&self, stretches: &Stretches<'_, '_>, outcome: Outcome) -> Answer {
        Answer {
            outcome,
            tolerance: self.tolerance,
            stats: stretches.stats,
        }
    }

    pub(super) fn free(&self, stretches: &Stretches<'_, '_>) -> Answer {
        let proven_gap = greater(self.gap, self.margin);
        self.answer(stretches, Outcome::Free { proven_gap })
    }

    pub(super) fn unresolved(
        &self,
        stretches: &Stretches<'_, '_>,
        safe_until: f64,
        limit: Limit,
    ) -> Answer {
        self.answer(stretches, Outcome::unresolved(safe_until, limit))
    }

    /// Returns the answer for a contact of the motions of a leg.
    pub(super) fn found(
        &mut self,
        stretches: &Stretches<'_, '_>,
        leg: &Leg,
        outcome: Outcome,
    ) -> Result<Answer, InputError> {
        let at = |time: f64, contact: Contact| {
            let contact = leg.contact(contact);
            if time > 0.0 {
                Outcome::Contact { time, contact }
            } else {
                Outcome::Touching { contact }
            }
        };
        let outcome = match outcome {
            Outcome::Contact { time, contact } => at(leg.time(time), contact),
            Outcome::Touching { contact } => at(leg.span.from, contact),
            Outcome::Overlapping { .. } if stretches.begins_at_start(leg)? => outcome,
            // Bodies that were apart until then overlap by no more than their deviations.
            Outcome::Overlapping { overlap, .. } => match overlap.contact() {
                Some(contact) => at(leg.span.from, contact),
                None => Outcome::unresolved(leg.span.from, Limit::Undecided),
            },
            _ => outcome,
        };
        if let Outcome::Contact { contact, .. } | Outcome::Touching { contact } = &outcome {
            let shown = (contact.separation.upper - self.margin).next_up();
            self.tolerance = greater(self.tolerance, shown);
        }
        Ok(self.answer(stretches, outcome))
    }
}
