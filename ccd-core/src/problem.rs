//! Queries about two motions in normalised units, as schedules search them.

use crate::body::Body;
use crate::body::excess::ExcessSum;
use crate::body::piece::Piece;
use crate::error::{InputError, check};
use crate::limits::{MAX_COORDINATE, MAX_ROTATION_ANGLE};
use crate::math::order::{greater, lesser};
use crate::math::vector::{distance, length};
use crate::motion::Motion;
use crate::motion::path::Path;
use crate::rounding::{self, NODE_GAP_TOLERANCE_SHARE};
use crate::settings::{ContactNormals, QuerySettings, StartPolicy};
use crate::settings::{Shortcut, Shortcuts};
use crate::touching_plane::TouchingPlane;
use fearless_simd::Level;
use glam::DVec3;
use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// A query about two motions in normalised units: time runs from 0 to 1, and the origin is near both bodies.
#[derive(Clone, Debug)]
pub(crate) struct Problem<'a> {
    pub(crate) a: BodyWithPath<'a>,
    pub(crate) b: BodyWithPath<'a>,
    /// The time of the motions at clock 0; not 0 if the problem is a part of a longer one.
    start_time: f64,
    duration: f64,
    /// The origin of the problem's coordinates in the world, near both bodies.
    origin: DVec3,
    /// The tolerance of the answer: the requested one, or the least that can be certified in f64 at the scene's
    /// coordinates.
    pub(crate) tolerance: f64,
    pub(crate) margin: f64,
    /// The distance with which the query compares the closest approach, if it does.
    pub(crate) clearance: Option<f64>,
    pub(crate) start_policy: StartPolicy,
    /// The plane of the contact at the start, if that contact is to be ignored.
    pub(crate) touching_plane: Option<TouchingPlane>,
    pub(crate) budget: u64,
    pub(crate) deadline: Option<Duration>,
    pub(crate) contact_normals: ContactNormals,
    /// A flag that another thread sets to stop the query.
    pub(crate) stop_flag: Option<&'a AtomicBool>,
    /// A bound of the rounding of distances in f64, from [`rounding::distance_rounding`].
    pub(crate) rounding: f64,
    /// The vector instructions with which bounds of nodes are computed.
    pub(crate) simd_level: Level,
    pub(crate) shortcuts: Shortcuts,
}

/// One body and its path, in the problem's units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyWithPath<'a> {
    pub(crate) body: &'a Body,
    /// The body that the caller gave, if `body` is the surface that replaces it.
    pub(crate) given_body: Option<&'a Body>,
    pub(crate) path: Path,
}

/// One of the two bodies of a query, A or B.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WhichBody {
    A,
    B,
}

impl WhichBody {
    pub(crate) fn other(self) -> WhichBody {
        match self {
            WhichBody::A => WhichBody::B,
            WhichBody::B => WhichBody::A,
        }
    }

    pub(crate) fn body_in_problem<'p, 'a>(self, problem: &'p Problem<'a>) -> &'p BodyWithPath<'a> {
        match self {
            WhichBody::A => &problem.a,
            WhichBody::B => &problem.b,
        }
    }
}

impl<'a> Problem<'a> {
    /// Creates the problem of two bodies with constant velocities.
    ///
    /// # Errors
    /// The errors of [`Query::new`](crate::Query::new).
    pub(crate) fn new(
        bodies: [(&'a Body, Motion); 2],
        duration: f64,
        terms: &QuerySettings<'a>,
    ) -> Result<Self, InputError> {
        Problem::with_accelerations(bodies, [DVec3::ZERO; 2], duration, terms)
    }

    /// Creates the problem of two bodies whose centers may accelerate, for schedules that handle
    /// [accelerations](crate::engine::answer::EngineSchedule::handles_accelerations).
    pub(crate) fn with_accelerations(
        [a, b]: [(&'a Body, Motion); 2],
        accelerations: [DVec3; 2],
        duration: f64,
        terms: &QuerySettings<'a>,
    ) -> Result<Self, InputError> {
        terms.check(duration)?;
        let origin = b.1.start().translation();
        let side = |(given, motion): (&'a Body, Motion), other: &'a Body, acceleration: DVec3| {
            let body = given.body_for_query_against(other);
            let path = Path::new(&motion, origin, duration);
            BodyWithPath {
                body,
                given_body: (!std::ptr::eq(body, given)).then_some(given),
                path: path.with_acceleration(acceleration * duration * duration),
            }
        };
        for (_, motion) in [&a, &b] {
            check_coordinates("position", motion.start().translation())?;
            check_coordinates("center", motion.center())?;
        }
        let [of_a, of_b] = accelerations;
        let (a, b) = (side(a, b.0, of_a), side(b, a.0, of_b));
        for side in [&a, &b] {
            side.check()?;
        }
        let rounding = rounding::distance_rounding(
            [a.extent_with_center(), b.extent_with_center()],
            [a.path.angular_speed, b.path.angular_speed],
            distance(a.path.center_at(0.0), b.path.center_at(0.0))
                + a.path.speed_bound()
                + b.path.speed_bound()
                + terms.margin,
        );
        Ok(Problem {
            a,
            b,
            start_time: 0.0,
            duration,
            origin,
            tolerance: greater(terms.tolerance, rounding::least_tolerance(rounding)),
            margin: terms.margin,
            clearance: terms.clearance,
            start_policy: terms.start,
            touching_plane: None,
            budget: terms.budget,
            deadline: terms.deadline,
            contact_normals: terms.contact_normals,
            stop_flag: terms.stop,
            rounding,
            simd_level: terms.engine_options.vector_instructions.simd_level(),
            shortcuts: terms.engine_options.shortcuts,
        })
    }

    /// Returns the distance by which the caller's bodies may exceed their shapes.
    pub(crate) fn body_excess_sum(&self) -> ExcessSum {
        let given = |side: &BodyWithPath<'a>| side.given_body.unwrap_or(side.body);
        ExcessSum::sum_of_bodies(given(&self.a), given(&self.b))
    }

    /// Returns whether the query uses a shortcut.
    #[inline]
    pub(crate) fn uses_shortcut(&self, shortcut: Shortcut) -> bool {
        self.shortcuts.contains(shortcut)
    }

    /// Returns whether a body turns at least twice.
    #[inline]
    pub(crate) fn turns_at_least_twice(&self) -> bool {
        let turns = |side: &BodyWithPath<'_>| side.path.angular_speed >= 2.0 * TAU;
        turns(&self.a) || turns(&self.b)
    }

    /// Returns whether each body consists of a single piece.
    pub(crate) fn have_one_piece_each(&self) -> bool {
        let is_one = |side: &BodyWithPath<'_>| side.body.pieces().len() == 1;
        is_one(&self.a) && is_one(&self.b)
    }

    /// Returns piece `a` of A and piece `b` of B.
    pub(crate) fn pieces(&self, [a, b]: [u32; 2]) -> [Piece<'a>; 2] {
        let piece = |side: &BodyWithPath<'a>, k: u32| side.body.piece(k);
        [piece(&self.a, a), piece(&self.b, b)]
    }

    /// Returns the distance at which a pair is in contact: margin + tolerance.
    pub(crate) fn contact_distance(&self) -> f64 {
        self.margin + self.tolerance
    }

    /// Returns the gap that a pair is proven to keep until its clock: the margin plus half the tolerance. A pair whose
    /// contact at the start is ignored may keep less. A pair of pieces whose clock has run out is well within the
    /// tolerance.
    pub(crate) fn kept_gap(&self) -> f64 {
        self.margin + 0.5 * self.tolerance
    }

    /// Returns the gap at which the clock of a pair of nodes stops, unless rounding requires a larger gap. It is the
    /// same for nodes of all sizes, so that clocks that stop at a common contact stop together.
    pub(crate) fn kept_node_gap(&self) -> f64 {
        self.margin + NODE_GAP_TOLERANCE_SHARE * self.tolerance
    }

    /// Converts a time of the motions to a clock, up to rounding.
    pub(crate) fn clock_of_time(&self, time: f64) -> f64 {
        if self.duration > 0.0 {
            (time - self.start_time) / self.duration
        } else {
            0.0
        }
    }

    /// Returns the problem about the bodies as the caller gave them, if [`Body::body_for_query_against`] has replaced one
    /// by its triangulated surface; `None` if it replaced neither.
    pub(crate) fn with_given_bodies(&self) -> Option<Self> {
        let of = |side: &BodyWithPath<'a>| BodyWithPath {
            body: side.given_body.unwrap_or(side.body),
            given_body: None,
            path: side.path,
        };
        let looked_at = self.a.given_body.is_none() && self.b.given_body.is_none();
        (!looked_at).then(|| Problem {
            a: of(&self.a),
            b: of(&self.b),
            ..self.clone()
        })
    }

    /// Returns the problem with the policy that a contact at the start is the answer.
    pub(crate) fn reporting_start_contact(&self) -> Self {
        Problem {
            start_policy: StartPolicy::Report,
            ..self.clone()
        }
    }

    /// Returns the problem in which the contact at the start is ignored. `gap` is the distance beyond the margin there.
    /// Pairs that separate or slide keep more than half of that gap. If there is no useful gap, pairs of pieces in
    /// contact are ignored instead, and all pairs that touch in the plane of the contact.
    pub(crate) fn ignoring_start_contact(&self, gap: f64, touching: Option<TouchingPlane>) -> Self {
        let least = rounding::least_tolerance(self.rounding);
        let (tolerance, start, touching_plane) = if 0.5 * gap > least {
            (0.5 * gap, StartPolicy::Report, None)
        } else {
            (least, StartPolicy::Leave, touching)
        };
        Problem {
            start_policy: start,
            touching_plane,
            tolerance: lesser(tolerance, self.tolerance),
            ..self.clone()
        }
    }

    /// Returns the problem for measuring distances: with a margin of 0, and a contact at the start as an answer.
    pub(crate) fn for_distances(&self) -> Self {
        Problem {
            margin: 0.0,
            ..self.reporting_start_contact()
        }
    }

    /// Returns the problem of finding pairs nearer than `upper`, the least distance found. Pairs in contact are nearer
    /// than that by half of the tolerance, and pairs that keep the margin are within the tolerance of it. The rest in
    /// between is room for proofs.
    pub(crate) fn for_distances_below(&self, upper: f64) -> Self {
        let half = self
            .with_margin_and_tolerance(upper, 0.5 * self.tolerance)
            .tolerance;
        self.with_margin_and_tolerance(greater(0.0, upper - 2.0 * half), half)
    }

    /// Returns the problem with another margin and tolerance; the tolerance is raised to one that can be certified.
    pub(crate) fn with_margin_and_tolerance(&self, margin: f64, tolerance: f64) -> Self {
        // Distances may be off by more if they are measured beyond a margin.
        let rounding = self.rounding + rounding::margin_rounding(margin);
        Problem {
            margin,
            tolerance: greater(tolerance, rounding::least_tolerance(rounding)),
            rounding,
            ..self.clone()
        }
    }

    /// Returns the problem between two clocks, with the margin raised by a distance and with another tolerance.
    /// Positions are off by more than in the whole, see [`position_rounding`](rounding::position_rounding).
    pub(crate) fn between_clocks(&self, clocks: [f64; 2], raised: f64, tolerance: f64) -> Self {
        let of = |side: &BodyWithPath<'a>| BodyWithPath {
            path: side.path.subpath(clocks),
            ..*side
        };
        let [from, to] = clocks;
        let rounding = self.rounding + rounding::margin_rounding(raised);
        Problem {
            a: of(&self.a),
            b: of(&self.b),
            start_time: self.time_of_clock(from),
            // The duration is rounded down, so that no time is late.
            duration: self.duration * (to - from) * (1.0 - rounding::RATE_ERROR_F64),
            margin: (self.margin + raised).next_up(),
            tolerance: greater(tolerance, rounding::least_tolerance(rounding)),
            rounding,
            ..self.clone()
        }
    }

    /// Returns the distance that the bodies are proven to keep up to the least clock of all pairs.
    pub(crate) fn proven_gap(&self) -> f64 {
        match self.start_policy {
            StartPolicy::Report => self.kept_gap(),
            // Pieces that rest on each other keep no gap.
            StartPolicy::Leave => 0.0,
        }
    }

    /// Converts a clock, from 0 to 1 over the duration, to a time of the motions, rounded down.
    pub(crate) fn time_of_clock(&self, s: f64) -> f64 {
        if s >= 1.0 {
            self.start_time + self.duration
        } else {
            greater(
                self.start_time,
                (self.start_time + s * self.duration).next_down(),
            )
        }
    }

    /// Converts a point from the world's coordinates to the problem's.
    pub(crate) fn to_problem_point(&self, point: DVec3) -> DVec3 {
        point - self.origin
    }

    /// Converts a point from the problem's coordinates to the world's.
    pub(crate) fn to_world_point(&self, point: DVec3) -> DVec3 {
        point + self.origin
    }
}

impl BodyWithPath<'_> {
    /// Returns the index of a piece in the body that the caller gave.
    pub(crate) fn index_in_given_body(&self, piece: u32) -> u32 {
        if self.given_body.is_some() { 0 } else { piece }
    }

    /// Returns the span of the body plus twice the distance of its center of rotation from its origin.
    pub(crate) fn extent_with_center(&self) -> f64 {
        self.body.tree().max_distance_from_origin + 2.0 * length(self.path.center)
    }

    pub(crate) fn check(&self) -> Result<(), InputError> {
        let travel = self.path.speed_bound() + length(self.path.center_at(0.0));
        check(
            "travel",
            travel,
            travel <= MAX_COORDINATE,
            "at most 1e12 from the other body",
        )?;
        let turn = self.path.angular_speed;
        check(
            "turn",
            turn,
            turn <= MAX_ROTATION_ANGLE,
            "at most 1e6 radians",
        )
    }
}

/// Returns an error if a coordinate of a point is too large.
pub(crate) fn check_coordinates(what: &'static str, point: DVec3) -> Result<(), InputError> {
    let largest = point.abs().max_element();
    let allowed = "within 1e12 of 0 in every coordinate";
    check(what, largest, largest <= MAX_COORDINATE, allowed)
}

#[cfg(test)]
mod tests;
