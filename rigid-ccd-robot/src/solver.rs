//! Questions about paths: a robot moves through configurations, or along a curve.

mod boxes;
mod clearance_ranges;
mod constant_step;
mod curved_link;
pub(crate) mod displacement;
mod distance_curve;
mod engine;
mod engine_candidates;
mod exact;
mod limits;
pub(crate) mod measure;
pub(crate) mod pair_chain;
pub(crate) mod part_pairs;
mod periods;
pub(crate) mod placement;
mod search;
pub(crate) mod violation;

pub use clearance_ranges::{ClearanceRange, RangeSettings};
pub use distance_curve::DistanceRange;

use crate::cell::Cell;
use crate::error::PathError;
use crate::path::Path;
use crate::path_answer::{PathAnswer, PathContact, PathOutcome, UnresolvedPath};
use crate::path_point::PathPoint;
use ccd_core::order::greater;
use part_pairs::PartPair;
use rigid_ccd::answer::{HitKind, Unresolved};
use rigid_ccd::{ContactNormals, Error, Hit, Outcome, Question, Settings, Solver, StartPolicy};
use search::PathSearch;

/// Answers questions about paths in a cell, one after another.
///
/// A [`Path`] is a slice of configurations, between two of which all joints move at constant rates, or a
/// [`JointCurve`](crate::JointCurve).
///
/// The margin of the settings is the distance at which bodies count as touching. Normals of contacts play no role, and a clearance in
/// the settings is refused.
///
/// A deadline is for a whole question. A [budget](rigid_ccd::Settings::budget) is for each query of two bodies that a path leaves to
/// the engine. A whole question takes at most 8 budgets for each segment of its path, all pairs together: what one segment does
/// not need is for the others. That counts the pairs that are measured as well; each takes less than a microsecond. The closest
/// approach takes up to half as much again. Each range of a [distance curve](Self::distance_curve) counts as a question, and so
/// does each interval that is examined for [clearance ranges](Self::clearance_ranges). A budget may end a search at a contact that
/// is later, within the tolerance of what is asked for, than the one that a larger budget finds.
///
/// Under the start policy [`Leave`](StartPolicy::Leave), questions about the first or any contact let go of pairs in contact at the
/// start, as two bodies do: such a pair may part or slide, but not come nearer nor sink. One with a gap keeps half of it from then on;
/// one without may sink by what rounding hides and by a millionth of the tolerance, and touches again when it comes back. A pair that
/// begins nearer than its margin keeps the distance that it began with. One that overlaps is a contact, and so is one
/// without a gap that slides along other ways than straight ones: [`Cell::allow_contact`] allows that.
pub struct CellSolver<'c> {
    cell: &'c Cell,
    search: PathSearch<'c>,
    distance_solver: Solver,
}

/// What a search along a path looks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Goal {
    AnyContact,
    FirstContact,
    LeastDistance,
}

impl Cell {
    /// Returns a solver for paths in this cell. It keeps memory from one question to the next.
    pub fn solver(&self) -> CellSolver<'_> {
        CellSolver {
            cell: self,
            search: PathSearch::new(self),
            distance_solver: Solver::new(),
        }
    }
}

impl<'c> CellSolver<'c> {
    /// Sets the tolerance, the margin and limits of the questions that follow.
    #[must_use]
    pub fn with_settings(mut self, settings: Settings) -> Self {
        self.set_settings(settings);
        self
    }

    /// Makes what questions would make when they need it first: the chains of joints by which pairs move, and place for pairs.
    /// Answers are the same. A solver that has to keep deadlines, or not to allocate, is prepared, and warmed by some questions.
    pub fn prepare(&mut self) {
        self.search.prepare();
    }

    /// Changes the tolerance, the margin and limits of the questions that follow.
    pub fn set_settings(&mut self, settings: Settings) {
        self.search.set_settings(settings);
    }

    /// Returns whether the robot touches nothing on a path, itself included. A pair in contact is not measured.
    ///
    /// # Guarantee
    /// On a free path all pairs that are checked stay apart by more than the margin. On other paths a pair comes within
    /// margin + [tolerance](PathAnswer::tolerance).
    ///
    /// # Errors
    /// [`PathError`]; also if a limit is reached.
    pub fn is_free<P: Path + ?Sized>(&mut self, path: &P) -> Result<bool, PathError> {
        self.search(Goal::AnyContact, path)?;
        let found = &self.search.result;
        match (found.nearest, found.limit_reached) {
            (Some(_), _) => Ok(false),
            (None, None) => Ok(true),
            (None, Some((limit, _))) => {
                Err(Error::from(Unresolved::from_safe_until(0.0, limit)).into())
            }
        }
    }

    /// Returns any contact on a path, perhaps not the first one. Limits may change which one.
    ///
    /// # Errors
    /// [`PathError`].
    pub fn any_contact<P: Path + ?Sized>(&mut self, path: &P) -> Result<PathAnswer<'c>, PathError> {
        self.answer(Question::AnyContact, path)
    }

    /// Returns the first contact on a path: the last free point, and what touches there.
    ///
    /// # Guarantee
    /// All pairs that are checked stay apart by more than the margin before that point. There the pair is within
    /// margin + [tolerance](PathAnswer::tolerance).
    ///
    /// # Errors
    /// [`PathError`].
    pub fn first_contact<P: Path + ?Sized>(
        &mut self,
        path: &P,
    ) -> Result<PathAnswer<'c>, PathError> {
        self.answer(Question::FirstContact, path)
    }

    /// Returns how near any pair that is checked comes to touching on a path. The margin, paddings and clearances play no
    /// role.
    ///
    /// # Guarantee
    /// No pair is ever nearer than the lower bound, and the nearest one comes at least as near as the upper bound. They
    /// differ by at most the [tolerance](PathAnswer::tolerance), and by what the nearest bodies
    /// [exceed](rigid_ccd::Body::excess) their shapes by, unless a limit is reached.
    ///
    /// # Errors
    /// [`PathError`].
    pub fn closest_approach<P: Path + ?Sized>(
        &mut self,
        path: &P,
    ) -> Result<PathAnswer<'c>, PathError> {
        self.answer(Question::ClosestApproach, path)
    }

    /// Answers a question that is chosen at run time, one of [`QUESTIONS`](Self::QUESTIONS).
    ///
    /// # Errors
    /// [`PathError`]; also for other questions.
    pub fn answer<P: Path + ?Sized>(
        &mut self,
        question: Question,
        path: &P,
    ) -> Result<PathAnswer<'c>, PathError> {
        let goal = match question {
            Question::AnyContact => Goal::AnyContact,
            Question::FirstContact => Goal::FirstContact,
            Question::ClosestApproach => Goal::LeastDistance,
            Question::ContactInterval | Question::Distance => {
                return Err(PathError::UnsupportedQuestion { question });
            }
        };
        self.search(goal, path)?;
        Ok(self.measured_answer(goal)?)
    }

    /// The questions about a path.
    pub const QUESTIONS: [Question; 3] = [
        Question::AnyContact,
        Question::FirstContact,
        Question::ClosestApproach,
    ];

    /// Returns the tolerance that the last answer meets: [`PathAnswer::tolerance`], also after [`is_free`](Self::is_free).
    pub fn met_tolerance(&self) -> f64 {
        self.search.met_tolerance()
    }

    /// Makes an answer of what the last search found, and measures the pair in contact.
    fn measured_answer(&mut self, goal: Goal) -> Result<PathAnswer<'c>, Error> {
        let found = self.search.result;
        let segments = self.search.segment_count();
        let end = PathPoint::from_path_position(segments as f64, segments);
        let limit = found.limit_reached;
        let (outcome, free_until) = match (goal, limit, found.nearest) {
            (Goal::LeastDistance, ..) => (self.measured_distance()?, PathPoint::START),
            (Goal::FirstContact, Some((limit, until)), _) => {
                let free_until = PathPoint::from_path_position(until, segments);
                (PathOutcome::unresolved_contact(limit), free_until)
            }
            (Goal::AnyContact, Some((limit, _)), None) => {
                (PathOutcome::unresolved_contact(limit), PathPoint::START)
            }
            (_, _, Some(nearest)) => {
                let contact = self.measure_contact(nearest)?;
                let is_first = goal == Goal::FirstContact;
                let free_until = if is_first {
                    contact.at
                } else {
                    PathPoint::START
                };
                (PathOutcome::Contact(contact), free_until)
            }
            (_, None, None) => (PathOutcome::Free, end),
        };
        Ok(PathAnswer {
            outcome,
            free_until,
            tolerance: self.search.met_tolerance(),
        })
    }

    /// Returns the bounds of the distance that the last search found.
    fn measured_distance(&mut self) -> Result<PathOutcome<'c>, Error> {
        let (lower, upper) = self.search.distance_bounds();
        let found = self.search.result;
        let nearest = found
            .nearest
            .map(|found| self.measure_contact(found))
            .transpose()?;
        Ok(match found.limit_reached {
            None => PathOutcome::LeastDistance {
                lower,
                upper,
                nearest,
            },
            Some((limit, _)) => PathOutcome::Unresolved(UnresolvedPath {
                limit,
                lower,
                upper,
                nearest,
            }),
        })
    }

    /// Searches a path.
    fn search<P: Path + ?Sized>(&mut self, goal: Goal, path: &P) -> Result<(), PathError> {
        if goal != Goal::LeastDistance && self.leaves_start() {
            self.set_path(path)?;
            return Ok(self.search.answer_leaving_start(goal)?);
        }
        self.set_path_reporting_start(path)?;
        let whole = self.search.whole_path_interval();
        Ok(self.search.answer_question(goal, whole)?)
    }

    /// Takes a path for questions that do not let contacts at the start go.
    fn set_path_reporting_start<P: Path + ?Sized>(&mut self, path: &P) -> Result<(), PathError> {
        if self.leaves_start() {
            return Err(PathError::UnsupportedSetting {
                setting: "the start policy `leave`: questions about the first or any contact do",
            });
        }
        self.set_path(path)
    }

    /// Takes a path for the questions that follow, if it fits the robot and the settings are valid.
    fn set_path<P: Path + ?Sized>(&mut self, path: &P) -> Result<(), PathError> {
        let settings = self.search.settings();
        settings.check().map_err(Error::from)?;
        if settings.clearance.is_some() {
            return Err(PathError::UnsupportedSetting {
                setting: "a clearance in its settings: the verdict of a closest approach takes one, and a cell those of pairs",
            });
        }
        self.search.begin(path)
    }

    fn leaves_start(&self) -> bool {
        self.search.settings().start_policy == StartPolicy::Leave
    }

    /// Measures a pair at a point of the path.
    fn measure_contact(&mut self, (at, pair): (f64, PartPair)) -> Result<PathContact<'c>, Error> {
        self.search.add_rounding_of_contact_point((at, pair));
        let bodies = pair.body_indices(self.cell.parts());
        let placement = self.search.place_frames(at);
        let rounding = 2.0 * placement.rounding;
        let (a, b) = (
            placement.body(self.cell, bodies[0])?,
            placement.body(self.cell, bodies[1])?,
        );
        // The deadline is for this, too: without witnesses a contact is a contact.
        self.distance_solver.set_settings(Settings {
            deadline: self.search.stop_condition.remaining(),
            contact_normals: ContactNormals::OfPieces,
            ..Settings::DEFAULT
        });
        let is_mesh = [a.0, b.0].map(|body| body.pieces().len() > 1);
        let outcome = self.distance_solver.distance(a, b)?.outcome;
        let hit = hit_of_distance(&outcome);
        let features = hit.and_then(|hit| hit.contact());
        let features = features.map(|contact| [contact.feature_a, contact.feature_b]);
        Ok(PathContact {
            at: PathPoint::from_path_position(at, self.search.segment_count()),
            items: bodies.map(|body| self.cell.item_of_body(body)),
            witnesses: hit.map(|hit| [hit.witness_a(), hit.witness_b()]),
            features: [0, 1].map(|k| features.filter(|_| is_mesh[k]).map(|features| features[k])),
            distance_bounds: match outcome {
                Outcome::Overlapping { .. } => [0.0; 2],
                _ => [
                    greater(outcome.lower() - rounding, 0.0),
                    outcome.upper() + rounding,
                ],
            },
        })
    }
}

/// Returns the nearest points of two bodies as a contact; two pieces that intersect if the bodies overlap.
fn hit_of_distance(outcome: &Outcome) -> Option<Hit> {
    let kind = match *outcome {
        Outcome::Overlapping { overlap, .. } => HitKind::Overlapping(overlap),
        _ => HitKind::Contact(outcome.nearest_contact()?.1),
    };
    Some(Hit { time: 0.0, kind })
}

#[cfg(test)]
pub(crate) mod tests;
