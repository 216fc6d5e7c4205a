//! Cuts a query into problems that are searched one after another, as its start policy and the period of its motions
//! require.

use super::given_bodies::{convert_contact_to_given_bodies, outcome_on_original_bodies};
use super::meter::Meter;
use super::rounds::PeriodicSearch;
use super::start::search_contact_at_start;
use crate::answer::Outcome;
use crate::distance::oracle::DistanceOracle;
use crate::math::order::greater;
use crate::problem::Problem;
use crate::settings::StartPolicy;
use crate::touching_plane::TouchingPlane;
use std::borrow::Cow;
use std::ops::ControlFlow::{self, Break, Continue};

/// The problems of a query for a contact. Each is searched after the outcome of the one before.
///
/// Bodies that begin in contact, under the policy `StartPolicy::Leave`, are searched again at half the gap that they
/// began with. Pairs that part or slide keep more than that gap; pairs that approach do not. If there is no useful
/// gap, each pair of pieces that rest on each other is let go by itself.
///
/// Motions that repeat are searched in the [rounds](PeriodicSearch) of their period.
#[derive(Debug)]
pub(crate) struct Subproblems<'p, 'a> {
    /// The problem over the whole time. It reports a contact at the start until that is to be ignored.
    whole: Cow<'p, Problem<'a>>,
    start: StartContact,
    /// The rounds of the whole problem; `None` if its motions do not repeat.
    rounds: Option<PeriodicSearch>,
}

/// What a query does about a contact at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum StartContact {
    /// The contact is the answer.
    Report,
    /// The contact will be ignored, if there is one.
    IgnoreIfFound,
    /// There was a contact, and the present problem ignores it.
    Ignored,
}

/// The outcome of a query, and the tolerance that it achieves.
pub(crate) type OutcomeWithTolerance = (Outcome, f64);

impl<'p, 'a> Subproblems<'p, 'a> {
    pub(crate) fn new(mut whole: Cow<'p, Problem<'a>>) -> Self {
        let start = match whole.start_policy {
            StartPolicy::Report => StartContact::Report,
            StartPolicy::Leave => {
                whole.to_mut().start_policy = StartPolicy::Report;
                StartContact::IgnoreIfFound
            }
        };
        Subproblems {
            rounds: PeriodicSearch::for_problem(&whole),
            whole,
            start,
        }
    }

    /// Returns the problem to search now.
    #[inline]
    pub(crate) fn current(&self) -> Cow<'_, Problem<'a>> {
        match &self.rounds {
            Some(rounds) => Cow::Owned(rounds.problem_of_round(&self.whole)),
            None => Cow::Borrowed(&self.whole),
        }
    }

    /// Returns a clock of the current problem. The time of this clock, or of a later one, is not before `time`.
    pub(crate) fn clock_not_before(&self, problem: &Problem<'_>, time: f64) -> f64 {
        if time == f64::INFINITY {
            return time;
        }
        // The time of a clock is rounded down.
        let beyond = match self.rounds {
            Some(_) => time * (1.0 + 4.0 * f64::EPSILON),
            None => time.next_up(),
        };
        (problem.clock_of_time(beyond) * (1.0 + 4.0 * f64::EPSILON)).next_up()
    }

    /// Processes the outcome of the current problem. Continues if there is another problem to search, and breaks with
    /// the outcome of the query otherwise.
    pub(crate) fn next_problem_or_outcome<O: DistanceOracle>(
        &mut self,
        outcome: Outcome,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> ControlFlow<OutcomeWithTolerance> {
        let outcome = match &mut self.rounds {
            None => outcome,
            Some(rounds) => match rounds.start_next_round_or_finish(&self.whole, &outcome, meter) {
                Continue(()) => return Continue(()),
                Break(outcome) => outcome,
            },
        };
        self.apply_start_policy(outcome, oracle, meter)
    }

    /// Examines the start if a contact there is to be ignored. A search that need not examine pairs in order of time
    /// may pass over such a contact. Breaks if that decides the query.
    pub(crate) fn examine_start<O: DistanceOracle>(
        &mut self,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> ControlFlow<OutcomeWithTolerance> {
        let beyond = self.whole.contact_distance().next_up();
        if self.start == StartContact::IgnoreIfFound
            && let Some(outcome) = search_contact_at_start(&self.whole, beyond, oracle, meter)
        {
            return self.apply_start_policy(outcome, oracle, meter);
        }
        Continue(())
    }

    /// Continues with the problem that ignores the contact at the start, if the outcome is a contact to be ignored.
    fn apply_start_policy<O: DistanceOracle>(
        &mut self,
        outcome: Outcome,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> ControlFlow<OutcomeWithTolerance> {
        let problem = &*self.whole;
        if let (StartContact::IgnoreIfFound, Outcome::Touching { contact }) = (self.start, outcome)
        {
            let (within, at_start) = (problem.contact_distance(), problem.time_of_clock(0.0));
            // The normal is needed here. That of two pieces alone may be arbitrary.
            let contact =
                convert_contact_to_given_bodies(problem, oracle, meter, contact, within, at_start);
            let gap = contact.separation.lower - problem.margin;
            let plane = TouchingPlane::from_contact(problem, &contact, oracle, meter);
            let parting = problem.ignoring_start_contact(gap, plane);
            *self = Subproblems {
                rounds: PeriodicSearch::for_problem(&parting),
                whole: Cow::Owned(parting),
                start: StartContact::Ignored,
            };
            return Continue(());
        }
        let tolerance = self.achieved_tolerance(&outcome);
        let within = problem.margin + tolerance;
        let outcome = outcome_on_original_bodies(problem, oracle, meter, outcome, |_| within);
        Break((outcome, tolerance))
    }

    /// Returns the tolerance that an outcome of the query achieves. Pieces that rest on each other count as in contact
    /// again once they cannot be proven apart. Their distance may then be known less exactly than the least tolerance.
    fn achieved_tolerance(&self, outcome: &Outcome) -> f64 {
        let problem = &self.whole;
        match (self.start, outcome) {
            (StartContact::Ignored, Outcome::Contact { contact, .. }) => {
                let shown = (contact.separation.upper - problem.margin).next_up();
                greater(problem.tolerance, shown)
            }
            _ => problem.tolerance,
        }
    }
}
