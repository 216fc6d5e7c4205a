//! Proves that two parts stay apart over a stretch of time, along one axis: the lemma of the README.

use crate::Body;
use crate::body::Part;
use crate::number::{FRACTION, Number, Vector};
use crate::statement::{Motion, Placed, Statement, TIME};

/// Where both bodies are in the middle of a stretch of time, and how they move in half of it.
pub(crate) struct Stretch {
    pub(crate) times: [i128; 2],
    placed: [Placed; 2],
    turns: [Vector; 2],
    /// By how much the vector from the centre of A to that of B changes.
    change: Vector,
}

impl Stretch {
    pub(crate) fn new(motions: &[Motion; 2], times: [i128; 2]) -> Self {
        let [from, to] = times;
        let middle = (from + to) >> 1;
        let half = Number::exact([to - middle]);
        let middle = Number::exact([middle]);
        let [a, b] = motions;
        Stretch {
            times,
            placed: [a.at(middle), b.at(middle)],
            turns: [a.turn.times(half, TIME), b.turn.times(half, TIME)],
            change: (b.travel - a.travel).times(half, TIME),
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
        let axis_turn = frame.map_or(Vector::exact([0; 3]), |k| self.turns[k]);
        let axis_change = axis_turn.cross(axis, FRACTION);
        let offset = self.placed[1].centre - self.placed[0].centre;
        let travel = axis.dot(self.change, 0);
        // The linear part at the start and at the end, and the curvature.
        let start = (axis - axis_change).dot(offset, 0) - travel;
        let end = (axis + axis_change).dot(offset, 0) + travel;
        let mut gaps = [start, end].map(|end| end.mid[0] - end.rad);
        let (turn, change) = (axis_turn.length(), self.change.length());
        let mut curvature = up(up(turn, turn), offset.length() + change) + 2 * up(turn, change);
        for k in 0..2 {
            let relative = self.turns[k] - axis_turn;
            let in_body = axis.cross(relative, FRACTION);
            let mut reach = 0;
            for (gap, direction) in gaps.iter_mut().zip([axis - in_body, axis + in_body]) {
                let direction = if k == 0 { -direction } else { direction };
                let direction = self.placed[k].to_mesh(direction);
                let centre = statement.motions[k].centre.mid;
                let (height, distance) =
                    bodies[k].height_and_reach(parts[k], centre, direction.mid);
                // The corners and the centre are off by 1 each, in each coordinate.
                reach = distance + 4;
                *gap += height - 3 * direction.rad * reach - 6 * direction.size();
            }
            let turns = turn + self.turns[k].length();
            curvature += up(up(relative.length(), turns), reach);
        }
        let least = (statement.margin + curvature / 2 + 1) << FRACTION;
        gaps.iter().all(|&gap| gap > least)
    }
}

/// Returns the product of a number and a fraction that are not negative, rounded up.
fn up(fraction: i128, number: i128) -> i128 {
    (fraction * number + (1 << FRACTION) - 1) >> FRACTION
}
