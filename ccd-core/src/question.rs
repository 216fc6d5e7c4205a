//! The questions, chosen at run time.

use std::fmt;

/// A question about bodies that move: two bodies, or a robot on a path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Question {
    /// When do they first touch?
    #[default]
    FirstContact,
    /// Do they touch at all? The time is that of any contact.
    AnyContact,
    /// When do they first touch, and when last?
    ContactInterval,
    /// How close do they come, and when?
    ClosestApproach,
    /// How far apart are they at the start?
    Distance,
}

impl Question {
    /// All questions about two bodies. Those about a path are fewer.
    pub const ALL: [Question; 5] = [
        Question::FirstContact,
        Question::AnyContact,
        Question::ContactInterval,
        Question::ClosestApproach,
        Question::Distance,
    ];

    /// Returns the question's name in commands and tables. [`AnyContact`](Question::AnyContact) is named after what programs ask it
    /// for.
    ///
    /// ```
    /// assert_eq!(ccd_core::Question::AnyContact.name(), "is-free");
    /// ```
    pub const fn name(self) -> &'static str {
        match self {
            Question::FirstContact => "first-contact",
            Question::AnyContact => "is-free",
            Question::ContactInterval => "contact-interval",
            Question::ClosestApproach => "closest-approach",
            Question::Distance => "distance",
        }
    }

    /// Returns the question with a name; `None` if there is none.
    pub fn from_name(name: &str) -> Option<Self> {
        let mut all = Question::ALL.into_iter();
        all.find(|question| question.name() == name)
    }

    /// Returns whether the answer is a distance rather than a time of contact.
    pub fn is_for_a_distance(self) -> bool {
        matches!(self, Question::ClosestApproach | Question::Distance)
    }

    /// Returns whether the answer has a single time at which all contacts can be listed.
    pub fn has_single_contact_time(self) -> bool {
        matches!(self, Question::FirstContact | Question::AnyContact)
    }
}

impl fmt::Display for Question {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
