//! Whether one body lies inside the other where their surfaces are apart.

use crate::body::{Body, Volume};
use crate::outcome::Overlap;
use crate::pose::Frame;
use crate::problem::{Problem, Side};
use crate::tree::crossings;
use glam::DVec3;

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

/// Directions of rays, in no special relation to anything: when one grazes an edge, the next one is
/// tried.
const RAYS: [DVec3; 4] = [
    DVec3::new(0.5366, 0.3712, 0.7579),
    DVec3::new(-0.6142, 0.7731, 0.1586),
    DVec3::new(0.2237, -0.8423, 0.4905),
    DVec3::new(-0.3921, -0.2844, -0.8748),
];

/// Whether the closed triangles of a body wind about a point in its frame; none when the point is on
/// the surface, or too near to it to tell.
fn contains(body: &Body, point: DVec3) -> Option<bool> {
    if !body.tree().may_contain(point) {
        return Some(false);
    }
    RAYS.iter()
        .find_map(|&ray| crossings(body.tree(), body.pieces(), point, ray))
        .map(|windings| windings != 0)
}

#[cfg(test)]
mod tests;
