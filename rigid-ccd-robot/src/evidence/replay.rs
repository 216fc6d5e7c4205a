//! Replays a record: asks the same question again and compares the answers.

use super::{Evidence, RecordedAnswer, RecordedBody, RecordedPath, bodies_at_start, pairs_digest};
use crate::cell::Cell;
use crate::error::{PathError, RobotError};
use crate::path::Path;
use crate::path_answer::{PathAnswer, PathOutcome};
use crate::path_point::PathPoint;
use rigid_ccd::Settings;

/// The tolerance, in metres and in quaternion components, within which a body's pose counts as unchanged. Sines differ
/// between machines in their last digits, and errors add up from link to link.
const POSE_TOLERANCE: f64 = 1e-9;

/// A replay confirms the free part of a recorded path with the recorded tolerance divided by this number.
const REPLAY_TOLERANCE_DIVISOR: f64 = 1000.0;

/// The reason why a record cannot be made, read or replayed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EvidenceError {
    /// The text is not a record.
    #[error("not a record of an answer: {0}")]
    NoRecord(#[from] serde_json::Error),
    /// The record has another format version.
    #[error("the format is `{0}`, but this version reads `{FORMAT}`", FORMAT = super::FORMAT)]
    OtherFormat(String),
    /// The answer is not about the first contact.
    #[error("the answer is not about the first contact; other answers cannot be recorded")]
    NoFirstContact,
    /// The path has no configuration.
    #[error("the path has no configuration")]
    EmptyPath,
    /// The path does not fit the robot.
    #[error("the path does not fit the robot: {0}")]
    Path(#[source] RobotError),
    /// A body differs from the recorded one.
    #[error("{0}")]
    OtherBody(String),
    /// The checked pairs, or the distances at which they count as touching, differ from the recorded ones.
    #[error(
        "the compared pairs, or the distances at which they count as touching, differ from the recorded ones"
    )]
    OtherPairs,
    /// The question is invalid for this cell.
    #[error(transparent)]
    Question(#[from] PathError),
}

/// The result of a replay.
#[derive(Clone, Debug, PartialEq)]
pub struct Replay {
    /// Whether the recorded answer still holds.
    pub verdict: Verdict,
    /// The new answer, computed without a deadline.
    pub answer: RecordedAnswer,
}

/// Whether a recorded answer still holds.
///
/// All variants are to be handled, so that no refuted record passes for a valid one: the enum is exhaustive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// The new answer has the same bits.
    SameAnswer,
    /// The new answer differs, because the record ended at a limit or came from another machine or version. Nothing
    /// touches before the point up to which the record calls the path free.
    Holds,
    /// A pair touches before the point up to which the record calls the path free.
    Refuted {
        /// The point at which the pair touches.
        at: PathPoint,
    },
    /// The replay reached a limit before it could confirm or refute the record.
    Undecided,
}

impl Evidence {
    /// Asks the recorded question again, without a deadline, for a cell that equals the recorded one.
    ///
    /// # Guarantee
    /// [`Verdict::SameAnswer`] and [`Verdict::Holds`] prove again that nothing touches before the point up to which
    /// the record calls the path free, within a thousandth of the tolerance.
    ///
    /// # Errors
    /// [`EvidenceError`], also for a cell with other bodies, other poses at the start or other margins.
    pub fn replay(&self, cell: &Cell) -> Result<Replay, EvidenceError> {
        self.check_cell(cell)?;
        let settings = Settings {
            tolerance: self.settings.tolerance,
            margin: self.settings.margin,
            budget: self.settings.budget,
            start_policy: self.settings.start,
            ..Settings::DEFAULT
        };
        let answer = RecordedAnswer::try_from(&self.first_contact(cell, &settings)?)?;
        let verdict = if answer == self.answer {
            Verdict::SameAnswer
        } else {
            self.compare_with(&self.first_contact(
                cell,
                &Settings {
                    tolerance: self.settings.tolerance / REPLAY_TOLERANCE_DIVISOR,
                    ..settings
                },
            )?)
        };
        Ok(Replay { verdict, answer })
    }

    fn first_contact<'c>(
        &self,
        cell: &'c Cell,
        settings: &Settings,
    ) -> Result<PathAnswer<'c>, EvidenceError> {
        let path: &dyn Path = match &self.path {
            RecordedPath::Configurations(all) => all,
            RecordedPath::Curve(curve) => curve,
        };
        let mut solver = cell.solver().with_settings(settings.clone());
        Ok(solver.first_contact(path)?)
    }

    /// Compares the recorded answer with an answer at a finer tolerance.
    fn compare_with(&self, finer: &PathAnswer<'_>) -> Verdict {
        let free_until = self.answer.free_until();
        // Written so that NaN is not free.
        let is_reached = free_until.is_some_and(|until| until <= finer.free_until);
        match finer.outcome {
            PathOutcome::Free => Verdict::Holds,
            _ if is_reached => Verdict::Holds,
            PathOutcome::Contact(contact) => Verdict::Refuted { at: contact.at },
            PathOutcome::LeastDistance { .. } | PathOutcome::Unresolved(_) => Verdict::Undecided,
        }
    }

    /// Checks that the cell is the recorded one. The error names the difference.
    fn check_cell(&self, cell: &Cell) -> Result<(), EvidenceError> {
        let bodies = bodies_at_start(cell, &self.path)?;
        if bodies.len() != self.bodies.len() {
            return Err(EvidenceError::OtherBody(format!(
                "the cell has {} bodies, but {} were recorded",
                bodies.len(),
                self.bodies.len()
            )));
        }
        for (body, recorded) in bodies.iter().zip(&self.bodies) {
            if let Some(difference) = difference(body, recorded) {
                return Err(EvidenceError::OtherBody(difference));
            }
        }
        if pairs_digest(cell, self.settings.margin) == self.pairs_sha256 {
            Ok(())
        } else {
            Err(EvidenceError::OtherPairs)
        }
    }
}

/// Describes how a body differs from the recorded one; `None` if it is the same.
fn difference(body: &RecordedBody, recorded: &RecordedBody) -> Option<String> {
    let name = &recorded.item;
    if body.item != *name {
        return Some(format!(
            "the record has `{name}` instead of `{}`",
            body.item
        ));
    }
    if body.sha256 != recorded.sha256 {
        return Some(format!("`{name}` is not the recorded body"));
    }
    let near =
        |a: &[f64], b: &[f64]| (a.iter().zip(b)).all(|(a, b)| (a - b).abs() <= POSE_TOLERANCE);
    // A quaternion and its negative are the same rotation.
    let negative = recorded.orientation.map(|q| -q);
    let same_orientation =
        near(&body.orientation, &recorded.orientation) || near(&body.orientation, &negative);
    if near(&body.position, &recorded.position) && same_orientation {
        None
    } else {
        Some(format!(
            "`{name}` is elsewhere at the start of the path: its pose differs from the recorded one"
        ))
    }
}
