//! Proves bodies apart that stay far from each other, by two balls on straight paths or by one fixed plane between two
//! boxes.
//!
//! A path with a constant acceleration is within an eighth of that acceleration from the straight path between its
//! ends.

use super::placed::{ApproachRateBounds, PlacedNode, center_approach_rate};
use crate::answer::Outcome;
use crate::math::order::{greater, lesser};
use crate::math::vector::{length, unit};
use crate::problem::{BodyWithPath, Problem};
use crate::rounding::RATE_ERROR_F64;
use crate::settings::Shortcut;
use crate::tuning::ALTERNATING_PROJECTION_COUNT;
use glam::DVec3;

/// Returns the outcome if bounding balls or boxes prove the bodies apart for the whole duration.
pub(crate) fn free_outcome_by_bounding_volumes(problem: &Problem<'_>) -> Option<Outcome> {
    let by_balls = problem.uses_shortcut(Shortcut::Balls) && balls_keep_apart(problem);
    let is_free = by_balls || problem.uses_shortcut(Shortcut::Boxes) && boxes_keep_apart(problem);
    is_free.then(|| Outcome::Free {
        proven_gap: problem.proven_gap(),
    })
}

/// Returns whether bounding balls prove the bodies farther apart than the contact distance at all times.
///
/// Most pairs of a simulation or of a plan are proven apart by this test, in a few tens of nanoseconds.
///
/// # Guarantee
/// The result is true only for bodies that are never in contact, up to the tolerance.
fn balls_keep_apart(problem: &Problem<'_>) -> bool {
    // Written so that NaN is within reach.
    least_distance(problem) > problem.contact_distance()
}

/// Returns a lower bound of the distance of the bodies at all times, by bounding balls; negative if the balls meet.
pub(crate) fn least_distance(problem: &Problem<'_>) -> f64 {
    let (a, b) = (
        MovingBall::around_body(&problem.a),
        MovingBall::around_body(&problem.b),
    );
    let distance = origin_distance_to_segment(b.center - a.center, b.velocity - a.velocity)
        - deviation_from_line_bound(problem);
    // The rounding of a distance of bodies is more than that of the positions of their balls. Twice that is more than
    // the rounding of this distance, too.
    distance - a.radius - b.radius - 2.0 * problem.rounding
}

/// Returns a bound of the deviation of the vector between the balls' centers from a linear function of time, due to
/// accelerations.
fn deviation_from_line_bound(problem: &Problem<'_>) -> f64 {
    0.125
        * length(problem.b.path.acceleration - problem.a.path.acceleration)
        * (1.0 + RATE_ERROR_F64)
}

/// Returns the clock at which the bounding balls are nearest to each other.
pub(crate) fn clock_of_nearest_balls(problem: &Problem<'_>) -> f64 {
    let (a, b) = (
        MovingBall::around_body(&problem.a),
        MovingBall::around_body(&problem.b),
    );
    least_length_parameter(b.center - a.center, b.velocity - a.velocity)
}

/// A ball that moves on a straight path and contains a body at all times, up to the effect of its acceleration.
struct MovingBall {
    /// The position of the ball's center at the start.
    center: DVec3,
    velocity: DVec3,
    radius: f64,
}

impl MovingBall {
    fn around_body(side: &BodyWithPath<'_>) -> Self {
        let (center, radius) = side.body.tree().bounding_ball();
        let path = &side.path;
        // The body's turning moves the center along an arc: by at most its length, and by at most the diameter.
        let turned = match path.angular_speed {
            rate if rate < 2.0 => rate,
            _ => 2.0,
        };
        MovingBall {
            center: path.point_at_start(center),
            velocity: path.velocity + 0.5 * path.acceleration,
            radius: radius + turned * center.distance(path.center),
        }
    }
}

/// Returns the least length of `from + s · change` over `s` from 0 to 1.
fn origin_distance_to_segment(from: DVec3, change: DVec3) -> f64 {
    length(from + change * least_length_parameter(from, change))
}

/// Returns the `s` from 0 to 1 at which `from + s · change` is shortest.
fn least_length_parameter(from: DVec3, change: DVec3) -> f64 {
    let square = change.length_squared();
    if square > 0.0 {
        (-from.dot(change) / square).clamp(0.0, 1.0)
    } else {
        0.0
    }
}

/// Returns whether one fixed plane separates both bounding boxes by more than the contact distance for the whole
/// duration. The plane is perpendicular to the offset between the boxes' nearest points, to the offset between their
/// centers when these pass each other, or to an axis of a box.
///
/// # Guarantee
/// The result is true only for bodies that are never in contact, up to the tolerance, nor inside each other.
fn boxes_keep_apart(problem: &Problem<'_>) -> bool {
    // The search proves two single pieces apart as fast by itself.
    if problem.have_one_piece_each() {
        return false;
    }
    let [a, b] = [&problem.a, &problem.b].map(|side| PlacedNode::body_box(side, 0.0));
    // Repeated projection from one box to the other converges to the nearest points.
    let (mut on_a, mut on_b) = (a.center, b.center);
    for _ in 0..ALTERNATING_PROJECTION_COUNT {
        on_a = a.nearest_point(on_b);
        on_b = b.nearest_point(on_a);
    }
    let nearest = unit(on_b - on_a);
    let passing = unit(offset_at_closest_approach(problem, [&a, &b]));
    let ways = [nearest, passing].into_iter().flatten();
    // Between adjacent faces the offset is mostly rounding, but it is perpendicular to the faces.
    let along = ways
        .clone()
        .flat_map(|way| [&a, &b].map(|whole| whole.box_axis_nearest_to(way)));
    ways.chain(along)
        .any(|n| plane_keeps_apart(problem, [&a, &b], n))
}

/// Returns the vector between the boxes' centers at their closest approach, as if both kept their velocities at the
/// start.
fn offset_at_closest_approach(problem: &Problem<'_>, [a, b]: [&PlacedNode; 2]) -> DVec3 {
    let way = b.center - a.center;
    let velocity =
        problem.b.path.velocity_at(b.center, 0.0) - problem.a.path.velocity_at(a.center, 0.0);
    let nearest = -way.dot(velocity) / velocity.length_squared();
    // Without a velocity there is no such time.
    way + velocity * greater(0.0, lesser(nearest, 1.0))
}

/// Returns whether a fixed plane perpendicular to the unit vector `n` keeps the boxes apart for the whole duration.
fn plane_keeps_apart(problem: &Problem<'_>, [a, b]: [&PlacedNode; 2], n: DVec3) -> bool {
    let gap = n.dot(b.center - a.center) - a.extent_along(n) - b.extent_along(-n);
    let excess = gap - problem.contact_distance() - 2.0 * problem.rounding;
    // Written so that NaN proves nothing. Most planes fail at the first two conditions, which cost the least: no bound
    // of the approach is below that of the centers, unless the bodies accelerate away from each other.
    let away = problem.a.path.acceleration - problem.b.path.acceleration;
    let of_centers = center_approach_rate(problem, [a, b], n, 0.0) + lesser(0.0, n.dot(away));
    excess > 0.0
        && of_centers <= excess
        && ApproachRateBounds::approach_rate_bounds_along_axis(problem, [a, b], n, 0.0)
            .free_time(excess)
            >= 1.0
}

#[cfg(test)]
mod tests;
