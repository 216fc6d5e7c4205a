//! Questions about two bodies, chosen at run time.

use crate::table::paths::Grouping;
use std::fmt;

/// A question about the motions of two bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Question {
    /// When do the bodies first touch?
    #[default]
    FirstContact,
    /// Do they touch at all? The time is that of any contact.
    IsFree,
    /// When do they first touch, and when last?
    ContactInterval,
    /// How close do they come, and when?
    ClosestApproach,
    /// How far apart are they at the start; of a path, in each row?
    Distance,
}

impl Question {
    /// All questions, in the order of the command's help.
    pub const ALL: [Question; 5] = [
        Question::FirstContact,
        Question::IsFree,
        Question::ContactInterval,
        Question::ClosestApproach,
        Question::Distance,
    ];

    /// Returns the question's name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Question::FirstContact => "first-contact",
            Question::IsFree => "is-free",
            Question::ContactInterval => "contact-interval",
            Question::ClosestApproach => "closest-approach",
            Question::Distance => "distance",
        }
    }

    /// Returns whether the answer is a distance rather than a time of contact.
    pub fn is_for_a_distance(self) -> bool {
        matches!(self, Question::ClosestApproach | Question::Distance)
    }

    /// Returns whether the answer has a single time at which all contacts can be listed.
    pub fn has_single_contact_time(self) -> bool {
        matches!(self, Question::FirstContact | Question::IsFree)
    }

    /// Returns which rows of a table of paths this question treats as one path.
    pub fn path_grouping(self) -> Grouping {
        match self {
            Question::Distance => Grouping::QueryPerRow,
            _ => Grouping::ById,
        }
    }
}

impl fmt::Display for Question {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
