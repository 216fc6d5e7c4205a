//! Proves that a part stays on one side of a plane over a stretch of time: Lemmas 1 and 2 of the README.

use crate::body::Part;
use crate::motion::Placed;
use crate::number::{FRACTION, ONE, Point, cross, dot, product, up};
use crate::statement::Carried;
use crate::way::Way;

/// A plane: the points x with normal · x = offset, where the normal is no longer than 1.
#[derive(Clone, Copy)]
pub(crate) struct Plane {
    pub(crate) normal: Point,
    pub(crate) offset: i64,
}

impl Plane {
    pub(crate) fn reversed(self) -> Plane {
        Plane { normal: self.normal.map(|x| -x), offset: -self.offset }
    }

    /// Returns whether a part stays farther than `least` from the plane, on the side to which its normal points, over the whole
    /// stretch. The way is from what the plane turns with.
    pub(crate) fn keeps(self, (body, part): (&Carried<'_>, Part), link: &Placed, way: &Way, least: i64) -> bool {
        // What is unknown has no bound: its radius is none.
        if !(way.arm.is_known() && way.change.is_known() && way.is_short()) {
            return false;
        }
        let (one, turns) = (i128::from(ONE.mid[0]), way.turn.mid);
        // Corners and centre are off by less than 2 each.
        let reach = body.mesh.reach(part, body.centre) + 4;
        let bend = way.bend + up(way.factor, reach.into());
        let Ok(least) = i64::try_from(i128::from(least) + i128::from(self.offset) + bend / 2 + 1) else {
            return false;
        };
        // The direction n ± n×Ω is no longer than 3. It is known to within turn.rad, and 2 for its shift; in the link's frame to
        // within 3 times what the rotation is off by more, and 2 for another shift.
        let to_mesh = link.rotation.transposed();
        let lost = product(way.turn.rad + 3 * to_mesh.rad + 4, reach) + (12 + i128::from(way.arm.rad + way.change.rad)) * one;
        let least = i128::from(least) * one + lost + 1 - dot(self.normal, way.arm.mid);
        let (change, tilt) = (dot(self.normal, way.change.mid), cross(self.normal, turns).map(|x| (x >> FRACTION) as i64));
        // If nothing is known to move, both ends ask for the same: what may move yet is in `lost` and `bend`.
        let ends: &[i64] = if (turns, way.change.mid) == ([0; 3], [0; 3]) { &[0] } else { &[-1, 1] };
        ends.iter().all(|&end| {
            let direction = to_mesh.turned([0, 1, 2].map(|k| self.normal[k] + end * tilt[k]));
            let least = least - i128::from(end) * change + dot(direction, body.centre);
            body.mesh.is_above(part, direction, least)
        })
    }
}
