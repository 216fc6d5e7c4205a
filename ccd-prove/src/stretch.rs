//! The lemma of the checker in floating point: whether an axis keeps two parts apart over a stretch of time.

use crate::body::{Body, Part, length};
use crate::placed::{Moving, Placed};
use crate::scene::Scene;
use ccd_core::glam::DVec3;
use ccd_core::order::lesser;

/// A pair over a stretch of time, as it is seen from the world, from A, and from B.
pub(crate) struct Stretch<'a> {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) bodies: [&'a Body; 2],
    centres: [DVec3; 2],
    placed: [Placed; 2],
    pub(crate) offset: DVec3,
    /// `None` where links turn too far.
    views: Option<[View; 3]>,
}

/// How a pair moves in half of a stretch, as it is seen from something that turns.
struct View {
    drift: DVec3,
    turns: [DVec3; 2],
    bend: f64,
    bends: [f64; 2],
}

impl<'a> Stretch<'a> {
    pub(crate) fn new(
        (scene, links): (&Scene<'a>, &[Moving]),
        pair: usize,
        ([from, to], all): ([f64; 2], &[Placed]),
    ) -> Self {
        let bodies = scene.pairs[pair].bodies.map(|body| scene.bodies[body]);
        let [a, b] = bodies.map(|body| body.link);
        let placed = [all[a], all[b]];
        let offset = placed[1].centre - placed[0].centre;
        let view = |frame: usize| {
            let turn = all[frame].turn;
            let ways = [Way::new(all, frame, a), Way::new(all, frame, b)];
            View {
                drift: placed[1].velocity - placed[0].velocity - turn.cross(offset),
                turns: [placed[0].turn - turn, placed[1].turn - turn],
                bend: ways[0].bend + ways[1].bend,
                bends: ways.map(|way| way.factors().1),
            }
        };
        let is_short = placed[0].turned + placed[1].turned < 1.999;
        Stretch {
            from,
            to,
            bodies: bodies.map(|body| body.body),
            centres: [links[a].centre, links[b].centre],
            placed,
            offset,
            views: is_short.then(|| [0, a, b].map(view)),
        }
    }

    /// Returns the least gap of two parts along an axis over the stretch, or less. The axis turns with the world, A or B.
    pub(crate) fn least_gap(&self, parts: [Part; 2], axis: DVec3, frame: usize) -> f64 {
        let Some(views) = &self.views else {
            return f64::NEG_INFINITY;
        };
        let view = &views[frame];
        let (centre, change) = (axis.dot(self.offset), axis.dot(view.drift));
        let mut gaps = [centre - change, centre + change];
        let mut bend = view.bend;
        for (k, facing) in [-axis, axis].into_iter().enumerate() {
            let (body, centre) = (self.bodies[k], self.centres[k]);
            let tilt = facing.cross(view.turns[k]);
            for (gap, direction) in gaps.iter_mut().zip([facing - tilt, facing + tilt]) {
                let direction = self.placed[k].rotation.transpose() * direction;
                *gap += body.least_height(parts[k], direction, centre);
            }
            if view.bends[k] > 0.0 {
                bend += view.bends[k] * body.reach(parts[k], centre);
            }
        }
        // The checker rounds lengths up to 30 bits.
        lesser(gaps[0], gaps[1]) - 0.5 * bend * (1.0 + 1e-8)
    }

    /// Returns whether anything can be proven over so long a stretch.
    pub(crate) fn is_short(&self) -> bool {
        self.views.is_some()
    }

    /// Returns whether a body turns, as it is seen from the world.
    pub(crate) fn turns(&self, k: usize) -> bool {
        self.placed[k].turn != DVec3::ZERO
    }

    /// Returns a point of a part in the middle of the stretch, from the centre of A: the one that is lowest along a direction.
    pub(crate) fn lowest(&self, k: usize, part: Part, direction: DVec3) -> (u32, DVec3) {
        let rotation = self.placed[k].rotation;
        let (index, corner) = self.bodies[k].lowest_corner(part, rotation.transpose() * direction);
        let arm = rotation * (corner - self.centres[k]);
        (index, if k == 0 { arm } else { self.offset + arm })
    }

    /// Returns how far parts move in half of the stretch, about.
    pub(crate) fn way(&self, parts: [Part; 2]) -> f64 {
        let [a, b] = &self.placed;
        let reach = |k: usize| self.bodies[k].reach(parts[k], self.centres[k]);
        length(b.velocity - a.velocity) + length(a.turn) * reach(0) + length(b.turn) * reach(1)
    }
}

/// What moves between a link and another one, as it is seen from the first.
#[derive(Default)]
struct Way {
    arm: DVec3,
    travel: DVec3,
    turn: DVec3,
    twist: f64,
    bend: f64,
}

impl Way {
    fn new(links: &[Placed], from: usize, to: usize) -> Way {
        let mut way = Way::default();
        let (mut up, mut down, mut path) = (from, to, Vec::new());
        while up != down {
            if up > down {
                let link = &links[up];
                way.turn_by(-link.own_turn);
                way.arm -= link.arm;
                way.travel -= link.travel;
                up = link.parent;
            } else {
                path.push(down);
                down = links[down].parent;
            }
        }
        for link in path.into_iter().rev().map(|k| &links[k]) {
            way.arm += link.arm;
            way.travel += link.travel;
            way.turn_by(link.own_turn);
        }
        way.end_arm();
        way
    }

    fn turn_by(&mut self, turn: DVec3) {
        if turn == DVec3::ZERO {
            return;
        }
        self.end_arm();
        self.twist += self.turn.cross(turn).length() + self.twist * turn.length();
        self.turn += turn;
    }

    fn end_arm(&mut self) {
        let (rate, factor) = self.factors();
        let travel = self.travel.length();
        self.bend += factor * (self.arm.length() + travel) + 2.0 * rate * travel;
        (self.arm, self.travel) = (DVec3::ZERO, DVec3::ZERO);
    }

    fn factors(&self) -> (f64, f64) {
        let rate = self.turn.length() + self.twist;
        (rate, self.twist + rate * rate)
    }
}
