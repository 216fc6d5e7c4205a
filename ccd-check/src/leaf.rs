//! Proves that two parts stay apart over a stretch of time, along one axis: Lemmas 1 and 2 of the README.

use crate::body::Part;
use crate::motion::Placed;
use crate::number::{FRACTION, ONE, Point, cross, dot, product, up};
use crate::statement::Carried;
use crate::way::Way;
use core::ops::Neg;

/// Returns whether an axis, no longer than 1, keeps two parts farther apart than `least` over the whole stretch. The ways are
/// from what the axis turns with.
pub(crate) fn keeps_apart(
    (bodies, parts): ([&Carried<'_>; 2], [Part; 2]),
    (links, ways): (&[Placed], [&Way; 2]),
    axis: Point,
    least: i128,
) -> bool {
    let (one, [a, b]) = (i128::from(ONE.mid[0]), ways);
    let [arm, change] = [b.arm - a.arm, b.change - a.change];
    let [middle, moved] = [arm, change].map(|v| dot(axis, v.mid));
    let lost = i128::from(arm.rad + change.rad) * one;
    let mut gaps = [middle - moved - lost, middle + moved - lost];
    let mut bend = a.bend + b.bend;
    for (k, facing) in [axis.map(i64::neg), axis].into_iter().enumerate() {
        let (body, way, part) = (bodies[k], ways[k], parts[k]);
        if !way.is_short() {
            return false;
        }
        // Corners and centre are off by less than 2 each.
        let reach = body.mesh.reach(part, body.centre) + 4;
        // A direction is no longer than 3. It is off by turn.rad and a rounding, and in the link's frame by 3 times what the
        // rotation is off by, and another rounding.
        let to_mesh = links[body.link].rotation.transposed();
        let lost = product(way.turn.rad + 3 * to_mesh.rad + 4, reach) + 12 * one;
        let height = |v: Point| body.mesh.least_height(part, to_mesh.turned(v), body.centre) - lost;
        let tilt = cross(facing, way.turn.mid).map(|x| (x >> FRACTION) as i64);
        let first = height([0, 1, 2].map(|i| facing[i] - tilt[i]));
        let last = if tilt == [0; 3] { first } else { height([0, 1, 2].map(|i| facing[i] + tilt[i])) };
        gaps = [gaps[0] + first, gaps[1] + last];
        bend += up(way.factor, reach.into());
    }
    gaps.iter().all(|gap| gap >> FRACTION > least + bend / 2 + 1)
}
