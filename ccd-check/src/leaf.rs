//! Proves that two parts stay apart over a stretch of time, along one axis: Lemmas 1 and 2 of the README.

use crate::body::Part;
use crate::motion::{Motion, Placed};
use crate::number::{ONE, Point, Vector, ZERO, cross, dot, minus, plus, up};
use crate::statement::Carried;
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use core::ops::Neg;

/// All links in the middle of a stretch of time, and what ways between two of them add to the second derivatives: the bound of
/// Lemma 2 for the vectors on the way, and its factor for a body at the end.
pub(crate) struct Links {
    placed: Vec<Placed>,
    ways: BTreeMap<[usize; 2], [i128; 2]>,
}

impl Links {
    pub(crate) fn new(placed: Vec<Placed>) -> Links {
        let ways = BTreeMap::new();
        Links { placed, ways }
    }
}

/// A pair over a stretch of time, as it is seen from what an axis turns with.
pub(crate) struct Stretch<'a> {
    bodies: [&'a Carried<'a>; 2],
    placed: [Placed; 2],
    /// The vector from the centre of A to that of B in the middle, how it changes in half of the stretch, and how the bodies turn.
    offset: Vector,
    drift: Vector,
    turns: [Vector; 2],
    /// A bound of the second derivative of the offset, and for each body one that is multiplied by its reach.
    bend: i128,
    bends: [i128; 2],
}

impl<'a> Stretch<'a> {
    /// Looks from a link, or from the world, which is 0. Returns `None` if links turn by more than two radians: there is no proof
    /// for so long a stretch.
    pub(crate) fn new(
        bodies: [&'a Carried<'a>; 2],
        Links { placed, ways }: &mut Links,
        from: usize,
    ) -> Option<Self> {
        let links = &placed[..];
        let numbers = bodies.map(|body| body.link);
        let placed @ [a, b] = numbers.map(|link| links[link]);
        if a.turned + b.turned > 2 * i128::from(ONE.mid[0]) {
            return None;
        }
        let turn = links[from].whole.turn;
        let offset = b.whole.arm - a.whole.arm;
        let way = |link| {
            *ways
                .entry([from, link])
                .or_insert_with(|| Way::bounds(links, from, link))
        };
        let [way_a, way_b] = numbers.map(way);
        Some(Stretch {
            bodies,
            placed,
            offset,
            drift: b.whole.travel - a.whole.travel - turn.cross(offset),
            // What the axis turns with does not turn, as it is seen from there.
            turns: numbers.map(|link| {
                if link == from {
                    ZERO
                } else {
                    links[link].whole.turn - turn
                }
            }),
            bend: way_a[0] + way_b[0],
            bends: [way_a[1], way_b[1]],
        })
    }

    /// Returns whether an axis, no longer than 1, keeps two parts farther apart than `least` over the whole stretch.
    pub(crate) fn keeps_apart(&self, parts: [Part; 2], axis: Point, least: i128) -> bool {
        let one = i128::from(ONE.mid[0]);
        let [middle, change] = [self.offset, self.drift].map(|v| dot(axis, v.mid));
        let lost = i128::from(self.offset.rad + self.drift.rad) * one;
        let mut gaps = [middle - change - lost, middle + change - lost];
        let mut bend = self.bend;
        for (k, facing) in [axis.map(i64::neg), axis].into_iter().enumerate() {
            let (body, placed, turn) = (self.bodies[k], &self.placed[k], self.turns[k]);
            let (part, from) = (parts[k], body.centre);
            // Corners and centre are off by less than 2 each.
            let reach = body.mesh.reach(part, from) + 4;
            // A direction is no longer than 3. It is off by turn.rad and a rounding, and in the link's frame by 3 times what the
            // rotation is off by, and another rounding.
            let rad = i128::from(turn.rad + 3 * placed.rotation.rad + 4);
            let lost = rad * reach + 12 * one;
            let height = |direction: Point| {
                body.mesh
                    .least_height(part, placed.rotation.turn_back(direction), from)
                    - lost
            };
            let tilt = cross(facing, turn.mid);
            let heights = if turn == ZERO {
                [height(facing); 2]
            } else {
                [height(minus(facing, tilt)), height(plus(facing, tilt))]
            };
            gaps = [gaps[0] + heights[0], gaps[1] + heights[1]];
            bend += up(self.bends[k], reach);
        }
        gaps.iter().all(|&gap| gap > (least + bend / 2 + 1) * one)
    }
}

/// What moves between a link and another one, as it is seen from the first.
struct Way {
    /// The vector from the last joint that turns, how it changes, and how fast it turns.
    last: Motion,
    /// A bound of how that turn changes.
    twist: i128,
    /// A bound of the second derivative of all vectors before.
    bend: i128,
}

impl Way {
    /// Goes a way, and returns the bounds.
    fn bounds(links: &[Placed], from: usize, to: usize) -> [i128; 2] {
        let (mut up, mut down, mut path) = (from, to, Vec::new());
        let mut way = Way {
            last: Motion::NONE,
            twist: 0,
            bend: 0,
        };
        while up != down {
            // A link has a larger number than its parent.
            if up > down {
                let own = links[up].own;
                way.turn_by(ZERO - own.turn);
                let last = &mut way.last;
                (last.arm, last.travel) = (last.arm - own.arm, last.travel - own.travel);
                up = links[up].parent;
            } else {
                path.push(links[down].own);
                down = links[down].parent;
            }
        }
        for own in path.into_iter().rev() {
            let last = &mut way.last;
            (last.arm, last.travel) = (last.arm + own.arm, last.travel + own.travel);
            way.turn_by(own.turn);
        }
        way.end_arm();
        [way.bend, way.factors().1]
    }

    fn turn_by(&mut self, turn: Vector) {
        if turn == ZERO {
            return;
        }
        self.end_arm();
        let bent = self.last.turn.cross(turn).length();
        self.twist += bent + up(self.twist, turn.length());
        self.last.turn = self.last.turn + turn;
    }

    fn end_arm(&mut self) {
        let (rate, factor) = self.factors();
        let [arm, travel] = [self.last.arm, self.last.travel].map(Vector::length);
        self.bend += up(factor, arm + travel) + 2 * up(rate, travel);
        (self.last.arm, self.last.travel) = (ZERO, ZERO);
    }

    /// Returns bounds of how fast a vector turns that the last joint carries, and of its second derivative, for a length of 1.
    fn factors(&self) -> (i128, i128) {
        if self.last.turn == ZERO && self.twist == 0 {
            return (0, 0);
        }
        let rate = self.last.turn.length() + self.twist;
        (rate, self.twist + up(rate, rate))
    }
}
