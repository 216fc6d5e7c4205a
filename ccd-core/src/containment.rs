//! Whether one body lies inside the other where their surfaces are apart.

use crate::body::Body;
use crate::order::greater;
use crate::outcome::Overlap;
use crate::pose::Frame;
use crate::problem::{Problem, Side};
use crate::tolerance::{BELOW_SURFACE, INSIDE_SAMPLES};
use crate::tree::crossings;
use glam::DVec3;

/// A point of one body that is inside the other one's solid at the start.
///
/// To be asked when no two pieces intersect at the start: then a connected part of one body is
/// inside the other as a whole, or not at all, and one point of it tells that is not itself on the
/// other's surface.
pub(crate) fn at_start(problem: &Problem<'_>) -> Option<Overlap> {
    of_either(problem, |outer, inner| {
        inner.body.shells().iter().find_map(|shell| {
            let mut points = shell.iter().map(|&p| inner.frame.point(p));
            points
                .find_map(|p| Some((p, outer.contains(p)?)))
                .filter(|&(_, inside)| inside)
                .map(|(p, _)| p)
        })
    })
}

/// The same for bodies whose surfaces touch: a part of which every corner is on the other's surface
/// may be inside all the same, so that points just below its surface are asked as well.
pub(crate) fn of_touching(problem: &Problem<'_>) -> Option<Overlap> {
    at_start(problem).or_else(|| {
        of_either(problem, |outer, inner| {
            let count = inner.body.pieces().len();
            (0..count)
                .step_by(count.div_ceil(INSIDE_SAMPLES))
                .map(|piece| inner.frame.point(below_surface(inner.body, piece)))
                .find(|&p| outer.contains(p) == Some(true))
        })
    })
}

/// A point of a piece, moved a little into the solid that it bounds.
fn below_surface(body: &Body, piece: usize) -> DVec3 {
    let points = body.pieces().get(piece).points;
    let mean = points.iter().sum::<DVec3>() / points.len() as f64;
    let size = points.iter().map(|p| p.distance(mean)).fold(0.0, greater);
    match body.outward_normal(piece as u32) {
        Some(normal) => mean - normal * (BELOW_SURFACE * size),
        None => mean,
    }
}

/// A body where it is at the start.
struct Placed<'a> {
    body: &'a Body,
    frame: Frame,
}

impl Placed<'_> {
    fn of<'a>(side: &Side<'a>) -> Placed<'a> {
        Placed {
            body: side.body,
            frame: side.path.frame(0.0),
        }
    }

    fn contains(&self, point: DVec3) -> Option<bool> {
        contains(self.body, self.frame.inverse_point(point))
    }
}

/// Looks for a point of one body inside the other one's solid, both ways; the first argument is the
/// outer body.
fn of_either(
    problem: &Problem<'_>,
    point_inside: impl Fn(&Placed<'_>, &Placed<'_>) -> Option<DVec3>,
) -> Option<Overlap> {
    let (a, b) = (Placed::of(&problem.a), Placed::of(&problem.b));
    let inside = |outer: &Placed<'_>, inner: &Placed<'_>| {
        let point = outer
            .body
            .may_be_hollow()
            .then(|| point_inside(outer, inner))?;
        point.map(|p| problem.world(p))
    };
    inside(&b, &a)
        .map(Overlap::AInsideB)
        .or_else(|| inside(&a, &b).map(Overlap::BInsideA))
}

/// Directions of rays, in no special relation to anything: when one grazes an edge, the next one is
/// tried.
const RAYS: [DVec3; 4] = [
    DVec3::new(0.5366, 0.3712, 0.7579),
    DVec3::new(-0.6142, 0.7731, 0.1586),
    DVec3::new(0.2237, -0.8423, 0.4905),
    DVec3::new(-0.3921, -0.2844, -0.8748),
];

/// Whether the closed faces of a body wind about a point in its frame; none when the point is on
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
