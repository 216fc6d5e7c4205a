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
    (links, ways): (&[Placed], [Way; 2]),
    axis: Point,
    least: i128,
) -> bool {
    let (one, [a, b]) = (i128::from(ONE.mid[0]), ways);
    let [arm, change] = [b.arm - a.arm, b.change - a.change];
    // What is unknown has no bound: its radius is none.
    if !(arm.is_known() && change.is_known()) {
        return false;
    }
    let [middle, moved] = [arm, change].map(|v| dot(axis, v.mid));
    let lost = i128::from(arm.rad + change.rad) * one;
    // At both ends of the stretch what the heights of A and B have to add up to, but for what follows.
    let mut missing = [lost - middle + moved, lost - middle - moved];
    let (mut bend, mut directions) = (a.bend + b.bend, [[[0; 3]; 2]; 2]);
    for (k, facing) in [axis.map(i64::neg), axis].into_iter().enumerate() {
        let (body, way) = (bodies[k], ways[k]);
        if !way.is_short() {
            return false;
        }
        // Corners and centre are off by less than 2 each.
        let reach = body.mesh.reach(parts[k], body.centre) + 4;
        // The true direction is no longer than √5. It is known to within turn.rad and a rounding, and in the link's frame 3 times
        // what the rotation is off by more, and another rounding.
        let to_mesh = links[body.link].rotation.transposed();
        let lost = product(way.turn.rad + 3 * to_mesh.rad + 4, reach) + 12 * one;
        let tilt = cross(facing, way.turn.mid).map(|x| (x >> FRACTION) as i64);
        directions[k] = [-1, 1].map(|s| to_mesh.turned([0, 1, 2].map(|i| facing[i] + s * tilt[i])));
        missing = [0, 1].map(|end| missing[end] + lost + dot(directions[k][end], body.centre));
        bend += up(way.factor, reach.into());
    }
    let Ok(least) = i64::try_from(least + bend / 2 + 1) else {
        return false;
    };
    let ([mesh_a, mesh_b], [part_a, part_b], [of_a, of_b]) = (bodies.map(|body| body.mesh), parts, directions);
    [0, 1].into_iter().all(|end| {
        let needed = missing[end] + i128::from(least) * one + 1;
        let [bound_a, bound_b] = [mesh_a.lower_bound(part_a, of_a[end]), mesh_b.lower_bound(part_b, of_b[end])];
        // A is looked at no more closely than needed where the box of B is, and B where A has been found.
        bound_a + bound_b >= needed || {
            let height = mesh_a.least_height(part_a, of_a[end], needed - bound_b);
            mesh_b.least_height(part_b, of_b[end], needed - height) == needed - height
        }
    })
}
