//! The lemmas of the checker in floating point: how far from a plane or a ball parts stay over a stretch of time.

use crate::placed::{Moving, Placed};
use crate::scene::Scene;
use crate::tolerances::LENGTHS;
use crate::tree::{Part, Tree};
use crate::way::Way;
use ccd_core::glam::DVec3;
use ccd_core::order::lesser;

/// A pair over a stretch of time, and the ways to A and to B from the world, from A, and from B.
pub(crate) struct Stretch<'a> {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) bodies: [&'a Tree; 2],
    centres: [DVec3; 2],
    placed: [Placed; 2],
    pub(crate) offset: DVec3,
    ways: [[Way; 2]; 3],
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
        Stretch {
            from,
            to,
            bodies: bodies.map(|body| &body.body.tree),
            centres: [a, b].map(|link| links[link].screw.centre),
            placed,
            offset: placed[1].centre - placed[0].centre,
            ways: [0, a, b].map(|from| [a, b].map(|to| Way::new(all, from, to))),
        }
    }

    /// Returns the least and the greatest offset of a plane from which parts stay farther than `least` over the stretch, on its two
    /// sides. The plane turns with the world, A or B; its offset is from the centre of that.
    pub(crate) fn room(
        &self,
        parts: [Part; 2],
        (normal, frame): (DVec3, usize),
        least: f64,
    ) -> [f64; 2] {
        let [below, above] = [-1.0, 1.0].map(|side| {
            let k = usize::from(side > 0.0);
            let ends = self.ends((k, parts[k]), (side * normal, frame), least);
            let rooms = ends
                .map(|(direction, lost)| self.bodies[k].least_height(parts[k], direction) - lost);
            rooms.fold(f64::INFINITY, lesser)
        });
        [-below, above]
    }

    /// Returns how often the checker looks at a box or a triangle to see that a plane at an offset keeps parts apart.
    pub(crate) fn looks(
        &self,
        parts: [Part; 2],
        (normal, frame): (DVec3, usize),
        least: f64,
        offset: f64,
    ) -> usize {
        let sides = [-1.0, 1.0].into_iter().zip(0..2);
        sides
            .flat_map(|(side, k)| {
                let ends = self.ends((k, parts[k]), (side * normal, frame), least);
                ends.map(move |(direction, lost)| {
                    self.bodies[k].looks(parts[k], direction, side * offset + lost)
                })
            })
            .sum()
    }

    /// Returns how often the checker looks at a box to see that the part of another body is farther than `least` from a ball around
    /// the part of body `k`; `None` if it does not see that.
    pub(crate) fn looks_beyond_ball(
        &self,
        parts: [Part; 2],
        k: usize,
        least: f64,
    ) -> Option<usize> {
        let other = 1 - k;
        let way = &self.ways[1 + other][k];
        let (middle, radius) = self.bodies[k].ball(parts[k]);
        let arm = self.placed[k].rotation * (middle - self.centres[k]);
        let travel = (way.change + way.turn.cross(arm)).length() + 0.5 * way.bend(arm.length());
        let seen = self.placed[k].centre - self.placed[other].centre + arm;
        let centre = self.placed[other].rotation.transpose() * seen + self.centres[other];
        let limit = radius + travel * LENGTHS + least;
        way.is_short()
            .then(|| self.bodies[other].looks_beyond(parts[other], centre, limit))?
    }

    /// Returns for the ends of the stretch a direction, and how much higher along it than the offset of a plane a part has to be to
    /// stay farther than `least` from the plane, on the side to which its normal points.
    fn ends(
        &self,
        (k, part): (usize, Part),
        (normal, frame): (DVec3, usize),
        least: f64,
    ) -> impl Iterator<Item = (DVec3, f64)> {
        let (way, placed) = (&self.ways[frame][k], &self.placed[k]);
        let bend = way.bend(self.bodies[k].reach(part, self.centres[k]));
        let seen_from = [DVec3::ZERO, self.placed[0].centre, self.placed[1].centre][frame];
        let lost = least + 0.5 * bend * LENGTHS - normal.dot(placed.centre - seen_from);
        let ends: &[f64] = if way.rests() { &[0.0] } else { &[-1.0, 1.0] };
        ends.iter().map(move |&end| {
            let turned = normal + end * normal.cross(way.turn);
            let direction = placed.rotation.transpose() * turned;
            let lost = lost + direction.dot(self.centres[k]) - end * normal.dot(way.change);
            (direction, lost)
        })
    }

    /// Returns whether anything can be proven over so long a stretch.
    pub(crate) fn is_short(&self) -> bool {
        self.ways.iter().any(|[a, b]| a.is_short() && b.is_short())
    }

    /// Returns whether a body rests in the world.
    pub(crate) fn rests(&self, k: usize) -> bool {
        self.ways[0][k].rests()
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
        let [a, b] = &self.ways[0];
        let reach = |k: usize| self.bodies[k].reach(parts[k], self.centres[k]);
        (b.change - a.change).length() + a.turn.length() * reach(0) + b.turn.length() * reach(1)
    }
}
