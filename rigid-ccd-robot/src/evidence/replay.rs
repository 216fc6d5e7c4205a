//! Asks a recorded question again, and holds the recorded answer against the new one.

use super::{Evidence, RecordedAnswer, RecordedBody, RecordedPath, bodies_at_start, pairs_digest};
use crate::cell::Cell;
use crate::error::{PathError, RobotError};
use crate::path::Path;
use crate::path_answer::{PathAnswer, PathOutcome};
use crate::path_point::PathPoint;
use rigid_ccd::Settings;

/// How far positions and quaternions of the same body may differ, in metres: sines differ in their last digits from machine to
/// machine, and links add them up.
const POSE_TOLERANCE: f64 = 1e-9;

/// A replay looks for contacts before the point that the record calls free with the recorded tolerance over this number.
const REPLAY_TOLERANCE_DIVISOR: f64 = 1000.0;

/// The reason why a record cannot be made, read or replayed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EvidenceError {
    /// The text is no record.
    #[error("no record of an answer: {0}")]
    NoRecord(#[from] serde_json::Error),
    /// The record is of another version of the format.
    #[error("the format is `{0}`, but this version reads `{FORMAT}`", FORMAT = super::FORMAT)]
    OtherFormat(String),
    /// The answer is none to a question about the first contact.
    #[error("the answer is not one about the first contact: only such are recorded")]
    NoFirstContact,
    /// The path has no configuration.
    #[error("the path has no configuration")]
    EmptyPath,
    /// The path does not fit the robot.
    #[error("the path does not fit the robot: {0}")]
    Path(#[source] RobotError),
    /// A body differs from the one that was recorded.
    #[error("{0}")]
    OtherBody(String),
    /// Other pairs of bodies are compared, or at other distances.
    #[error(
        "other pairs are compared than were recorded, or they count as touching at other distances"
    )]
    OtherPairs,
    /// The question cannot be asked again.
    #[error(transparent)]
    Question(#[from] PathError),
}

/// The result of a replay.
#[derive(Clone, Debug, PartialEq)]
pub struct Replay {
    /// Whether the record holds.
    pub verdict: Verdict,
    /// The answer to the recorded question, without a deadline.
    pub answer: RecordedAnswer,
}

/// Whether a recorded answer holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// The answer is the same in every bit.
    SameAnswer,
    /// The answer is another one, for the record ended at a limit or is of another machine or version; but nothing touches before
    /// the point that the record calls free.
    Holds,
    /// A pair touches before that point.
    Refuted {
        /// The point at which it touches.
        at: PathPoint,
    },
    /// A limit was reached before it was decided.
    Undecided,
}

impl Evidence {
    /// Asks the recorded question again, without a deadline, in a cell that has to be the recorded one.
    ///
    /// # Guarantee
    /// [`Verdict::SameAnswer`] and [`Verdict::Holds`] prove once more that nothing touches before the point that the record calls
    /// free, up to a thousandth of the tolerance.
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
        let answer = RecordedAnswer::try_from(&self.ask(cell, &settings)?)?;
        let verdict = if answer == self.answer {
            Verdict::SameAnswer
        } else {
            self.judge(&self.ask(
                cell,
                &Settings {
                    tolerance: self.settings.tolerance / REPLAY_TOLERANCE_DIVISOR,
                    ..settings
                },
            )?)
        };
        Ok(Replay { verdict, answer })
    }

    fn ask<'c>(
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

    /// Holds the recorded answer against one with a finer tolerance.
    fn judge(&self, finer: &PathAnswer<'_>) -> Verdict {
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

    /// Refuses a cell that is not the recorded one, and says where it differs.
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

/// Says how a body differs from the recorded one; `None` if it does not.
fn difference(body: &RecordedBody, recorded: &RecordedBody) -> Option<String> {
    let name = &recorded.item;
    if body.item != *name {
        return Some(format!("`{}` is where `{name}` was recorded", body.item));
    }
    if body.sha256 != recorded.sha256 {
        return Some(format!("`{name}` is another body than was recorded"));
    }
    let near =
        |a: &[f64], b: &[f64]| (a.iter().zip(b)).all(|(a, b)| (a - b).abs() <= POSE_TOLERANCE);
    // A quaternion and its negative are the same rotation.
    let turned = recorded.orientation.map(|q| -q);
    let same_turn =
        near(&body.orientation, &recorded.orientation) || near(&body.orientation, &turned);
    if near(&body.position, &recorded.position) && same_turn {
        None
    } else {
        Some(format!(
            "`{name}` is elsewhere at the start of the path than was recorded"
        ))
    }
}
