//! Handles pieces that touch while the plane of the contact at the start keeps them apart. An inner edge of flat ground
//! is therefore no obstacle.

use super::placed_pair::PlacedPair;
use super::planes::SeparatingPlane;
use crate::answer::{Contact, Separation};
use crate::body::facing::Facing;
use crate::distance::oracle::DistanceOracle;
use crate::distance::separation::sharp::improve_axis;
use crate::engine::meter::Meter;
use crate::math::order::greater;
use crate::motion::free_time::FreeTime;
use crate::problem::{Problem, WhichBody};
use crate::rounding::MIN_APPROACH_PER_ROUNDING;
use crate::touching_plane::TouchingPlane;
use crate::tuning::RESTING_SLACK_PER_ROUNDING;
use glam::DVec3;

/// The state of a [`TouchingPlane`] that keeps two pieces apart: the body with which it moves, and the least gap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TouchingPlaneState {
    /// The body with which the plane moves.
    plane_body: WhichBody,
    /// The gap along the plane's normal below which the pieces count as approaching.
    min_gap: f64,
}

impl TouchingPlane {
    /// Creates the plane perpendicular to the normal of a contact at the start; `None` if the bodies may overlap along
    /// it.
    pub(crate) fn from_contact<O: DistanceOracle>(
        problem: &Problem<'_>,
        contact: &Contact,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> Option<Self> {
        let given = problem.with_given_bodies();
        let problem = given.as_ref().unwrap_or(problem);
        let placed = PlacedPair::new(problem, [contact.piece_a, contact.piece_b], 0.0);
        let [frame_a, frame_b] = &placed.frames;
        let Separation {
            mut normal,
            upper,
            witness_a,
            ..
        } = contact.separation;
        let from = frame_a.inverse_transform_point(problem.to_problem_point(witness_a));
        let resting = MIN_APPROACH_PER_ROUNDING * problem.rounding;
        // Not from the witnesses, which far from the world's origin are rounded by more.
        let distance = upper - problem.rounding;
        let mut gap = placed.gap_along_normal(normal, from);
        // A tilted normal loses some of the distance. A rotation may undo the tilt, and so hide that the bodies approach.
        if gap < distance - 0.5 * resting
            && let Some(checked) = placed.query_oracle(oracle, &mut O::Cache::default(), meter)
        {
            let better = improve_axis(&placed.pieces, &checked, problem.rounding);
            if better.lower > gap {
                (normal, gap) = (frame_a.rotation * better.axis, better.lower);
            }
        }
        // Written so that NaN is an overlap.
        (gap >= -resting).then(|| TouchingPlane {
            normals: [frame_a, frame_b].map(|frame| frame.inverse_transform_vector(normal)),
            required_gap: greater(gap, distance) - resting,
        })
    }
}

impl PlacedPair<'_> {
    /// Chooses the body with which the touching plane moves, so that it keeps two pieces apart for longest; `None` if
    /// it does so with neither. The heights of pieces are measured from a point in A's frame.
    ///
    /// A piece that stays on its side of a plane does not pass into a piece on the other side, whatever edges are
    /// between the faces there.
    pub(crate) fn choose_plane_state(
        &self,
        plane: &TouchingPlane,
        ids: [u32; 2],
        from: DVec3,
    ) -> Option<TouchingPlaneState> {
        let resting = MIN_APPROACH_PER_ROUNDING * self.problem.rounding;
        let of = |plane_body: WhichBody| {
            let normal = self.plane_normal(plane_body)?;
            let gap = self.gap_along_normal(normal, from);
            let level = TouchingPlaneState {
                plane_body,
                min_gap: greater(plane.required_gap, gap - resting),
            };
            self.is_plane_between_solids(ids, normal, from)
                .then_some(level)
        };
        [WhichBody::A, WhichBody::B]
            .into_iter()
            .filter_map(of)
            .map(|level| (self.touching_plane_free_time(&level, from), level))
            .filter(|(free, _)| *free > FreeTime::NONE)
            .reduce(|one, other| if other.0 > one.0 { other } else { one })
            .map(|(_, level)| level)
    }

    /// Returns a time for which the pieces certainly do not approach along the plane's normal.
    pub(crate) fn touching_plane_free_time(
        &self,
        level: &TouchingPlaneState,
        from: DVec3,
    ) -> FreeTime {
        let Some(normal) = self.plane_normal(level.plane_body) else {
            return FreeTime::NONE;
        };
        let slack = self.gap_along_normal(normal, from) - level.min_gap;
        // Written so that NaN counts as no slack.
        if slack > RESTING_SLACK_PER_ROUNDING * self.problem.rounding {
            self.plane_free_time(&SeparatingPlane {
                normal,
                gap_excess: slack,
            })
        } else {
            FreeTime::NONE
        }
    }

    /// Returns the normal of the plane that moves with a body, in the problem's coordinates.
    fn plane_normal(&self, plane_body: WhichBody) -> Option<DVec3> {
        let [in_a, in_b] = self.problem.touching_plane.as_ref()?.normals;
        let [frame_a, frame_b] = &self.frames;
        Some(match plane_body {
            WhichBody::A => frame_a.rotation * in_a,
            WhichBody::B => frame_b.rotation * in_b,
        })
    }

    /// Returns the gap of the pieces along a unit vector in the problem's coordinates, minus rounding.
    fn gap_along_normal(&self, normal: DVec3, from: DVec3) -> f64 {
        self.gap_along(self.frames[0].inverse_transform_vector(normal), from)
    }

    /// Returns whether the plane with this normal has the solids of the two pieces on different sides. Two pieces that
    /// both lie in the plane are apart on either side of it, wherever the solids are.
    fn is_plane_between_solids(&self, [a, b]: [u32; 2], normal: DVec3, from: DVec3) -> bool {
        let in_one_plane = self.gap_along_normal(-normal, from)
            >= -2.0 * MIN_APPROACH_PER_ROUNDING * self.problem.rounding;
        if !in_one_plane {
            return true;
        }
        let [frame_a, frame_b] = &self.frames;
        let is_ahead = |out: DVec3| out.dot(normal) > 0.0;
        let Problem {
            a: of_a, b: of_b, ..
        } = self.problem;
        match (of_a.body.facing(a), of_b.body.facing(b)) {
            // The side to keep to is unknown.
            (Facing::Unclear, _) | (_, Facing::Unclear) => false,
            (Facing::NoOutwardSide, Facing::NoOutwardSide) => false,
            // Solids on the same side slide along the plane.
            (Facing::OutwardNormal(n), Facing::OutwardNormal(m)) => {
                is_ahead(frame_a.rotation * n) || is_ahead(frame_b.rotation * -m)
            }
            (Facing::OutwardNormal(n), Facing::NoOutwardSide) => is_ahead(frame_a.rotation * n),
            (Facing::NoOutwardSide, Facing::OutwardNormal(m)) => is_ahead(frame_b.rotation * -m),
        }
    }
}

#[cfg(test)]
mod tests;
