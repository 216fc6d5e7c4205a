//! The loop that all searches along trajectories share.

use super::motions::StretchMotions;
use super::stretches::WaitingStretches;
use crate::answer::{Answer, Limit};
use crate::distance::oracle::DistanceOracle;
use crate::engine::scratch::Scratch;
use crate::error::InputError;
use crate::motion::span::Span;
use crate::problem::Problem;
use crate::query::Query;
use std::ops::ControlFlow;

/// A question about bodies on trajectories, which is answered by searching one stretch of time after the other.
pub(super) trait Question<O: DistanceOracle> {
    /// Returns the scratch memory that is kept between queries.
    fn scratch(&mut self) -> &mut Scratch;

    /// Returns whether the search handles accelerations within a stretch. Otherwise they count as deviations.
    fn takes_accelerations(&self) -> bool {
        true
    }

    /// Does work that concerns the whole query; called before each stretch is searched.
    fn on_before_each_stretch(
        &mut self,
        _stretches: &mut WaitingStretches<'_, '_>,
        _oracle: &mut O,
    ) -> Result<(), InputError> {
        Ok(())
    }

    /// Measures the bodies at the time where a stretch adjoins a proven stretch, and returns the length that suits the
    /// stretch; `None` if the measurement does not tell.
    fn suitable_length_by_measurement(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        motions: &StretchMotions,
        time: f64,
        oracle: &mut O,
    ) -> Result<Option<f64>, InputError>;

    /// Searches a stretch, and then records what is proven, or cuts the stretch, or returns the answer to the question.
    fn search_stretch(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        motions: &StretchMotions,
        problem: &Problem<'_>,
        oracle: &mut O,
    ) -> Result<ControlFlow<Answer>, InputError>;

    /// Returns the unresolved answer for a limit that is reached before the stretch `span` is searched.
    fn on_limit(
        &mut self,
        stretches: &WaitingStretches<'_, '_>,
        span: Span,
        limit: Limit,
    ) -> Answer;

    /// Returns the answer to the question when all stretches are done.
    fn on_end(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        oracle: &mut O,
    ) -> Result<Answer, InputError>;
}

/// Answers a question about two trajectories by cutting or examining one waiting stretch after the other, until none is
/// left.
pub(super) fn search_stretches<O: DistanceOracle, Q: Question<O>>(
    question: &mut Q,
    query: &Query<'_>,
    oracle: &mut O,
) -> Result<Answer, InputError> {
    let spare = &mut question.scratch().get_or_insert_default().spare_span_lists;
    let mut stretches = WaitingStretches::new(query, spare.pop().unwrap_or_default());
    let answer = search_waiting_stretches(question, &mut stretches, oracle);
    let spare = &mut question.scratch().get_or_insert_default().spare_span_lists;
    spare.push(stretches.recycle_lists());
    answer
}

fn search_waiting_stretches<O: DistanceOracle, Q: Question<O>>(
    question: &mut Q,
    stretches: &mut WaitingStretches<'_, '_>,
    oracle: &mut O,
) -> Result<Answer, InputError> {
    loop {
        question.on_before_each_stretch(stretches, oracle)?;
        let Some(span) = stretches.next() else {
            return question.on_end(stretches, oracle);
        };
        let (motions, terms) =
            match stretches.motions_and_settings(span, question.takes_accelerations())? {
                Ok(motions) => motions,
                Err(limit) => return Ok(question.on_limit(stretches, span, limit)),
            };
        // A stretch that is probably too long is cut without a search.
        if let Some(time) = stretches.cut_time_if_too_long(&motions)
            && let Some(length) =
                question.suitable_length_by_measurement(stretches, &motions, time, oracle)?
            && motions.is_worth_a_cut(length)
            && stretches.cut_out_around(motions.span, time, 2.0 * length)
        {
            continue;
        }
        let problem = motions.problem(stretches.query, &terms)?;
        if let ControlFlow::Break(answer) =
            question.search_stretch(stretches, &motions, &problem, oracle)?
        {
            return Ok(answer);
        }
    }
}
