//! The driver of all searches stretch by stretch.

use super::motions::{Motions, Span};
use super::stretches::Stretches;
use crate::answer::{Answer, Limit};
use crate::distance::oracle::DistanceOracle;
use crate::error::InputError;
use crate::problem::Problem;
use crate::query::Query;
use std::ops::ControlFlow;

/// A question along trajectories, which draws the conclusions from each stretch.
pub(super) trait Question<O: DistanceOracle> {
    /// Returns true if the search of a stretch takes accelerations into account. Otherwise they count as deviations.
    fn takes_accelerations(&self) -> bool {
        true
    }

    /// Does the work on the whole query that is due before the next stretch.
    fn prepare(
        &mut self,
        _stretches: &mut Stretches<'_, '_>,
        _oracle: &mut O,
    ) -> Result<(), InputError> {
        Ok(())
    }

    /// Cuts a stretch that is probably too long for a search. Returns false if the stretch is worth a search.
    fn cut_at_once(
        &mut self,
        stretches: &mut Stretches<'_, '_>,
        motions: &Motions,
        oracle: &mut O,
    ) -> Result<bool, InputError>;

    /// Searches a stretch, and records what is proven of it, or cuts it, or returns the answer.
    fn examine(
        &mut self,
        stretches: &mut Stretches<'_, '_>,
        motions: &Motions,
        problem: &Problem<'_>,
        oracle: &mut O,
    ) -> Result<ControlFlow<Answer>, InputError>;

    /// Returns the answer if a limit is reached before a stretch is searched.
    fn stopped(&mut self, stretches: &Stretches<'_, '_>, span: Span, limit: Limit) -> Answer;

    /// Returns the answer if no stretch is left.
    fn done(
        &mut self,
        stretches: &mut Stretches<'_, '_>,
        oracle: &mut O,
    ) -> Result<Answer, InputError>;
}

/// Answers a question about two trajectories: takes the next stretch, and cuts it or has it examined, until no
/// stretch is left.
pub(super) fn drive<O: DistanceOracle, Q: Question<O>>(
    question: &mut Q,
    query: &Query<'_>,
    oracle: &mut O,
) -> Result<Answer, InputError> {
    let stretches = &mut Stretches::new(query);
    loop {
        question.prepare(stretches, oracle)?;
        let Some(span) = stretches.next() else {
            return question.done(stretches, oracle);
        };
        let (motions, terms) = match stretches.motions(span, question.takes_accelerations())? {
            Ok(motions) => motions,
            Err(limit) => return Ok(question.stopped(stretches, span, limit)),
        };
        if question.cut_at_once(stretches, &motions, oracle)? {
            continue;
        }
        let problem = motions.problem(query, &terms)?;
        if let ControlFlow::Break(answer) =
            question.examine(stretches, &motions, &problem, oracle)?
        {
            return Ok(answer);
        }
    }
}
