//! Answers questions about paths: a robot moves through configurations, or along a curve.

pub(crate) mod ball_test;
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
use std::fmt;

/// Answers questions about paths in a cell.
///
/// A [`Path`] is a slice of configurations, between which all joints move at constant rates, or a
/// [`JointCurve`](crate::JointCurve).
///
/// # Settings
/// The margin is the distance at which bodies count as touching. Settings with a clearance are refused. The kind of
/// contact normals has no effect.
///
/// A deadline applies to a whole question. A [budget](rigid_ccd::Settings::budget) applies to each query of two bodies
/// that the solver leaves to the engine. In total, a question may use 8 budgets for each segment of its path, and a
/// closest approach up to 12. The total includes the pairs that the solver measures itself. Each of these takes less
/// than a microsecond. Each range of a [distance curve](Self::distance_curve) counts as a question, and so does each interval
/// that [clearance ranges](Self::clearance_ranges) examine. A smaller budget may lead to a slightly later contact,
/// still within the tolerance.
///
/// # Contacts at the start
/// Under the start policy [`Leave`](StartPolicy::Leave), questions about the first or any contact ignore contacts at
/// the start as long as the bodies separate or slide, as in queries of two bodies:
///
/// - A pair with a gap must keep half of its gap at the start.
/// - A pair without a gap may come nearer by rounding errors and a millionth of the tolerance. If it separates and
///   touches again, that is a contact. If it slides along a curved path, it soon counts as a contact; use
///   [`Cell::allow_contact`] for such a pair.
/// - A pair within its margin must not come nearer than at the start.
/// - A pair that overlaps is a contact.
pub struct CellSolver<'c> {
    cell: &'c Cell,
    search: PathSearch<'c>,
    distance_solver: Solver,
}

/// The goal of a search along a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Goal {
    AnyContact,
    FirstContact,
    LeastDistance,
}

impl fmt::Debug for CellSolver<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("CellSolver")
            .field("settings", self.search.settings())
            .finish_non_exhaustive()
    }
}

impl Cell {
    /// Returns a solver for paths in this cell. The solver reuses its memory from question to question.
    pub fn solver(&self) -> CellSolver<'_> {
        CellSolver {
            cell: self,
            search: PathSearch::new(self),
            distance_solver: Solver::new(),
        }
    }
}

impl<'c> CellSolver<'c> {
    /// Sets the settings of the following questions.
    #[must_use]
    pub fn with_settings(mut self, settings: Settings) -> Self {
        self.set_settings(settings);
        self
    }

    /// Allocates memory and builds joint chains that questions would otherwise create on first use. Answers stay the
    /// same. For predictable times, call this function and then let the solver answer a few questions.
    pub fn prepare(&mut self) {
        self.search.prepare();
    }

    /// Changes the settings of the following questions.
    pub fn set_settings(&mut self, settings: Settings) {
        self.search.set_settings(settings);
    }

    /// Returns whether no checked pair touches on a path. Does not measure the contact.
    ///
    /// # Guarantee
    /// On a free path all checked pairs stay farther apart than the margin. On any other path some pair comes within
    /// margin + [tolerance](PathAnswer::tolerance).
    ///
    /// # Errors
    /// [`PathError`], also if a limit is reached.
    pub fn is_free<P: Path + ?Sized>(&mut self, path: &P) -> Result<bool, PathError> {
        self.search(Goal::AnyContact, path)?;
        let result = &self.search.result;
        match (result.nearest, result.limit_reached) {
            (Some(_), _) => Ok(false),
            (None, None) => Ok(true),
            (None, Some((limit, _))) => {
                Err(Error::from(Unresolved::from_safe_until(0.0, limit)).into())
            }
        }
    }

    /// Returns any contact on a path, not necessarily the first. Which one depends on the limits.
    ///
    /// # Errors
    /// [`PathError`].
    pub fn any_contact<P: Path + ?Sized>(&mut self, path: &P) -> Result<PathAnswer<'c>, PathError> {
        self.answer(Question::AnyContact, path)
    }

    /// Returns the first contact on a path: the touching pair, and the last point before which the path is free.
    ///
    /// # Guarantee
    /// Before that point all checked pairs stay farther apart than the margin. At that point the reported pair is
    /// within margin + [tolerance](PathAnswer::tolerance).
    ///
    /// # Errors
    /// [`PathError`].
    pub fn first_contact<P: Path + ?Sized>(
        &mut self,
        path: &P,
    ) -> Result<PathAnswer<'c>, PathError> {
        self.answer(Question::FirstContact, path)
    }

    /// Returns the least distance of any checked pair on a path. Margins, paddings and clearances have no effect.
    ///
    /// # Guarantee
    /// No checked pair is ever nearer than the lower bound. The nearest pair comes at least as near as the upper
    /// bound. The bounds differ by at most the [tolerance](PathAnswer::tolerance) plus the
    /// [excess](rigid_ccd::Body::excess) of both nearest bodies, unless a limit is reached.
    ///
    /// # Errors
    /// [`PathError`].
    pub fn closest_approach<P: Path + ?Sized>(
        &mut self,
        path: &P,
    ) -> Result<PathAnswer<'c>, PathError> {
        self.answer(Question::ClosestApproach, path)
    }

    /// Answers a question that is chosen at run time. It must be one of [`QUESTIONS`](Self::QUESTIONS).
    ///
    /// # Errors
    /// [`PathError`], also for other questions.
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

    /// The questions that can be asked about a path.
    pub const QUESTIONS: [Question; 3] = [
        Question::AnyContact,
        Question::FirstContact,
        Question::ClosestApproach,
    ];

    /// Returns the tolerance of the last answer, see [`PathAnswer::tolerance`]. Also available after
    /// [`is_free`](Self::is_free).
    pub fn met_tolerance(&self) -> f64 {
        self.search.met_tolerance()
    }

    /// Converts the result of the last search to an answer. Measures the pair in contact.
    fn measured_answer(&mut self, goal: Goal) -> Result<PathAnswer<'c>, Error> {
        let result = self.search.result;
        let segments = self.search.segment_count();
        let end = PathPoint::from_path_position(segments as f64, segments);
        let limit = result.limit_reached;
        let (outcome, free_until) = match (goal, limit, result.nearest) {
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

    /// Returns the distance bounds of the last search as an outcome.
    fn measured_distance(&mut self) -> Result<PathOutcome<'c>, Error> {
        let (lower, upper) = self.search.distance_bounds();
        let result = self.search.result;
        let nearest = result
            .nearest
            .map(|found| self.measure_contact(found))
            .transpose()?;
        Ok(match result.limit_reached {
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

    /// Sets a path, and searches it.
    fn search<P: Path + ?Sized>(&mut self, goal: Goal, path: &P) -> Result<(), PathError> {
        if goal != Goal::LeastDistance && self.leaves_start() {
            self.set_path(path)?;
            return Ok(self.search.answer_leaving_start(goal)?);
        }
        self.set_path_reporting_start(path)?;
        let whole = self.search.whole_path_interval();
        Ok(self.search.answer_question(goal, whole)?)
    }

    /// Sets the path of questions that do not support the start policy `leave`.
    fn set_path_reporting_start<P: Path + ?Sized>(&mut self, path: &P) -> Result<(), PathError> {
        if self.leaves_start() {
            return Err(PathError::UnsupportedSetting {
                setting: "the start policy `leave`; only questions about the first or any contact do",
            });
        }
        self.set_path(path)
    }

    /// Sets the path of the following questions, if it fits the robot and the settings are valid.
    fn set_path<P: Path + ?Sized>(&mut self, path: &P) -> Result<(), PathError> {
        let settings = self.search.settings();
        settings.check().map_err(Error::from)?;
        if settings.clearance.is_some() {
            return Err(PathError::UnsupportedSetting {
                setting: "a clearance in its settings; set clearances of pairs in the cell, or compare a closest approach with one",
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
        // The deadline applies here, too. If it passes, the contact is reported without witnesses.
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

/// Returns the nearest points of two bodies as a contact, or the intersecting pieces of overlapping bodies.
fn hit_of_distance(outcome: &Outcome) -> Option<Hit> {
    let kind = match *outcome {
        Outcome::Overlapping { overlap, .. } => HitKind::Overlapping(overlap),
        _ => HitKind::Contact(outcome.nearest_contact()?.1),
    };
    Some(Hit { time: 0.0, kind })
}

#[cfg(test)]
pub(crate) mod tests;
