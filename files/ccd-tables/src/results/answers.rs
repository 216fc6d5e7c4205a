//! The questions, with the statuses and the columns of their answers.

use super::columns::{Column, LAST_TIME_COLUMN};
use super::status::Status;
use ccd_core::Question;

/// The answers that a question may have. The help of the command is generated from it.
#[derive(Clone, Copy, Debug)]
pub struct QuestionAnswers {
    /// The question.
    pub question: Question,
    /// The question as a sentence.
    pub words: &'static str,
    /// The statuses of answers without a clearance, except [`Status::Unresolved`].
    pub statuses: &'static [Status],
    /// The statuses of answers that are compared with a clearance; none if the question takes no clearance.
    pub compared_statuses: &'static [Status],
    /// The columns that follow the columns of all tables of results.
    pub more_columns: &'static [Column],
}

/// All questions with their answers, in the order of [`Question::ALL`].
pub const ANSWERS: [QuestionAnswers; 5] = [
    QuestionAnswers {
        question: Question::FirstContact,
        words: "When do the bodies first touch?",
        statuses: KINDS_OF_CONTACT,
        compared_statuses: &[],
        more_columns: &[],
    },
    QuestionAnswers {
        question: Question::AnyContact,
        words: "Do they touch at all? The time may belong to any contact",
        statuses: &[Status::Contact, Status::Free, Status::Overlapping],
        compared_statuses: &[],
        more_columns: &[],
    },
    QuestionAnswers {
        question: Question::ContactInterval,
        words: "When do they first touch, and when last?",
        // The status describes the first contact. Every status except `free` comes with a last contact.
        statuses: KINDS_OF_CONTACT,
        compared_statuses: &[],
        more_columns: &[LAST_TIME_COLUMN],
    },
    QuestionAnswers {
        question: Question::ClosestApproach,
        words: "How close do they come, and when?",
        statuses: DISTANCES,
        compared_statuses: VERDICTS,
        more_columns: &[],
    },
    QuestionAnswers {
        question: Question::Distance,
        words: "How far apart are they at the start; of a path, in each row?",
        statuses: DISTANCES,
        compared_statuses: VERDICTS,
        more_columns: &[],
    },
];

const KINDS_OF_CONTACT: &[Status] = &[
    Status::Contact,
    Status::Free,
    Status::Touching,
    Status::Overlapping,
];
const DISTANCES: &[Status] = &[Status::Measured, Status::Overlapping];
const VERDICTS: &[Status] = &[Status::Kept, Status::Violated, Status::Unverified];

impl QuestionAnswers {
    /// Returns the answers that a question may have.
    pub fn of(question: Question) -> Self {
        ANSWERS[question as usize]
    }
}
