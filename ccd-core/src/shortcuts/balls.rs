//! Proves bodies apart that are far from each other all the time, by two balls on straight paths.
//!
//! A path with a constant acceleration is within an eighth of that acceleration from the straight path between its
//! ends.

use crate::math::vector::length;
use crate::problem::{Problem, Side};
use crate::rounding::RATE_F64;
use glam::DVec3;

/// Returns whether bounding balls prove the bodies farther apart than the contact distance at all times.
///
/// Most pairs of a simulation or of a plan are proven apart by this test, in a few tens of nanoseconds.
///
/// # Guarantee
/// The result is true only for bodies that are never in contact, up to the tolerance.
pub(crate) fn keep_apart(problem: &Problem<'_>) -> bool {
    // Written so that NaN is within reach.
    least_distance(problem) > problem.contact_distance()
}

/// Returns a lower bound of the distance of the bodies at all times, by bounding balls; negative if the balls meet.
pub(crate) fn least_distance(problem: &Problem<'_>) -> f64 {
    let (a, b) = (Ball::around_body(&problem.a), Ball::around_body(&problem.b));
    let distance =
        least_length(b.centre - a.centre, b.velocity - a.velocity) - deviation_from_line(problem);
    // The rounding of a distance of bodies is more than that of the positions of their balls. Twice that is more than
    // the rounding of this distance, too.
    distance - a.radius - b.radius - 2.0 * problem.rounding
}

/// Returns how far the vector between the balls' centres may be off a linear function of time, because of
/// accelerations.
fn deviation_from_line(problem: &Problem<'_>) -> f64 {
    0.125 * length(problem.b.path.acceleration - problem.a.path.acceleration) * (1.0 + RATE_F64)
}

/// Returns the clock at which the bounding balls are nearest to each other.
pub(crate) fn nearest_clock(problem: &Problem<'_>) -> f64 {
    let (a, b) = (Ball::around_body(&problem.a), Ball::around_body(&problem.b));
    least_at(b.centre - a.centre, b.velocity - a.velocity)
}

/// A ball on a straight path that contains a body at all times.
struct Ball {
    /// The position of the centre at the start.
    centre: DVec3,
    velocity: DVec3,
    radius: f64,
}

impl Ball {
    fn around_body(side: &Side<'_>) -> Self {
        let (centre, radius) = side.body.tree().bounding_ball();
        let path = &side.path;
        // The body's turning moves the centre along an arc: by at most its length, and by at most the diameter.
        let turned = match path.rate {
            rate if rate < 2.0 => rate,
            _ => 2.0,
        };
        Ball {
            centre: path.start_of(centre),
            velocity: path.velocity + 0.5 * path.acceleration,
            radius: radius + turned * centre.distance(path.centre),
        }
    }
}

/// Returns the least length of `from + s · change` over `s` from 0 to 1.
fn least_length(from: DVec3, change: DVec3) -> f64 {
    length(from + change * least_at(from, change))
}

/// Returns the `s` from 0 to 1 at which `from + s · change` is shortest.
fn least_at(from: DVec3, change: DVec3) -> f64 {
    let square = change.length_squared();
    if square > 0.0 {
        (-from.dot(change) / square).clamp(0.0, 1.0)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests;
