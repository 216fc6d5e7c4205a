//! Searches for the first contact in steps: the search stops at a given time, and continues later.

use super::along::contacts::first_contact;
use crate::answer::Answer;
use crate::distance::oracle::DistanceOracle;
use crate::engine::best_first::{BestFirst, BestFirstSearch, Progress};
use crate::error::InputError;
use crate::query::Query;
use std::borrow::Cow;

/// A search for the first contact that can stop at any time and continue later.
///
/// It serves queries for the first contact among many pairs of bodies. No pair is proven further than the answer
/// needs: the pair that is proven least far continues next.
///
/// ```
/// use ccd_core::{schedule::{BestFirst, FirstContactSearch, Progress}, *};
/// # struct Balls;
/// # impl DistanceOracle for Balls {
/// #     type Cache = ();
/// #     fn separation(&mut self, pair: &PiecePair<'_>, _: &mut ()) -> Result<Claim, GiveUpReason> {
/// #         let axis = pair.b_to_a.transform_point(pair.b.points[0]) - pair.a.points[0];
/// #         Ok(Claim { axis, a: ConvexCombination::from_single_point(0), b: ConvexCombination::from_single_point(0) })
/// #     }
/// # }
/// let ball = Body::sphere(0.5)?;
/// let flying = Motion::new(Pose::at([-3.0, 0.0, 0.0])?, [1.0, 0.0, 0.0], [0.0; 3])?;
/// let query = Query::new((&ball, flying), (&ball, Motion::STILL), 4.0, &Settings::DEFAULT)?;
/// let mut search = FirstContactSearch::new(query, BestFirst::default());
/// let Progress::ApartUntil(time) = search.advance(&mut Balls, 0.5)? else { panic!("they are far apart") };
/// assert!(time >= 0.5 && time <= 2.0);
/// let Progress::Answered(answer) = search.advance(&mut Balls, 4.0)? else { panic!("all time is up") };
/// assert!(matches!(answer.outcome, Outcome::Contact { .. }));
/// # Ok::<(), InputError>(())
/// ```
pub struct FirstContactSearch<'a, O: DistanceOracle>(SearchKind<'a, O>);

#[allow(clippy::large_enum_variant, reason = "most searches go in steps")]
enum SearchKind<'a, O: DistanceOracle> {
    /// A search for bodies with constant velocities, which is done in steps.
    OfMotions(BestFirstSearch<'a, 'a, O>),
    /// A search for bodies on trajectories, which is done to its end in the first step.
    AlongTrajectories {
        query: Query<'a>,
        schedule: BestFirst<O>,
        answer: Option<Answer>,
    },
}

impl<'a, O: DistanceOracle> FirstContactSearch<'a, O> {
    /// Creates the search for a query. It reuses the allocations of the schedule `memory`. The time until the
    /// [deadline](crate::Settings::deadline) starts now.
    pub fn new(mut query: Query<'a>, memory: BestFirst<O>) -> Self {
        FirstContactSearch(match query.constant_velocity_problem.take() {
            Some(problem) => {
                SearchKind::OfMotions(BestFirstSearch::new(Cow::Owned(problem), memory))
            }
            None => SearchKind::AlongTrajectories {
                query,
                schedule: memory,
                answer: None,
            },
        })
    }

    /// Returns the schedule with its memory, for another search.
    pub fn into_schedule(self) -> BestFirst<O> {
        match self.0 {
            SearchKind::OfMotions(search) => search.into_schedule(),
            SearchKind::AlongTrajectories { schedule, .. } => schedule,
        }
    }

    /// Continues the search until the bodies are proven apart up to the time `until` or later, or there is an answer.
    /// Along trajectories other than [motions](crate::Motion), the search continues to the answer.
    ///
    /// # Guarantee
    /// [Never late](crate#guarantee); ends on every input. The answer has the same bits as that of [`BestFirst`],
    /// whatever the steps, unless a deadline ends the search.
    ///
    /// # Errors
    /// An [`InputError`] if a trajectory has no motion at some time, or one out of range.
    pub fn advance(&mut self, oracle: &mut O, until: f64) -> Result<Progress, InputError> {
        match &mut self.0 {
            SearchKind::OfMotions(search) => Ok(search.advance(oracle, until)),
            SearchKind::AlongTrajectories {
                query,
                schedule,
                answer,
            } => {
                if answer.is_none() {
                    *answer = Some(first_contact(schedule, query, oracle)?);
                }
                Ok(answer.map_or(Progress::ApartUntil(0.0), Progress::Answered))
            }
        }
    }
}

#[cfg(test)]
mod tests;
