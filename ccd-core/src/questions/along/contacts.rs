//! Searches for the first or any contact along trajectories, one stretch of time after the other.

use super::drive::{Question, search_stretches};
use super::lengths::{choose_next_stretch_length, suitable_length_by_measurement};
use super::motions::StretchMotions;
use super::stretches::WaitingStretches;
use crate::answer::{Answer, Contact, Limit, Outcome};
use crate::distance::oracle::DistanceOracle;
use crate::engine::answer::EngineSchedule;
use crate::engine::scratch::Scratch;
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::motion::span::Span;
use crate::problem::Problem;
use crate::query::Query;
use crate::questions::any::touching_as_contact;
use std::ops::ControlFlow;

/// Finds the time at which the bodies first touch along their trajectories.
pub(crate) fn first_contact<O: DistanceOracle, S: EngineSchedule<O>>(
    schedule: &mut S,
    query: &Query<'_>,
    oracle: &mut O,
) -> Result<Answer, InputError> {
    search_contact(schedule, WantedContact::First, query, oracle)
}

/// Searches for a contact of bodies on trajectories with a schedule that finds the wanted contact of motions.
pub(super) fn search_contact<O: DistanceOracle, S: EngineSchedule<O>>(
    schedule: &mut S,
    wanted: WantedContact,
    query: &Query<'_>,
    oracle: &mut O,
) -> Result<Answer, InputError> {
    let mut search = ContactSearch {
        schedule,
        wanted_contact: wanted,
        gap: f64::INFINITY,
        margin: query.settings.margin,
        tolerance: query.settings.tolerance,
        undecided_containment_time: f64::INFINITY,
    };
    search_stretches(&mut search, query, oracle)
}

/// The contact that a query asks for: the first one, or whichever is found first.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum WantedContact {
    First,
    Any,
}

/// A search for a contact, with the gap and the tolerance that are proven for the stretches searched so far.
struct ContactSearch<'s, S> {
    schedule: &'s mut S,
    wanted_contact: WantedContact,
    gap: f64,
    margin: f64,
    tolerance: f64,
    /// The first time at which it is undecided whether one body is inside the other.
    undecided_containment_time: f64,
}

impl<O: DistanceOracle, S: EngineSchedule<O>> Question<O> for ContactSearch<'_, S> {
    fn scratch(&mut self) -> &mut Scratch {
        self.schedule.scratch()
    }

    fn takes_accelerations(&self) -> bool {
        self.schedule.handles_accelerations()
    }

    fn suitable_length_by_measurement(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        motions: &StretchMotions,
        time: f64,
        oracle: &mut O,
    ) -> Result<Option<f64>, InputError> {
        suitable_length_by_measurement(stretches, motions, time, oracle, self.schedule.scratch())
    }

    fn search_stretch(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        motions: &StretchMotions,
        problem: &Problem<'_>,
        oracle: &mut O,
    ) -> Result<ControlFlow<Answer>, InputError> {
        if self.wanted_contact == WantedContact::First {
            // The stretches before a contact may not be examined again.
            self.record_distance_lower_bound(motions, problem.proven_gap());
        }
        let answer = self.schedule.answer_first_contact(problem, oracle);
        let seen = match self.record(stretches, motions, &answer)? {
            StretchResult::Done(flow) => return Ok(flow),
            StretchResult::InContact(s, contact) => (s, contact),
        };
        if stretches.accepts_contact(motions)? {
            let found = self.contact_answer(stretches, motions, answer.outcome)?;
            return Ok(match (self.wanted_contact, found.outcome) {
                (WantedContact::First, _) => ControlFlow::Break(found),
                // One body is inside the other: they have met before, or overlap at the start.
                (WantedContact::Any, Outcome::Unresolved(known)) => {
                    self.undecided_containment_time =
                        lesser(self.undecided_containment_time, known.safe_until);
                    ControlFlow::Continue(())
                }
                (WantedContact::Any, _) => ControlFlow::Break(touching_as_contact(found)),
            });
        }
        let (span, time) = (motions.span, motions.query_time(seen.0));
        let scratch = self.schedule.scratch();
        let length = choose_next_stretch_length(stretches, motions, seen, oracle, scratch)?;
        let is_cut = match self.wanted_contact {
            WantedContact::First => queue_rest_after(stretches, span, time, length),
            WantedContact::Any => stretches.cut_out_around(span, time, 2.0 * length),
        };
        Ok(if is_cut {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(self.unresolved(stretches, span.from, Limit::Stalled))
        })
    }

    fn on_limit(
        &mut self,
        stretches: &WaitingStretches<'_, '_>,
        span: Span,
        limit: Limit,
    ) -> Answer {
        self.unresolved(stretches, span.from, limit)
    }

    /// Returns the answer when all stretches are done: free, or undecided if one body may be inside the other.
    fn on_end(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        _: &mut O,
    ) -> Result<Answer, InputError> {
        if self.undecided_containment_time.is_finite() {
            return Ok(self.unresolved(
                stretches,
                self.undecided_containment_time,
                Limit::OverlapUndecided,
            ));
        }
        let proven_gap = greater(self.gap, self.margin);
        Ok(self.answer(stretches, Outcome::Free { proven_gap }))
    }
}

/// Lets the part of a stretch after a time wait, in two if it is long. Returns false if that is the whole stretch and
/// it cannot be cut.
fn queue_rest_after(
    stretches: &mut WaitingStretches<'_, '_>,
    span: Span,
    time: f64,
    length: f64,
) -> bool {
    let rest = Span { from: time, ..span };
    // A much shorter stretch also has much smaller deviations.
    let is_short = rest.length() <= lesser(length, 0.5 * span.length());
    if !is_short && stretches.cut(rest, length) {
        return true;
    }
    let is_part = rest.from > span.from;
    if is_part {
        stretches.push(rest);
    }
    is_part
}

/// The result of the search for a contact in one stretch.
#[allow(clippy::large_enum_variant, reason = "it is returned, not kept")]
enum StretchResult {
    /// The search of the stretch is over: either the next stretch follows, or a limit was reached and the query ends
    /// with this answer. The next stretch follows if the bodies are apart in this one, or if this one has to wait until
    /// the pose at the start is examined.
    Done(ControlFlow<Answer>),
    /// The motions are in contact at this time from the start of the stretch; the contact is `None` if one body is
    /// inside the other.
    InContact(f64, Option<Contact>),
}

impl<S> ContactSearch<'_, S> {
    /// Records a lower bound of the bodies' distance in a stretch: the gap that its motions are proven to keep, minus
    /// the deviations of the trajectories from these motions.
    fn record_distance_lower_bound(&mut self, motions: &StretchMotions, proven_gap: f64) {
        self.gap = lesser(self.gap, motions.lower_bound_for_bodies(proven_gap));
    }

    /// Records what a search of a stretch's motions proved, and returns whether the motions are in contact.
    fn record(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        motions: &StretchMotions,
        answer: &Answer,
    ) -> Result<StretchResult, InputError> {
        stretches.add(&answer.stats);
        Ok(match answer.outcome {
            Outcome::Free { proven_gap } => {
                self.record_distance_lower_bound(motions, proven_gap);
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

    /// Returns the unresolved answer for a search that reached a limit. The bodies are apart until `safe_until`, except
    /// in the stretches that wait and those that are undecided.
    fn unresolved(
        &self,
        stretches: &WaitingStretches<'_, '_>,
        safe_until: f64,
        limit: Limit,
    ) -> Answer {
        let until = lesser(
            lesser(safe_until, self.undecided_containment_time),
            stretches.earliest_time(),
        );
        self.answer(stretches, Outcome::unresolved(until, limit))
    }

    /// Converts a contact of a stretch's motions to the answer of the query.
    fn contact_answer(
        &mut self,
        stretches: &WaitingStretches<'_, '_>,
        motions: &StretchMotions,
        outcome: Outcome,
    ) -> Result<Answer, InputError> {
        let at = |time: f64, contact| {
            Outcome::from_contact(time, motions.widen_separation_bounds(contact))
        };
        let outcome = match outcome {
            Outcome::Contact { time, contact } => at(motions.query_time(time), contact),
            Outcome::Touching { contact } => at(motions.span.from, contact),
            Outcome::Overlapping { .. } if stretches.starts_at_initial_poses(motions)? => outcome,
            // Bodies that were apart until then overlap by no more than their deviations.
            Outcome::Overlapping { overlap, .. } => match overlap.contact() {
                Some(contact) => at(motions.span.from, contact),
                None => Outcome::unresolved(motions.span.from, Limit::OverlapUndecided),
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
