//! Whether one body lies inside the other where their surfaces are apart.

use crate::body::{Body, Volume};
use crate::outcome::Overlap;
use crate::pose::Frame;
use crate::problem::{Problem, Side};
use crate::tolerance::WINDING;
use glam::DVec3;
use std::f64::consts::TAU;

/// A point of one body that is inside the other one's solid at the start.
///
/// To be asked when no two pieces intersect at the start: then a connected part of one body is
/// inside the other as a whole, or not at all, and one point of it tells that is not itself on the
/// other's surface.
pub(crate) fn at_start(problem: &Problem<'_>) -> Option<Overlap> {
    let frames = [problem.a.path.frame(0.0), problem.b.path.frame(0.0)];
    let inside = |outer: &Side<'_>, outer_frame: &Frame, inner: &Side<'_>, inner_frame: &Frame| {
        if outer.body.volume() == Volume::Surface || !outer.body.pieces().all_triangles() {
            return None;
        }
        inner.body.shells().iter().find_map(|shell| {
            let mut points = shell.iter().map(|&p| inner_frame.point(p));
            points
                .find_map(|p| Some((p, contains(outer.body, outer_frame.inverse_point(p))?)))
                .filter(|&(_, inside)| inside)
                .map(|(p, _)| problem.world(p))
        })
    };
    let [a, b] = &frames;
    inside(&problem.b, b, &problem.a, a)
        .map(Overlap::AInsideB)
        .or_else(|| inside(&problem.a, a, &problem.b, b).map(Overlap::BInsideA))
}

/// Whether the closed triangles of a body wind about a point in its frame: the sum of the solid
/// angles that they are seen under is a multiple of a full sphere, and zero only outside.
///
/// None when the point is on the surface, or too near to it to tell.
fn contains(body: &Body, point: DVec3) -> Option<bool> {
    if !body.tree().may_contain(point) {
        return Some(false);
    }
    let angle: f64 = (0..body.pieces().len())
        .map(|k| solid_angle(body.pieces().triangle(k), point))
        .sum();
    let turns = angle / (2.0 * TAU);
    let whole = turns.round();
    ((turns - whole).abs() < WINDING).then_some(whole != 0.0)
}

/// The signed solid angle of a triangle seen from a point `[OOSTEROM83]`.
fn solid_angle(triangle: [DVec3; 3], from: DVec3) -> f64 {
    let [a, b, c] = triangle.map(|p| p - from);
    let [la, lb, lc] = [a.length(), b.length(), c.length()];
    let numerator = a.dot(b.cross(c));
    let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * numerator.atan2(denominator)
}
