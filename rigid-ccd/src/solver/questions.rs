//! The questions of a solver as pointers to functions, so that crates that ask them do not compile the engine anew.
//!
//! A generic function is compiled in each crate that calls it. Called by a pointer, the engine for [`Direct`] is compiled
//! once, in this crate: a program with three crates that ask questions would have three copies of it.
//!
//! [`Direct`]: crate::oracle::Direct

use ccd_core::schedule::{BestFirst, DepthFirst, Schedule};
use ccd_core::{Answer, DistanceOracle, InputError, Query, Question};

type Ask<S, O> = fn(&mut S, &Query<'_>, &mut O) -> Result<Answer, InputError>;

/// The schedules that answer questions, with their memory and their distance backend.
pub(super) struct Engine<O: DistanceOracle> {
    best_first: BestFirst<O>,
    depth_first: DepthFirst<O>,
    oracle: O,
    questions: Questions<O>,
}

/// The function that answers each question.
pub(super) struct Questions<O: DistanceOracle> {
    first_contact: Ask<BestFirst<O>, O>,
    contact_interval: Ask<BestFirst<O>, O>,
    any_contact: Ask<DepthFirst<O>, O>,
    closest_approach: Ask<DepthFirst<O>, O>,
}

impl<O: DistanceOracle> Questions<O> {
    /// The engine compiled for a distance backend, in the crate that names the backend.
    pub(super) const COMPILED: Self = Questions {
        first_contact: Schedule::first_contact,
        contact_interval: BestFirst::contact_interval,
        any_contact: DepthFirst::any_contact,
        closest_approach: DepthFirst::closest_approach,
    };
}

impl<O: DistanceOracle> Engine<O> {
    pub(super) fn new(oracle: O, questions: Questions<O>) -> Self {
        Engine {
            best_first: BestFirst::default(),
            depth_first: DepthFirst::default(),
            oracle,
            questions,
        }
    }

    pub(super) fn answer(
        &mut self,
        question: Question,
        query: &Query<'_>,
    ) -> Result<Answer, InputError> {
        let (best_first, depth_first) = (&mut self.best_first, &mut self.depth_first);
        let (ask, oracle) = (&self.questions, &mut self.oracle);
        match question {
            Question::FirstContact => (ask.first_contact)(best_first, query, oracle),
            Question::AnyContact => (ask.any_contact)(depth_first, query, oracle),
            Question::ContactInterval => (ask.contact_interval)(best_first, query, oracle),
            Question::ClosestApproach => (ask.closest_approach)(depth_first, query, oracle),
            Question::Distance if query.duration() == 0.0 => {
                (ask.closest_approach)(depth_first, query, oracle)
            }
            Question::Distance => (ask.closest_approach)(depth_first, &query.at_start()?, oracle),
        }
    }
}
