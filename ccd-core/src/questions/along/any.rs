//! Decides whether two bodies on trajectories touch at all.

use super::contacts::{ProvenGap, StretchResult};
use super::drive::{Question, search_stretches};
use super::lengths::{choose_next_length, cut_if_too_long};
use super::motions::{Span, StretchMotions};
use super::stretches::WaitingStretches;
use crate::answer::{Answer, Limit, Outcome};
use crate::distance::oracle::DistanceOracle;
use crate::error::InputError;
use crate::math::order::lesser;
use crate::problem::Problem;
use crate::query::Query;
use crate::questions::any::touching_as_contact;
use crate::questions::depth_first::DepthFirst;
use std::ops::ControlFlow;

impl<O: DistanceOracle> DepthFirst<O> {
    /// Decides whether the bodies touch at all along their trajectories.
    pub(crate) fn any_contact_along(
        &mut self,
        query: &Query<'_>,
        oracle: &mut O,
    ) -> Result<Answer, InputError> {
        let mut any = AnyContactSearch {
            schedule: self,
            proven_gap: ProvenGap::new(query),
        };
        search_stretches(&mut any, query, oracle)
    }
}

struct AnyContactSearch<'s, O: DistanceOracle> {
    schedule: &'s mut DepthFirst<O>,
    proven_gap: ProvenGap,
}

impl<O: DistanceOracle> Question<O> for AnyContactSearch<'_, O> {
    fn cut_if_too_long(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        motions: &StretchMotions,
        oracle: &mut O,
    ) -> Result<bool, InputError> {
        cut_if_too_long(stretches, motions, oracle, &mut self.schedule.scratch)
    }

    fn search_stretch(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        motions: &StretchMotions,
        problem: &Problem<'_>,
        oracle: &mut O,
    ) -> Result<ControlFlow<Answer>, InputError> {
        let answer = self.schedule.any_contact_of(problem, oracle);
        let seen = match self.proven_gap.record(stretches, motions, &answer)? {
            StretchResult::Done(flow) => return Ok(flow),
            StretchResult::InContact(s, contact) => (s, contact),
        };
        if stretches.accepts_contact(motions)? {
            let found = self
                .proven_gap
                .contact_answer(stretches, motions, answer.outcome)?;
            // One body is inside the other: they have met before, or overlap at the start.
            if let Outcome::Unresolved(known) = found.outcome {
                self.proven_gap.undecided_time =
                    lesser(self.proven_gap.undecided_time, known.safe_until);
                return Ok(ControlFlow::Continue(()));
            }
            return Ok(ControlFlow::Break(touching_as_contact(found)));
        }
        let scratch = &mut self.schedule.scratch;
        let length = 2.0 * choose_next_length(stretches, motions, seen, oracle, scratch)?;
        if stretches.cut_out_around(motions.span, motions.query_time(seen.0), length) {
            return Ok(ControlFlow::Continue(()));
        }
        let stalled = self
            .proven_gap
            .unresolved(stretches, motions.span.from, Limit::Stalled);
        Ok(ControlFlow::Break(stalled))
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
