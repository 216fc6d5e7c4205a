//! Proves that two parts stay apart over a stretch of time: the lemmas of the README.

use crate::Stop;
use crate::body::{Body, Part};
use crate::motion::{Links, Placed};
use crate::number::*;
use crate::reader::Reader;
use crate::way::Way;

/// A plane: the points x with normal · x = offset, as the normal, which is no longer than 1, and the offset.
pub(crate) type Plane = (Vector, i64);

/// A part of a body, and the link that carries it, with the way to that.
pub(crate) struct Side<'a> {
    pub(crate) mesh: &'a Body,
    pub(crate) part: Part,
    /// The point about which the link turns, off by less than 2.
    pub(crate) centre: Vector,
    pub(crate) link: &'a Placed,
    pub(crate) way: &'a Way,
}

pub(crate) fn read_plane(reader: &mut Reader<'_>) -> Result<Plane, Stop> {
    let [x, y, z, offset] = [(); 4].map(|()| reader.signed(7));
    let normal = [x?, y?, z?];
    reader.require(dot(normal, normal) <= 1 << 100, "a normal is longer than 1")?;
    Ok((normal.map(|x| x << (FRACTION - 50)), offset?))
}

/// Returns whether a plane stays between two parts over the whole stretch, farther than `least` from both. The ways are from what the
/// plane turns with.
pub(crate) fn is_between((normal, offset): Plane, [a, b]: [&Side<'_>; 2], links: &Links, least: i64) -> bool {
    is_above(a, (sub(ZERO, normal), -offset), links, least) && is_above(b, (normal, offset), links, least)
}

/// Returns whether a part stays farther than `least` above a plane: on the side to which its normal points.
fn is_above(&Side { mesh, part, centre, link, way }: &Side<'_>, (normal, offset): Plane, links: &Links, least: i64) -> bool {
    // Corners and centre are off by less than 2 each.
    let (middle, radius) = mesh.ball(part);
    let reach = length(sub(middle, centre)) + i128::from(radius) + 4;
    let bend = way.bend + up(way.factor, reach);
    let least = i128::from(least + offset) + bend / 2 + 1 + 8 * links.loss(reach);
    let least = least * i128::from(ONE) - dot(normal, way.arm);
    let (change, tilt) = (dot(normal, way.change), cross(normal, way.turn));
    // If nothing is known to move, both ends ask for the same: what may move yet is in what is lost.
    let ends: &[i64] = if (way.turn, way.change) == (ZERO, ZERO) { &[0] } else { &[-1, 1] };
    let to_mesh = transposed(&link.rotation);
    way.is_short()
        && ends.iter().all(|&end| {
            let direction = turned(&to_mesh, add(normal, tilt.map(|x| end * x)));
            mesh.is_above(part, direction, least - i128::from(end) * change + dot(direction, centre))
        })
}

/// Returns whether a part stays farther than a margin from a ball around another one over the whole stretch. The way is from the
/// part's link, with which the ball turns, to that of the other one.
pub(crate) fn is_beyond_ball(side: &Side<'_>, around: &Side<'_>, links: &Links, margin: i64) -> bool {
    let (way, (middle, radius)) = (around.way, around.mesh.ball(around.part));
    let arm = turned(&around.link.rotation, sub(middle, around.centre));
    let reach = length(arm);
    let loss = links.loss(reach);
    let travel = length(add(way.change, cross(way.turn, arm))) + (way.bend + up(way.factor, reach + loss)) / 2 + 1;
    let point = add(side.centre, turned(&transposed(&side.link.rotation), add(way.arm, arm)));
    let limit = i128::from(radius + margin) + travel + 8 * loss;
    way.is_short() && limit < 1 << 60 && side.mesh.is_beyond(side.part, point, limit as i64)
}
