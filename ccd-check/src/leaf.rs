//! Proves that two parts stay apart over a stretch of time, along one axis: the lemma of the README.

use crate::Body;
use crate::body::Part;
use crate::number::{FRACTION, Number, Vector};
use crate::rotation::Rotation;
use crate::statement::{Motion, Statement, TIME};

/// Where both bodies are in the middle of a stretch of time, and how they move in half of it.
pub(crate) struct Stretch {
    pub(crate) from: i128,
    pub(crate) to: i128,
    /// From the centre of A to that of B, and by how much that changes.
    offset: Vector,
    change: Vector,
    turned: [Option<Rotation>; 2],
    /// The rotation vector of each body.
    turn: [Vector; 2],
}

impl Stretch {
    pub(crate) fn new(motions: &[Motion; 2], from: i128, to: i128) -> Self {
        let [a, b] = motions;
        let middle = (from + to) >> 1;
        let half = Number::exact([to - middle]);
        let middle = Number::exact([middle]);
        let still = Vector::exact([0; 3]);
        Stretch {
            from,
            to,
            offset: b.centre_at(middle) - a.centre_at(middle),
            change: (b.travel - a.travel).times(half, TIME),
            turned: [a.turned_at(middle), b.turned_at(middle)],
            turn: [a, b].map(|motion| motion.turn.map_or(still, |turn| turn.times(half, TIME))),
        }
    }

    /// Returns whether an axis keeps two parts apart by more than the margin over the whole stretch. The axis turns with the
    /// world, or with the body of this number.
    pub(crate) fn keeps_apart(
        &self,
        (statement, bodies): (&Statement, [&Body; 2]),
        parts: [Part; 2],
        (axis, frame): (Vector, Option<usize>),
    ) -> bool {
        let still = Vector::exact([0; 3]);
        let axis_turn = frame.map_or(still, |k| self.turn[k]);
        let axis_change = axis_turn.cross(axis, FRACTION);
        let travel = axis.dot(self.change, 0);
        // The linear part at the start and at the end, and the curvature.
        let ends = [axis - axis_change, axis + axis_change].map(|axis| axis.dot(self.offset, 0));
        let ends = [ends[0] - travel, ends[1] + travel];
        let mut gaps = ends.map(|end| end.mid[0] - end.rad);
        let (turn, change) = (axis_turn.length(), self.change.length());
        let mut curvature =
            up(up(turn, turn), self.offset.length() + change) + 2 * up(turn, change);
        for k in 0..2 {
            let motion = &statement.motions[k];
            let relative = if frame == Some(k) {
                still
            } else {
                self.turn[k] - axis_turn
            };
            let in_body = axis.cross(relative, FRACTION);
            let mut reach = 0;
            for (gap, direction) in gaps.iter_mut().zip([axis - in_body, axis + in_body]) {
                let direction = if k == 0 { -direction } else { direction };
                let direction = motion.to_mesh(direction, self.turned[k]);
                let (height, distance) =
                    bodies[k].height_and_reach(parts[k], motion.centre.mid, direction.mid);
                // The corners and the centre are off by 1 each, in each coordinate.
                reach = distance + 4;
                *gap += height - 3 * direction.rad * reach - 6 * direction.size();
            }
            curvature += up(up(relative.length(), turn + self.turn[k].length()), reach);
        }
        let least = (statement.margin + curvature / 2 + 1) << FRACTION;
        gaps.iter().all(|&gap| gap > least)
    }
}

/// Returns the product of a number and a fraction that are not negative, rounded up.
fn up(fraction: i128, number: i128) -> i128 {
    (fraction * number + (1 << FRACTION) - 1) >> FRACTION
}
