//! Proves two bodies apart by one fixed plane between their bounding boxes.

use super::approach::{Approach, straight};
use super::placed::Placed;
use crate::math::order::{greater, lesser};
use crate::math::vector::unit;
use crate::problem::{Problem, Side};
use crate::tuning::BOX_PROJECTIONS;
use glam::DVec3;

/// Returns whether one fixed plane separates both bounding boxes by more than the contact distance for the whole
/// duration. The plane is perpendicular to the offset between the boxes' nearest points, to the offset between their
/// centres when these pass each other, or to an axis of a box.
///
/// # Guarantee
/// The result is true only for bodies that are never in contact, up to the tolerance, nor inside each other.
pub(crate) fn keep_apart(problem: &Problem<'_>) -> bool {
    let whole = |side: &Side<'_>| side.body.tree().piece(0).is_some();
    // The search proves two single pieces apart as fast by itself.
    if whole(&problem.a) && whole(&problem.b) {
        return false;
    }
    let [a, b] = [&problem.a, &problem.b].map(|side| Placed::body_box(side, 0.0));
    // Repeated projection from one box to the other converges to the nearest points.
    let (mut on_a, mut on_b) = (a.centre, b.centre);
    for _ in 0..BOX_PROJECTIONS {
        on_a = a.project(on_b);
        on_b = b.project(on_a);
    }
    let nearest = unit(on_b - on_a);
    let passing = unit(offset_at_closest_approach(problem, [&a, &b]));
    let ways = [nearest, passing].into_iter().flatten();
    // Between adjacent faces the offset is mostly rounding, but it is perpendicular to the faces.
    let along = ways
        .clone()
        .flat_map(|way| [&a, &b].map(|whole| whole.axis_along(way)));
    ways.chain(along).any(|n| keeps_apart(problem, [&a, &b], n))
}

/// Returns the vector between the centres when they are nearest, if they keep their velocities at the start.
fn offset_at_closest_approach(problem: &Problem<'_>, [a, b]: [&Placed; 2]) -> DVec3 {
    let way = b.centre - a.centre;
    let velocity =
        problem.b.path.velocity_at(b.centre, 0.0) - problem.a.path.velocity_at(a.centre, 0.0);
    let nearest = -way.dot(velocity) / velocity.length_squared();
    // Without a velocity there is no such time.
    way + velocity * greater(0.0, lesser(nearest, 1.0))
}

/// Returns whether a fixed plane perpendicular to a unit vector keeps the boxes apart.
fn keeps_apart(problem: &Problem<'_>, [a, b]: [&Placed; 2], n: DVec3) -> bool {
    let gap = n.dot(b.centre - a.centre) - a.extent_along(n) - b.extent_along(-n);
    let excess = gap - problem.contact_distance() - 2.0 * problem.rounding;
    // Written so that NaN proves nothing. Most planes fail at the first two conditions, which cost the least: no bound
    // of the approach is below that of the centres, unless the bodies accelerate away from each other.
    let away = problem.a.path.acceleration - problem.b.path.acceleration;
    let of_centres = straight(problem, [a, b], n, 0.0) + lesser(0.0, n.dot(away));
    excess > 0.0
        && of_centres <= excess
        && Approach::along(problem, [a, b], n, 0.0).free_time(excess) >= 1.0
}
