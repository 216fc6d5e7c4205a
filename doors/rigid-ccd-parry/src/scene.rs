//! The engine's query for a cast, and the conversion of its answer to a hit.

use crate::horizon::QueryDuration;
use crate::interval::Interval;
use crate::order::lesser;
use crate::tolerance::NEAREST_POINTS_BUDGET;
use crate::{BodyOfShape, CastError};
use ccd_core::glam::DVec3;
use ccd_core::{Answer, Contact, Motion, Outcome, Overlap, Pose, Settings, Solidity};
use rigid_ccd::Solver;

/// Two moving bodies and the distance at which they are in contact.
#[derive(Clone, Debug)]
pub(crate) struct Scene<'a> {
    pub(crate) bodies: [&'a BodyOfShape; 2],
    /// The motions from the start of the interval on, without rotations that have no effect.
    pub(crate) motions: [Motion; 2],
    /// The full motions, with all rotations; the points and normals of a hit are in the frames that these motions move.
    pub(crate) frame_motions: [Motion; 2],
    pub(crate) horizon: QueryDuration,
    pub(crate) interval: Interval,
    /// The distance at which the bodies are in contact, in the scene's unit of length.
    pub(crate) target_distance: f64,
    pub(crate) settings: Settings,
}

/// The result of a cast that found a contact or reached a limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CastHit {
    pub(crate) time: f64,
    /// The nearest points of the shapes, each in its body's frame.
    pub(crate) witnesses: [DVec3; 2],
    /// Two unit normals: each points from its own body towards the other, and is in its own body's frame.
    pub(crate) normals: [DVec3; 2],
    /// The indices of the nearest sub-shapes.
    pub(crate) sub_shape_indices: [u32; 2],
    pub(crate) status: CastStatus,
}

/// Why a cast ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CastStatus {
    /// The bodies come into contact after the start.
    Contact,
    /// Two pieces overlap at the start.
    Overlap,
    /// One body is inside the other at the start.
    Inside,
    /// The distance at the start is below the target distance.
    WithinTargetAtStart,
    /// A limit of work or time was reached, with no contact before.
    Limit,
}

impl Scene<'_> {
    /// Finds the first contact, or the limit that ended the search, as a hit of the cast; `None` if the bodies stay
    /// apart during the whole cast.
    pub(crate) fn first_contact(&self, solver: &mut Solver) -> Result<Option<CastHit>, CastError> {
        let [a, b] = [0, 1].map(|k| (self.bodies[k].body(), self.motions[k]));
        solver.set_settings(self.settings.clone());
        let answer = solver.first_contact(a, b, self.horizon.duration())?;
        Ok(self.hit_from_answer(&answer, solver))
    }

    /// Returns whether overlapping bodies may be ignored while they separate: both must move in straight lines, and neither
    /// may be a solid of many pieces.
    pub(crate) fn may_ignore_overlap(&self) -> bool {
        let is_straight = |motion: &Motion| motion.angular_velocity() == DVec3::ZERO;
        // A body inside a solid mesh may overlap no piece from which it could separate.
        let has_no_inside = |body: &&BodyOfShape| {
            let body = body.body();
            body.pieces().len() == 1 || body.solidity() == Solidity::Surface
        };
        self.motions.iter().all(is_straight) && self.bodies.iter().all(has_no_inside)
    }

    fn hit_from_answer(&self, answer: &Answer, solver: &mut Solver) -> Option<CastHit> {
        match answer.outcome {
            Outcome::Contact { time, contact } => {
                Some(self.hit_from_contact(time, &contact, CastStatus::Contact))
            }
            Outcome::Touching { contact } => {
                let is_within_target =
                    self.target_distance > 0.0 && contact.separation.upper <= self.target_distance;
                let status = if is_within_target {
                    CastStatus::WithinTargetAtStart
                } else {
                    CastStatus::Contact
                };
                Some(self.hit_from_contact(0.0, &contact, status))
            }
            Outcome::Overlapping { overlap, .. } => Some(match overlap {
                Overlap::Pieces(contact) => {
                    self.hit_from_contact(0.0, &contact, CastStatus::Overlap)
                }
                Overlap::AInsideB(point) | Overlap::BInsideA(point) => self.hit_when_inside(point),
            }),
            Outcome::Unresolved(known) => Some(self.search_hit_at_limit(known.safe_until, solver)),
            // A first contact has no other outcomes.
            Outcome::Free { .. } | Outcome::Interval { .. } | Outcome::LeastDistance { .. } => {
                match self.horizon {
                    QueryDuration::WholeCast(_) => None,
                    QueryDuration::PartOfCast(duration) => {
                        Some(self.search_hit_at_limit(duration, solver))
                    }
                }
            }
        }
    }

    /// Converts a contact at a time offset from the start to a hit, with points and normals in the bodies' frames.
    fn hit_from_contact(&self, offset: f64, contact: &Contact, status: CastStatus) -> CastHit {
        let separation = &contact.separation;
        let points = [separation.witness_a, separation.witness_b];
        let normals = [separation.normal, -separation.normal];
        let poses = self.poses(offset);
        CastHit {
            time: self.interval.cast_time_at_offset(offset),
            witnesses: [0, 1].map(|k| poses[k].inverse().transform_point(points[k])),
            normals: [0, 1].map(|k| poses[k].rotation().conjugate() * normals[k]),
            sub_shape_indices: [
                self.bodies[0].sub_shape_index(contact.piece_a),
                self.bodies[1].sub_shape_index(contact.piece_b),
            ],
            status,
        }
    }

    /// Returns the hit for one body inside the other at the start; `point` is a common point in the world frame.
    fn hit_when_inside(&self, point: DVec3) -> CastHit {
        let witnesses = self
            .poses(0.0)
            .map(|pose| pose.inverse().transform_point(point));
        CastHit {
            witnesses,
            ..CastHit::hit_without_points(self.interval.start, CastStatus::Inside)
        }
    }

    /// Returns the hit for a limit reached at a time offset from the start, with the nearest points if they can be found.
    fn search_hit_at_limit(&self, offset: f64, solver: &mut Solver) -> CastHit {
        solver.set_settings(Settings {
            budget: lesser(self.settings.budget, NEAREST_POINTS_BUDGET),
            deadline: self.settings.deadline,
            ..Settings::DEFAULT
        });
        let poses = self.poses(offset);
        let [a, b] = [0, 1].map(|k| (self.bodies[k].body(), poses[k]));
        let contact = match solver.distance(a, b).map(|answer| answer.outcome) {
            Ok(Outcome::Overlapping {
                overlap: Overlap::Pieces(contact),
                ..
            }) => Some(contact),
            Ok(outcome) => outcome.nearest_contact().map(|(_, contact)| contact),
            Err(_) => None,
        };
        match contact {
            Some(contact) => self.hit_from_contact(offset, &contact, CastStatus::Limit),
            None => CastHit::hit_without_points(
                self.interval.cast_time_at_offset(offset),
                CastStatus::Limit,
            ),
        }
    }

    fn poses(&self, offset: f64) -> [Pose; 2] {
        self.frame_motions.map(|motion| motion.pose(offset))
    }
}

impl CastHit {
    /// Returns a hit without nearest points. The points and normals are the placeholders that parry uses.
    fn hit_without_points(time: f64, status: CastStatus) -> Self {
        CastHit {
            time,
            witnesses: [DVec3::ZERO; 2],
            normals: [DVec3::X; 2],
            sub_shape_indices: [0; 2],
            status,
        }
    }
}

#[cfg(test)]
mod tests;
