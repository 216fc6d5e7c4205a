//! The results so far of a search for contacts along trajectories.

use super::motions::StretchMotions;
use super::stretches::WaitingStretches;
use crate::answer::{Answer, Contact, Limit, Outcome};
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::query::Query;
use std::ops::ControlFlow;

/// The gap and the tolerance that are proven for the stretches searched so far.
pub(super) struct ProvenGap {
    gap: f64,
    margin: f64,
    tolerance: f64,
    /// The first time at which it is undecided whether one body is inside the other.
    pub(super) undecided_time: f64,
}

/// The result of the search for a contact in one stretch.
#[allow(clippy::large_enum_variant, reason = "it is returned, not kept")]
pub(super) enum StretchResult {
    /// The search of the stretch is over: either the next stretch follows, or a limit was reached and the query ends
    /// with this answer. The next stretch follows if the bodies are apart in this one, or if this one has to wait until
    /// the pose at the start is examined.
    Done(ControlFlow<Answer>),
    /// The motions are in contact at this time from the start of the stretch; the contact is `None` if one body is
    /// inside the other.
    InContact(f64, Option<Contact>),
}

impl ProvenGap {
    pub(super) fn new(query: &Query<'_>) -> Self {
        ProvenGap {
            gap: f64::INFINITY,
            margin: query.settings.margin,
            tolerance: query.settings.tolerance,
            undecided_time: f64::INFINITY,
        }
    }

    /// Records the gap that the motions of a stretch are proven to keep, minus the deviations.
    pub(super) fn record_gap(&mut self, motions: &StretchMotions, proven_gap: f64) {
        self.gap = lesser(self.gap, motions.lower_bound_for_bodies(proven_gap));
    }

    /// Records what a search of a stretch's motions proved, and returns whether the motions are in contact.
    pub(super) fn record(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        motions: &StretchMotions,
        answer: &Answer,
    ) -> Result<StretchResult, InputError> {
        stretches.add(&answer.stats);
        Ok(match answer.outcome {
            Outcome::Free { proven_gap } => {
                self.record_gap(motions, proven_gap);
                stretches.record_proven_stretch(motions);
                StretchResult::Done(ControlFlow::Continue(()))
            }
            Outcome::Unresolved(known) => {
                let until = motions.query_time(known.safe_until);
                let answer = self.unresolved(stretches, until, known.limit);
                StretchResult::Done(ControlFlow::Break(answer))
            }
            Outcome::Contact { time, contact } => StretchResult::InContact(time, Some(contact)),
            Outcome::Touching { contact } => StretchResult::InContact(0.0, Some(contact)),
            Outcome::Overlapping { .. } if stretches.schedule_start_examination(motions)? => {
                StretchResult::Done(ControlFlow::Continue(()))
            }
            Outcome::Overlapping { overlap, .. } => {
                StretchResult::InContact(0.0, overlap.contact())
            }
            Outcome::Interval { .. } | Outcome::LeastDistance { .. } => {
                unreachable!("no outcome of a search for contacts")
            }
        })
    }

    fn answer(&self, stretches: &WaitingStretches<'_, '_>, outcome: Outcome) -> Answer {
        Answer {
            outcome,
            tolerance: self.tolerance,
            stats: stretches.stats,
        }
    }

    /// Returns the answer when all stretches are done: free, or undecided if one body may be inside the other.
    pub(super) fn finish(&self, stretches: &WaitingStretches<'_, '_>) -> Answer {
        if self.undecided_time.is_finite() {
            return self.unresolved(stretches, self.undecided_time, Limit::Undecided);
        }
        let proven_gap = greater(self.gap, self.margin);
        self.answer(stretches, Outcome::Free { proven_gap })
    }

    /// Returns the unresolved answer for a search that reached a limit. The bodies are apart until `safe_until`, except
    /// in the stretches that wait and those that are undecided.
    pub(super) fn unresolved(
        &self,
        stretches: &WaitingStretches<'_, '_>,
        safe_until: f64,
        limit: Limit,
    ) -> Answer {
        let until = lesser(
            lesser(safe_until, self.undecided_time),
            stretches.earliest_time(),
        );
        self.answer(stretches, Outcome::unresolved(until, limit))
    }

    /// Converts a contact of a stretch's motions to the answer of the query.
    pub(super) fn contact_answer(
        &mut self,
        stretches: &WaitingStretches<'_, '_>,
        motions: &StretchMotions,
        outcome: Outcome,
    ) -> Result<Answer, InputError> {
        let at = |time: f64, contact| Outcome::contact_at(time, motions.contact(contact));
        let outcome = match outcome {
            Outcome::Contact { time, contact } => at(motions.query_time(time), contact),
            Outcome::Touching { contact } => at(motions.span.from, contact),
            Outcome::Overlapping { .. } if stretches.starts_at_initial_poses(motions)? => outcome,
            // Bodies that were apart until then overlap by no more than their deviations.
            Outcome::Overlapping { overlap, .. } => match overlap.contact() {
                Some(contact) => at(motions.span.from, contact),
                None => Outcome::unresolved(motions.span.from, Limit::Undecided),
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
