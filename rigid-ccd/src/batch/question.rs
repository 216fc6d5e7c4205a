//! Questions about two bodies, chosen at run time.

use super::Bodies;
use crate::Solver;
use crate::table::courses::Course;
use crate::table::motions::Query;
use crate::table::paths::{Grouping, Path};
use ccd_core::schedule::{AnyContact, ClosestApproach, ContactInterval, GreatestDistance};
use ccd_core::{Answer, Config, DistanceOracle, InputError, Limit, Outcome};
use std::fmt;

/// A question about the motions of two bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "command", derive(clap::ValueEnum))]
pub enum Question {
    /// When do the bodies first touch?
    #[default]
    FirstContact,
    /// Do they touch at all? The time is that of any contact
    IsFree,
    /// When do they first touch, and when last?
    ContactInterval,
    /// How close do they come, and when?
    ClosestApproach,
    /// How far apart do they get, and when?
    GreatestDistance,
    /// How far apart are they at the start; of a path, in each row?
    Distance,
}

impl Question {
    /// All questions.
    pub const ALL: [Question; 6] = [
        Question::FirstContact,
        Question::IsFree,
        Question::ContactInterval,
        Question::ClosestApproach,
        Question::GreatestDistance,
        Question::Distance,
    ];

    /// Returns the name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Question::FirstContact => "first-contact",
            Question::IsFree => "is-free",
            Question::ContactInterval => "contact-interval",
            Question::ClosestApproach => "closest-approach",
            Question::GreatestDistance => "greatest-distance",
            Question::Distance => "distance",
        }
    }

    /// Returns whether the answer is a distance.
    pub fn is_for_a_distance(self) -> bool {
        match self {
            Question::ClosestApproach | Question::GreatestDistance | Question::Distance => true,
            Question::FirstContact | Question::IsFree | Question::ContactInterval => false,
        }
    }

    /// Returns whether the answer is a distance that is compared with one to be kept.
    pub fn is_for_a_clearance(self) -> bool {
        self.is_for_a_distance() && self != Question::GreatestDistance
    }

    /// Returns whether the answer has one time at which all contacts can be listed.
    pub fn is_for_one_contact(self) -> bool {
        match self {
            Question::FirstContact | Question::IsFree => true,
            Question::ContactInterval
            | Question::ClosestApproach
            | Question::GreatestDistance
            | Question::Distance => false,
        }
    }

    /// Returns the rows of a table that make one path.
    pub fn grouping(self) -> Grouping {
        match self {
            Question::Distance => Grouping::EachRow,
            Question::FirstContact
            | Question::IsFree
            | Question::ContactInterval
            | Question::ClosestApproach
            | Question::GreatestDistance => Grouping::ById,
        }
    }
}

impl fmt::Display for Question {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The answer to a question.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(
    clippy::large_enum_variant,
    reason = "one answer at a time: a box would cost more than the bytes"
)]
pub enum Found {
    /// The first contact.
    First(Outcome),
    /// Any contact.
    Any(AnyContact),
    /// The first and the last contact.
    Interval(ContactInterval),
    /// A distance, or the least one.
    Distance(ClosestApproach),
    /// The greatest distance.
    Greatest(GreatestDistance),
}

impl Found {
    /// Returns the limit that ended the query.
    pub fn limit(&self) -> Option<Limit> {
        match *self {
            Found::First(Outcome::Unresolved { reason, .. })
            | Found::Any(AnyContact::Unresolved { reason, .. })
            | Found::Interval(ContactInterval::Unresolved { reason, .. })
            | Found::Distance(ClosestApproach::Unresolved { reason, .. })
            | Found::Greatest(GreatestDistance::Unresolved { reason, .. }) => Some(reason),
            _ => None,
        }
    }
}

/// A solver that answers every question.
pub trait Questions {
    /// Answers a question about two bodies.
    ///
    /// # Errors
    /// The query is not valid.
    fn ask(
        &mut self,
        question: Question,
        bodies: Bodies<'_>,
        course: &Course,
        config: &Config,
    ) -> Result<Answer<Found>, InputError>;
}

impl<O: DistanceOracle> Questions for Solver<O> {
    fn ask(
        &mut self,
        question: Question,
        bodies: Bodies<'_>,
        course: &Course,
        config: &Config,
    ) -> Result<Answer<Found>, InputError> {
        self.set_config(*config);
        match course {
            Course::Motions(query) => about_motions(self, question, bodies, query),
            Course::Path(path) => about_path(self, question, bodies, path),
        }
    }
}

fn about_motions<O: DistanceOracle>(
    solver: &mut Solver<O>,
    question: Question,
    bodies: Bodies<'_>,
    query: &Query,
) -> Result<Answer<Found>, InputError> {
    let (a, b, end) = ((bodies.a, query.a), (bodies.b, query.b), query.duration);
    Ok(match question {
        Question::FirstContact => solver.answer(a, b, end)?.map(Found::First),
        Question::IsFree => solver.any_contact(a, b, end)?.map(Found::Any),
        Question::ContactInterval => {
            let (a, b) = ((bodies.a, &query.a), (bodies.b, &query.b));
            solver
                .contact_interval_along(a, b, end)?
                .map(Found::Interval)
        }
        Question::ClosestApproach => solver.closest_approach(a, b, end)?.map(Found::Distance),
        Question::GreatestDistance => solver.greatest_distance(a, b, end)?.map(Found::Greatest),
        Question::Distance => {
            let (a, b) = ((a.0, query.a.start()), (b.0, query.b.start()));
            solver.distance(a, b)?.map(Found::Distance)
        }
    })
}

fn about_path<O: DistanceOracle>(
    solver: &mut Solver<O>,
    question: Question,
    bodies: Bodies<'_>,
    path: &Path,
) -> Result<Answer<Found>, InputError> {
    let (a, b, end) = ((bodies.a, &path.a), (bodies.b, &path.b), path.duration);
    Ok(match question {
        Question::FirstContact => solver.answer_along(a, b, end)?.map(Found::First),
        Question::IsFree => solver.any_contact_along(a, b, end)?.map(Found::Any),
        Question::ContactInterval => solver
            .contact_interval_along(a, b, end)?
            .map(Found::Interval),
        Question::ClosestApproach => solver
            .closest_approach_along(a, b, end)?
            .map(Found::Distance),
        Question::GreatestDistance => solver
            .greatest_distance_along(a, b, end)?
            .map(Found::Greatest),
        Question::Distance => {
            let [a, b] = path.poses(0.0)?;
            solver
                .distance((bodies.a, a), (bodies.b, b))?
                .map(Found::Distance)
        }
    })
}

#[cfg(all(test, feature = "command"))]
mod tests {
    use super::Question;
    use clap::ValueEnum;

    #[test]
    fn questions_have_the_names_of_the_command_line() {
        assert_eq!(Question::value_variants(), Question::ALL);
        for question in Question::ALL {
            let value = question.to_possible_value().expect("none is hidden");
            assert_eq!(value.get_name(), question.name());
        }
    }
}
