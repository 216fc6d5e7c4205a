//! The lemma of the checker in floating point: whether an axis keeps two parts apart over a stretch of time.

use crate::body::{Body, Part};
use crate::placed::{Moving, Placed};
use crate::scene::Scene;
use crate::way::Way;
use ccd_core::glam::DVec3;

/// A pair over a stretch of time, and the ways to A and to B from the world, from A, and from B.
pub(crate) struct Stretch<'a> {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) bodies: [&'a Body; 2],
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
            bodies: bodies.map(|body| body.body),
            centres: [links[a].centre, links[b].centre],
            placed,
            offset: placed[1].centre - placed[0].centre,
            ways: [0, a, b].map(|from| [a, b].map(|to| Way::new(all, from, to))),
        }
    }

    /// Returns whether an axis keeps two parts farther apart than `least` over the stretch. The axis turns with the world, A or B.
    pub(crate) fn keeps_apart(
        &self,
        parts: [Part; 2],
        (axis, frame): (DVec3, usize),
        least: f64,
    ) -> bool {
        let ways @ [a, b] = &self.ways[frame];
        if !(a.is_short() && b.is_short()) {
            return false;
        }
        let mut bend = a.bend + b.bend;
        for k in 0..2 {
            if ways[k].turn != DVec3::ZERO {
                bend += ways[k].factor() * self.bodies[k].reach(parts[k], self.centres[k]);
            }
        }
        // The checker rounds lengths up to 30 bits.
        let least = least + 0.5 * bend * (1.0 + 1e-8);
        let (middle, change) = (axis.dot(self.offset), axis.dot(b.change - a.change));
        [-1.0, 1.0].into_iter().all(|end| {
            let [of_a, of_b] = [(0, -axis), (1, axis)].map(|(k, facing)| {
                self.placed[k].rotation.transpose() * (facing + end * facing.cross(ways[k].turn))
            });
            let centres = of_a.dot(self.centres[0]) + of_b.dot(self.centres[1]);
            let needed = least - middle - end * change + centres;
            let ([a, b], [part_a, part_b]) = (self.bodies, parts);
            // A is looked at no more closely than needed where the box of B is, and B where A has been found.
            let limit = needed - b.lower_bound(part_b, of_b);
            let height = a.least_height(part_a, of_a, limit);
            height >= limit || b.least_height(part_b, of_b, needed - height) >= needed - height
        })
    }

    /// Returns whether anything can be proven over so long a stretch.
    pub(crate) fn is_short(&self) -> bool {
        self.ways.iter().any(|[a, b]| a.is_short() && b.is_short())
    }

    /// Returns whether a body turns, as it is seen from the world.
    pub(crate) fn turns(&self, k: usize) -> bool {
        self.ways[0][k].turned > 0.0
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
