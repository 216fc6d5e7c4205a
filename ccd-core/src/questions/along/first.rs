//! Computes the first contact along trajectories, by stretches in order of time.

use super::contacts::{ProvenGap, StretchResult};
use super::drive::{Question, search_stretches};
use super::lengths::{choose_next_length, cut_if_too_long};
use super::motions::{Span, StretchMotions};
use super::stretches::WaitingStretches;
use crate::answer::{Answer, Limit};
use crate::distance::oracle::DistanceOracle;
use crate::engine::answer::EngineSchedule;
use crate::error::InputError;
use crate::math::order::lesser;
use crate::problem::Problem;
use crate::query::Query;
use std::ops::ControlFlow;

/// Finds the time at which the bodies first touch along their trajectories.
pub(crate) fn first_contact<O: DistanceOracle, S: EngineSchedule<O>>(
    schedule: &mut S,
    query: &Query<'_>,
    oracle: &mut O,
) -> Result<Answer, InputError> {
    let mut first = FirstContactSearch {
        schedule,
        proven_gap: ProvenGap::new(query),
    };
    search_stretches(&mut first, query, oracle)
}

struct FirstContactSearch<'s, S> {
    schedule: &'s mut S,
    proven_gap: ProvenGap,
}

impl<O: DistanceOracle, S: EngineSchedule<O>> Question<O> for FirstContactSearch<'_, S> {
    fn takes_accelerations(&self) -> bool {
        self.schedule.handles_accelerations()
    }

    fn cut_if_too_long(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        motions: &StretchMotions,
        oracle: &mut O,
    ) -> Result<bool, InputError> {
        cut_if_too_long(stretches, motions, oracle, self.schedule.scratch())
    }

    fn search_stretch(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        motions: &StretchMotions,
        problem: &Problem<'_>,
        oracle: &mut O,
    ) -> Result<ControlFlow<Answer>, InputError> {
        let proven = &mut self.proven_gap;
        // The stretches before a contact may not be examined again.
        proven.record_gap(motions, problem.proven_gap());
        let answer = self.schedule.answer_first_contact(problem, oracle);
        let (s, contact) = match proven.record(stretches, motions, &answer)? {
            StretchResult::Done(flow) => return Ok(flow),
            StretchResult::InContact(s, contact) => (s, contact),
        };
        if stretches.accepts_contact(motions)? {
            let found = proven.contact_answer(stretches, motions, answer.outcome)?;
            return Ok(ControlFlow::Break(found));
        }
        let rest = Span {
            from: motions.query_time(s),
            ..motions.span
        };
        let scratch = self.schedule.scratch();
        let length = choose_next_length(stretches, motions, (s, contact), oracle, scratch)?;
        // A much shorter stretch also has much smaller deviations.
        let is_short = rest.length() <= lesser(length, 0.5 * motions.span.length());
        if is_short || !stretches.cut(rest, length) {
            if !(rest.from > motions.span.from) {
                let stalled = proven.unresolved(stretches, rest.from, Limit::Stalled);
                return Ok(ControlFlow::Break(stalled));
            }
            stretches.push(rest);
        }
        Ok(ControlFlow::Continue(()))
    }

    fn on_limit(
        &mut self,
        stretches: &WaitingStretches<'_, '_>,
        span: Span,
        limit: Limit,
    ) -> Answer {
        self.proven_gap.unresolved(stretches, span.from, limit)
    }

    fn on_end(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        _: &mut O,
    ) -> Result<Answer, InputError> {
        Ok(self.proven_gap.finish(stretches))
    }
}
