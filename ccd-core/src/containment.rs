//! Whether one body lies inside the other where their surfaces are apart.

use crate::body::{Body, Volume};
use crate::outcome::Overlap;
use crate::pose::Frame;
use crate::problem::{Problem, Side};
use glam::DVec3;
use std::f64::consts::TAU;

/// A point of one body that is inside the other one's solid at the start.
///
/// To be asked when no two pieces intersect at the start: then a connected part of one body is
/// inside the other as a whole, or not at all, and one point of it tells.
pub(crate) fn at_start(problem: &Problem<'_>) -> Option<Overlap> {
    let frames = [problem.a.path.frame(0.0), problem.b.path.frame(0.0)];
    let inside = |outer: &Side<'_>, outer_frame: &Frame, inner: &Side<'_>, inner_frame: &Frame| {
        if outer.body.volume() == Volume::Surface || !outer.body.pieces().all_triangles() {
            return None;
        }
        let points = inner.body.shells().iter().map(|&p| inner_frame.point(p));
        let mut inside = points.filter(|&p| contains(outer.body, outer_frame.inverse_point(p)));
        inside.next().map(|p| problem.world(p))
    };
    let [a, b] = &frames;
    inside(&problem.b, b, &problem.a, a)
        .map(Overlap::AInsideB)
        .or_else(|| inside(&problem.a, a, &problem.b, b).map(Overlap::BInsideA))
}

/// Whether the closed triangles of a body wind about a point in its frame: the sum of the solid
/// angles that they are seen under is a multiple of a full sphere, and zero only outside.
fn contains(body: &Body, point: DVec3) -> bool {
    if !body.tree().may_contain(point) {
        return false;
    }
    let angle: f64 = (0..body.pieces().len())
        .map(|k| solid_angle(body.pieces().triangle(k), point))
        .sum();
    // Full sphere 4π; anything beyond half of one is inside.
    angle.abs() > TAU
}

/// The signed solid angle of a triangle seen from a point `[OOSTEROM83]`.
fn solid_angle(triangle: [DVec3; 3], from: DVec3) -> f64 {
    let [a, b, c] = triangle.map(|p| p - from);
    let [la, lb, lc] = [a.length(), b.length(), c.length()];
    let numerator = a.dot(b.cross(c));
    let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * numerator.atan2(denominator)
}
