//! Proves that two parts stay apart over a stretch of time, along one axis: the lemma of the README.

use crate::body::Part;
use crate::motion::Placed;
use crate::number::{ONE, Point, Vector, ZERO, cross, dot, minus, plus, up};
use crate::statement::Carried;
use alloc::vec::Vec;
use core::ops::Neg;

/// A pair over a stretch of time, as it is seen from the world, from A, and from B.
pub(crate) struct Stretch<'a> {
    bodies: [&'a Carried<'a>; 2],
    placed: [Placed; 2],
    /// The vector from the centre of A to that of B, in the middle.
    offset: Vector,
    views: [View; 3],
}

/// How a pair moves in half of a stretch, as it is seen from something that turns.
struct View {
    /// How the offset changes, and how each body turns.
    drift: Vector,
    turns: [Vector; 2],
    /// A bound of the second derivative of the offset, and for each body one that is multiplied by its reach.
    bend: i128,
    bends: [i128; 2],
}

impl<'a> Stretch<'a> {
    /// Returns `None` if links turn by more than two radians: there is no proof for so long a stretch.
    pub(crate) fn new(bodies: [&'a Carried<'a>; 2], links: &[Placed]) -> Option<Self> {
        let [a, b] = bodies.map(|body| body.link);
        let placed = [links[a], links[b]];
        if placed[0].turned + placed[1].turned > 2 * i128::from(ONE.mid[0]) {
            return None;
        }
        let offset = placed[1].centre - placed[0].centre;
        let views = [0, a, b].map(|frame| {
            let turn = links[frame].turn;
            // What the axis turns with does not turn, as it is seen from there.
            let turn_of = |k: usize| match k {
                _ if k == frame => ZERO,
                _ if turn == ZERO => links[k].turn,
                _ => links[k].turn - turn,
            };
            let ways = [Way::new(links, frame, a), Way::new(links, frame, b)];
            View {
                drift: placed[1].velocity - placed[0].velocity - turn.cross(offset),
                turns: [turn_of(a), turn_of(b)],
                bend: ways[0].bend + ways[1].bend,
                bends: ways.map(|way| way.factors().1),
            }
        });
        Some(Stretch {
            bodies,
            placed,
            offset,
            views,
        })
    }

    /// Returns whether an axis, no longer than 1, keeps two parts farther apart than `least` over the whole stretch. It turns
    /// with the world, A or B: 0, 1, 2.
    pub(crate) fn keeps_apart(
        &self,
        parts: [Part; 2],
        axis: Point,
        frame: usize,
        least: i128,
    ) -> bool {
        let (view, one) = (&self.views[frame], i128::from(ONE.mid[0]));
        let [middle, change] = [self.offset, view.drift].map(|v| dot(axis, v.mid));
        let lost = 3 * i128::from(self.offset.rad + view.drift.rad) * one;
        let mut gaps = [middle - change - lost, middle + change - lost];
        let mut bend = view.bend;
        for (k, facing) in [axis.map(i64::neg), axis].into_iter().enumerate() {
            let (body, placed, turn) = (self.bodies[k], &self.placed[k], view.turns[k]);
            let (part, from) = (parts[k], body.centre.mid);
            // The corners and the centre are off by less than 1 each, in each coordinate.
            let reach = body.mesh.reach(part, from) + 4;
            // A direction has coordinates up to 3, off by 2 turn.rad and a rounding. In the link's frame it is off by 3 times
            // that, by 9 rad and a rounding. Corners and centre are off by 6 in all, times a coordinate.
            let rad = i128::from(6 * turn.rad + 9 * placed.rad + 4);
            let lost = 3 * rad * reach + 24 * one;
            let height = |direction: Point| {
                body.mesh
                    .least_height(part, placed.to_link(direction), from)
                    - lost
            };
            let tilt = cross(facing, turn.mid);
            let heights = if turn == ZERO {
                [height(facing); 2]
            } else {
                [height(minus(facing, tilt)), height(plus(facing, tilt))]
            };
            gaps = [gaps[0] + heights[0], gaps[1] + heights[1]];
            bend += up(view.bends[k], reach);
        }
        gaps.iter().all(|&gap| gap > (least + bend / 2 + 1) * one)
    }
}

/// What moves between a link and another one, as it is seen from the first.
struct Way {
    /// The vector from the last joint that turns, and how it changes.
    arm: Vector,
    travel: Vector,
    /// How fast the arm turns, and a bound of how that changes.
    turn: Vector,
    twist: i128,
    /// A bound of the second derivative of all arms before this one.
    bend: i128,
}

impl Way {
    fn new(links: &[Placed], from: usize, to: usize) -> Way {
        let (arm, travel, turn) = (ZERO, ZERO, ZERO);
        let mut way = Way {
            arm,
            travel,
            turn,
            twist: 0,
            bend: 0,
        };
        let (mut up, mut down, mut path) = (from, to, Vec::new());
        while up != down {
            // A link has a larger number than its parent.
            if up > down {
                let link = &links[up];
                way.turn_by(-link.own_turn);
                (way.arm, way.travel) = (way.arm - link.arm, way.travel - link.travel);
                up = link.parent;
            } else {
                path.push(&links[down]);
                down = links[down].parent;
            }
        }
        for link in path.into_iter().rev() {
            (way.arm, way.travel) = (way.arm + link.arm, way.travel + link.travel);
            way.turn_by(link.own_turn);
        }
        way.end_arm();
        way
    }

    fn turn_by(&mut self, turn: Vector) {
        if turn == ZERO {
            return;
        }
        self.end_arm();
        self.twist += self.turn.cross(turn).length() + up(self.twist, turn.length());
        self.turn = self.turn + turn;
    }

    fn end_arm(&mut self) {
        let (rate, factor) = self.factors();
        let travel = self.travel.length();
        self.bend += up(factor, self.arm.length() + travel) + 2 * up(rate, travel);
        (self.arm, self.travel) = (ZERO, ZERO);
    }

    /// Returns bounds of how fast a vector turns that the last joint carries, and of its second derivative, for a length of 1.
    fn factors(&self) -> (i128, i128) {
        if self.turn == ZERO && self.twist == 0 {
            return (0, 0);
        }
        let rate = self.turn.length() + self.twist;
        (rate, self.twist + up(rate, rate))
    }
}
