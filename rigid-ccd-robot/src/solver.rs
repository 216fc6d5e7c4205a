//! Questions about paths: a robot moves through configurations, or along a curve.

mod boxes;
mod clearance_ranges;
mod constant_step;
mod curved_link;
pub(crate) mod displacement;
mod distance_curve;
mod engine;
mod exact;
pub(crate) mod joint_path;
pub(crate) mod kinematics;
mod limits;
pub(crate) mod magnitude;
pub(crate) mod measure;
mod open_pairs;
pub(crate) mod pair_chain;
pub(crate) mod part_pairs;
mod periods;
pub(crate) mod placement;
pub(crate) mod rounding;
mod search;
mod stretch;
pub(crate) mod violation;

pub use clearance_ranges::{ClearanceRange, RangeSettings};
pub use distance_curve::DistanceRange;

use crate::cell::{Cell, Item};
use crate::error::PathError;
use crate::path::Path;
use crate::path_point::PathPoint;
use ccd_core::order::greater;
use part_pairs::PartPair;
use rigid_ccd::answer::{ClearanceVerdict, Feature, HitKind, Limit, Unresolved};
use rigid_ccd::glam::DVec3;
use rigid_ccd::{ContactNormals, Error, Hit, Outcome, Settings, Solver, StartPolicy};
use search::Search;

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
/// does each stretch that is examined for [clearance ranges](Self::clearance_ranges). A budget may end a search at a contact that
/// is later, within the tolerance of what is asked for, than the one that a larger budget finds.
///
/// Under the start policy [`Leave`](StartPolicy::Leave), questions about the first or any contact let go of pairs in contact at the
/// start, as two bodies do: such a pair may part or slide, but not come nearer nor sink. One with a gap keeps half of it from then on;
/// one without may sink by what rounding hides and by a millionth of the tolerance, and touches again when it comes back. A pair that
/// begins nearer than its margin keeps the distance that it began with. One that overlaps is a contact, and so is one
/// without a gap that slides along other ways than straight ones: [`Cell::allow_contact`] allows that.
pub struct CellSolver<'c> {
    cell: &'c Cell,
    search: Search<'c>,
    distance_solver: Solver,
}

/// A pair of a cell at a point of a path, where it is in contact or nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathContact<'c> {
    /// Where on the path. Nothing touches before the first contact.
    pub at: PathPoint,
    /// The pair; a link or an attached body comes first.
    pub items: [Item<'c>; 2],
    /// The nearest points of both, in the frame of the base. If both overlap they are points of two pieces that intersect. `None`
    /// if the deadline passes before they are found.
    pub witnesses: Option<[DVec3; 2]>,
    /// The vertex, edge or face of each mesh that its witness is on, numbered as in the body. `None` for a convex body, whose
    /// mesh may be its hull, and if one body is inside the other.
    pub features: [Option<Feature>; 2],
    /// Bounds of the distance of the pair there, the rounding of computed poses included; 0 if both overlap.
    pub distance_bounds: [f64; 2],
}

/// The first contact on a path, if there is one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathOutcome<'c> {
    /// Nothing touches on the whole path.
    Free,
    /// A pair touches; the path is free before.
    Contact(PathContact<'c>),
    /// A limit was reached before the answer was known.
    Unresolved {
        /// The path is free before this point.
        free_until: PathPoint,
        /// The limit.
        limit: Limit,
    },
}

/// Bounds of the least distance on a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosestApproach<'c> {
    /// A lower bound of the distance of all pairs at all points of the path.
    pub lower: f64,
    /// An upper bound of the least distance; infinite if no distance was measured.
    pub upper: f64,
    /// The nearest pair that was found; `None` if no pair was measured.
    pub nearest: Option<PathContact<'c>>,
    /// The limit that ended the search; `None` if the bounds differ by the tolerance.
    pub limit: Option<Limit>,
}

impl ClosestApproach<'_> {
    /// Returns whether all pairs stay at least the required distance apart, as far as the bounds tell.
    ///
    /// Pairs that may touch keep no clearance, not even a clearance of 0.
    pub fn clearance_verdict(&self, required: f64) -> ClearanceVerdict {
        if self.lower >= required && self.lower > 0.0 {
            ClearanceVerdict::Kept
        } else if self.upper < required || self.upper <= 0.0 {
            ClearanceVerdict::Violated
        } else {
            ClearanceVerdict::Unverified
        }
    }
}

/// A question about a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Question {
    AnyContact,
    FirstContact,
    ClosestApproach,
}

impl Cell {
    /// Returns a solver for paths in this cell. It keeps memory from one question to the next.
    pub fn solver(&self) -> CellSolver<'_> {
        CellSolver {
            cell: self,
            search: Search::new(self),
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

    /// Returns the tolerance that the last answer meets. It is that of the settings, unless the rounding of positions allows only
    /// a larger one: far from the base, or after thousands of turns.
    ///
    /// A contact is within this distance beyond the margin. The bounds of a closest approach differ by at most as much, and by what
    /// the nearest bodies [exceed](rigid_ccd::Body::excess) their shapes by, unless a limit is reached. Both hold to within a
    /// thousandth of the tolerance. That nothing touches holds without any tolerance.
    pub fn met_tolerance(&self) -> f64 {
        self.search.met_tolerance()
    }

    /// Returns whether the robot touches nothing on a path, itself included.
    ///
    /// # Guarantee
    /// On a free path all pairs that are checked stay apart by more than the margin. On other paths a pair comes within
    /// margin + [tolerance](Self::met_tolerance).
    ///
    /// # Errors
    /// [`PathError`]; also if a limit is reached.
    pub fn is_free<P: Path + ?Sized>(&mut self, path: &P) -> Result<bool, PathError> {
        Ok(self.find_any_contact(path)?.is_none())
    }

    /// Returns any contact on a path, perhaps not the first one. Limits may change which one.
    ///
    /// # Errors
    /// [`PathError`]; also if a limit is reached.
    pub fn any_contact<P: Path + ?Sized>(
        &mut self,
        path: &P,
    ) -> Result<Option<PathContact<'c>>, PathError> {
        let found = self.find_any_contact(path)?;
        Ok(found.map(|found| self.measure_contact(found)).transpose()?)
    }

    /// Returns the first contact on a path: the last free point, and what touches there.
    ///
    /// # Guarantee
    /// All pairs that are checked stay apart by more than the margin before that point. There the pair is within
    /// margin + [tolerance](Self::met_tolerance).
    ///
    /// # Errors
    /// [`PathError`].
    pub fn first_contact<P: Path + ?Sized>(
        &mut self,
        path: &P,
    ) -> Result<PathOutcome<'c>, PathError> {
        self.answer(Question::FirstContact, path)?;
        let found = &self.search.result;
        Ok(match (found.limit_reached, found.nearest) {
            (Some((limit, until)), _) => PathOutcome::Unresolved {
                free_until: PathPoint::from_path_position(until, self.search.segment_count()),
                limit,
            },
            (None, Some(nearest)) => PathOutcome::Contact(self.measure_contact(nearest)?),
            (None, None) => PathOutcome::Free,
        })
    }

    /// Returns how near any pair that is checked comes to touching on a path. The margin, paddings and clearances play no
    /// role.
    ///
    /// # Guarantee
    /// No pair is ever nearer than the lower bound, and the nearest one comes at least as near as the upper bound. They
    /// differ by at most the [tolerance](Self::met_tolerance), and by what the nearest bodies
    /// [exceed](rigid_ccd::Body::excess) their shapes by, unless a limit is reached.
    ///
    /// # Errors
    /// [`PathError`].
    pub fn closest_approach<P: Path + ?Sized>(
        &mut self,
        path: &P,
    ) -> Result<ClosestApproach<'c>, PathError> {
        self.answer(Question::ClosestApproach, path)?;
        Ok(self.found_approach()?)
    }

    /// Returns the bounds that the last search for a closest approach found.
    fn found_approach(&mut self) -> Result<ClosestApproach<'c>, Error> {
        let (lower, upper) = self.search.distance_bounds();
        let found = self.search.result;
        Ok(ClosestApproach {
            lower,
            upper,
            nearest: found
                .nearest
                .map(|found| self.measure_contact(found))
                .transpose()?,
            limit: found.limit_reached.map(|(limit, _)| limit),
        })
    }

    fn find_any_contact<P: Path + ?Sized>(
        &mut self,
        path: &P,
    ) -> Result<Option<(f64, PartPair)>, PathError> {
        self.answer(Question::AnyContact, path)?;
        let found = &self.search.result;
        if found.nearest.is_none()
            && let Some((limit, _)) = found.limit_reached
        {
            let unresolved = Unresolved::from_safe_until(0.0, limit);
            return Err(Error::from(unresolved).into());
        }
        Ok(found.nearest)
    }

    fn answer<P: Path + ?Sized>(&mut self, question: Question, path: &P) -> Result<(), PathError> {
        if question != Question::ClosestApproach && self.leaves_start() {
            self.set_path(path)?;
            return Ok(self.search.answer_leaving_start(question)?);
        }
        self.set_path_reporting_start(path)?;
        let whole = self.search.whole_path_stretch();
        Ok(self.search.answer_question(question, whole)?)
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
        let bodies = pair.body_numbers(self.cell.parts());
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
