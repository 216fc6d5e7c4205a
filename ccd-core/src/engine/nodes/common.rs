//! Values that all pairs of nodes of a query share.

use crate::body::tree::round_up_to_f32;
use crate::math::order::{greater, lesser};
use crate::math::vector::{distance, length};
use crate::motion::relative::RelativePath;
use crate::problem::{BodyWithPath, Problem, WhichBody};
use crate::rounding::{ARM_INCREASE_PER_DISTANCE, LEAST_GAP_F32, RATE_ERROR_F32};
use crate::settings::Shortcut;
use crate::tuning::{CLOSED_GAP_TOLERANCE_SHARE, MIN_TURNING_PLANE_RADIUS_RATIO};
use glam::Vec3;
use std::cell::OnceCell;

/// A problem, with the values in f32 that the bounds of all its pairs of nodes use.
#[derive(Debug)]
pub(crate) struct NodeContext<'p> {
    pub(crate) problem: &'p Problem<'p>,
    /// The motion of B relative to A, and of A relative to B. Each is computed at the first split of its body: queries
    /// of a few pieces need neither.
    relative_paths: [OnceCell<RelativePath>; 2],
    /// What moves.
    pub(crate) motion: QueryMotion,
    /// The angular velocities of A and of B.
    spins: [Spin; 2],
    /// The gap `Problem::kept_gap` that every pair of nodes keeps until its clock, rounded up.
    pub(crate) kept_gap: f32,
    /// The gap `Problem::kept_node_gap`, rounded up. The clock of a pair of nodes stops at this gap, or at the sum of
    /// `kept_gap` and the rounding, whichever is larger.
    pub(crate) guaranteed_node_gap: f32,
    /// A bound of the rounding of distances in f64, rounded up.
    pub(crate) rounding: f32,
    /// A bound of the rounding of closing rates.
    pub(crate) rate_allowance: f32,
    /// The excess of a gap over the slack up to which the gap counts as closed.
    pub(crate) closed_gap_threshold: f32,
    /// The ratio of radii above which a node counts as much larger than another.
    pub(crate) much_larger_ratio: f32,
}

/// Returns an upper bound of the speeds from which closing rates are computed. The rounding of the positions of arms
/// adds a share.
fn speed_bound(a: &BodyWithPath<'_>, b: &BodyWithPath<'_>) -> f64 {
    let straight = length(b.path.velocity - a.path.velocity)
        + length(b.path.acceleration - a.path.acceleration);
    let turning = |own: &BodyWithPath<'_>, other: &BodyWithPath<'_>| {
        // An arm is the difference of two positions, each rounded at its place, as seen from a group of the other
        // body. That group is in a ball which moves straight, and turns with its body.
        let (ball, radius) = other.body.tree().bounding_ball();
        let turned = lesser(other.path.angular_speed, 2.0) * ball.distance(other.path.center);
        let start = distance(other.path.point_at_start(ball), own.path.center_at(0.0));
        let places = 2.0 * (start + straight + turned + 4.0 * radius) + reach(own);
        own.path.angular_speed * (reach(own) + ARM_INCREASE_PER_DISTANCE * places)
    };
    straight + turning(a, b) + turning(b, a)
}

/// Returns an upper bound of the distances of a body's nodes from its center of rotation. The points of a node are
/// within the diameter of the whole body from the node's center, and that is in a cube around the body.
fn reach(side: &BodyWithPath<'_>) -> f64 {
    let (center, radius) = side.body.tree().bounding_ball();
    center.distance(side.path.center) + 4.0 * radius
}

impl<'p> NodeContext<'p> {
    pub(crate) fn new(problem: &'p Problem<'_>) -> Self {
        NodeContext {
            problem,
            relative_paths: [const { OnceCell::new() }; 2],
            motion: QueryMotion::of(problem),
            spins: [&problem.a.path, &problem.b.path].map(|path| Spin {
                angular_velocity: path.local_angular_velocity.as_vec3(),
                angular_speed: round_up_to_f32(path.angular_speed),
            }),
            kept_gap: round_up_to_f32(problem.kept_gap()),
            guaranteed_node_gap: round_up_to_f32(problem.kept_node_gap()),
            rounding: round_up_to_f32(problem.rounding),
            rate_allowance: RATE_ERROR_F32 * round_up_to_f32(speed_bound(&problem.a, &problem.b)),
            closed_gap_threshold: greater(
                LEAST_GAP_F32,
                (CLOSED_GAP_TOLERANCE_SHARE * problem.tolerance) as f32,
            ),
            much_larger_ratio: if problem.uses_shortcut(Shortcut::TurningNodes) {
                MIN_TURNING_PLANE_RADIUS_RATIO
            } else {
                f32::INFINITY
            },
        }
    }

    /// Returns the motion of the other body relative to this one.
    #[inline(always)]
    pub(crate) fn relative_path_from(&self, body: WhichBody) -> &RelativePath {
        let path = |body: WhichBody| &body.body_in_problem(self.problem).path;
        self.relative_paths[body as usize]
            .get_or_init(|| RelativePath::new(path(body), path(body.other())))
    }

    /// Returns the angular velocity of a body.
    #[inline(always)]
    pub(crate) fn spin(&self, body: WhichBody) -> &Spin {
        &self.spins[body as usize]
    }
}

/// What the bodies of a query do beside moving straight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum QueryMotion {
    NeitherTurns,
    OneTurns(WhichBody),
    BothTurn,
    /// One center accelerates relative to the other; the bodies may turn or not.
    Accelerates,
}

impl QueryMotion {
    fn of(problem: &Problem<'_>) -> Self {
        let (a, b) = (&problem.a.path, &problem.b.path);
        if a.acceleration != b.acceleration {
            return QueryMotion::Accelerates;
        }
        match (a.is_turning(), b.is_turning()) {
            (false, false) => QueryMotion::NeitherTurns,
            (true, false) => QueryMotion::OneTurns(WhichBody::A),
            (false, true) => QueryMotion::OneTurns(WhichBody::B),
            (true, true) => QueryMotion::BothTurn,
        }
    }
}

/// The angular velocity of a body in f32.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spin {
    /// The angular velocity in the body's own frame.
    pub(crate) angular_velocity: Vec3,
    /// The angular speed, rounded up; 0 for a body that does not turn.
    pub(crate) angular_speed: f32,
}

impl Spin {
    #[inline(always)]
    pub(crate) fn is_turning(&self) -> bool {
        self.angular_speed > 0.0
    }
}

#[cfg(test)]
mod tests;
