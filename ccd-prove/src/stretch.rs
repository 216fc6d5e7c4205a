//! The lemma of the checker in floating point: whether an axis keeps two parts apart over a stretch of time.

use crate::body::{Body, Part, length};
use ccd_core::Motion;
use ccd_core::glam::{DMat3, DQuat, DVec3};
use ccd_core::order::lesser;

/// A body of a query: the mesh, and how it moves.
pub(crate) struct Moving<'a> {
    pub(crate) body: &'a Body,
    pub(crate) motion: Motion,
}

/// Where both bodies are in the middle of a stretch of time, and how they move in half of it.
pub(crate) struct Stretch {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) offset: DVec3,
    change: DVec3,
    pub(crate) rotations: [DMat3; 2],
    turns: [DVec3; 2],
}

/// What an axis turns with: the world, or a body.
pub(crate) type Frame = Option<usize>;

impl Stretch {
    pub(crate) fn new(bodies: &[Moving<'_>; 2], from: f64, to: f64) -> Self {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let turned = |motion: &Motion| {
            let turned = DQuat::from_scaled_axis(motion.spin() * middle);
            DMat3::from_quat(turned) * DMat3::from_quat(motion.start().rotation())
        };
        let centre = |motion: &Motion| {
            motion.start().transform_point(motion.centre()) + motion.velocity() * middle
        };
        let [a, b] = bodies.each_ref().map(|moving| &moving.motion);
        Stretch {
            from,
            to,
            offset: centre(b) - centre(a),
            change: (b.velocity() - a.velocity()) * half,
            rotations: [turned(a), turned(b)],
            turns: [a.spin() * half, b.spin() * half],
        }
    }

    /// Returns the least gap of two parts along an axis over the stretch, or less.
    pub(crate) fn least_gap(
        &self,
        bodies: &[Moving<'_>; 2],
        parts: [Part; 2],
        (axis, frame): (DVec3, Frame),
    ) -> f64 {
        let axis_turn = frame.map_or(DVec3::ZERO, |k| self.turns[k]);
        let axis_change = axis_turn.cross(axis);
        let mut ends = [-1.0, 1.0].map(|sign| {
            (axis + sign * axis_change).dot(self.offset) + sign * axis.dot(self.change)
        });
        let change = length(self.change);
        let turn = length(axis_turn);
        let mut curvature = turn * turn * (length(self.offset) + change) + 2.0 * turn * change;
        for k in 0..2 {
            let (body, centre) = (bodies[k].body, bodies[k].motion.centre());
            let relative = self.turns[k] - axis_turn;
            let in_body = axis.cross(relative);
            let side = if k == 0 { -1.0 } else { 1.0 };
            for (end, sign) in ends.iter_mut().zip([-1.0, 1.0]) {
                let direction = side * (axis + sign * in_body);
                let direction = self.rotations[k].transpose() * direction;
                *end += body.least_height(parts[k], centre, direction);
            }
            if relative != DVec3::ZERO {
                let turns = turn + length(self.turns[k]);
                curvature += length(relative) * turns * body.reach(parts[k], centre);
            }
        }
        lesser(ends[0], ends[1]) - 0.5 * curvature
    }

    /// Returns a point of a part in the middle of the stretch, from the centre of A's rotation: the one that is lowest along a
    /// direction.
    pub(crate) fn lowest(
        &self,
        bodies: &[Moving<'_>; 2],
        (k, part): (usize, Part),
        direction: DVec3,
    ) -> (u32, DVec3) {
        let rotation = self.rotations[k];
        let (index, corner) = bodies[k]
            .body
            .lowest_corner(part, rotation.transpose() * direction);
        let arm = rotation * (corner - bodies[k].motion.centre());
        (index, if k == 0 { arm } else { self.offset + arm })
    }

    /// Returns how far parts move in half of the stretch, about.
    pub(crate) fn way(&self, bodies: &[Moving<'_>; 2], parts: [Part; 2]) -> f64 {
        let reach = |k: usize| bodies[k].body.reach(parts[k], bodies[k].motion.centre());
        length(self.change) + length(self.turns[0]) * reach(0) + length(self.turns[1]) * reach(1)
    }
}
