//! Planes that turn with one of the bodies.
//!
//! For a fixed plane the full speed of a turning body's far rim counts, however small the other
//! body is. For a plane that turns with the body it does not: the body's own extent along its
//! normal is constant, and only the other node sweeps towards it.
//!
//! With `n' = ω×n` and `d` from the turning body's centre to a point of the other node, the height
//! `f = n·d` has `f' = n·ḋ − (n×ω)·d` and, over a time of at most `H`, `|f''| ≤ |n×ω|(|ω|(|d| + |ḋ|
//! H) + 2|ḋ|) + |d̈|`.

use super::axis::Axis;
use super::clock;
use super::eight_pairs::{EightPairs, Lane, bending};
use super::shape::{Children, OtherNode};
use super::turn::Turn;
use super::vector_f32::{dot, length, min};
use crate::tolerance::{ATTACHED_TIME, BEND_F32, LEAST_BEND_F32, RATE_F32};

/// The node that sweeps towards a plane attached to the other body.
struct SweepingNode {
    /// `n·(v_S − v_O)` at its centre, with both velocities taken at that point, plus the share of
    /// the points around.
    rate: f32,
    /// The largest distance of its points from the turning body's centre.
    distance: f32,
    /// An upper bound of its points' speeds due to its own turning.
    speed: f32,
    /// `|ω|` of its own turning.
    own_rate: f32,
}

impl<C: Children, P: OtherNode, S: Turn, O: Turn> EightPairs<'_, C, P, S, O> {
    /// Returns the time for which a plane that turns with the split body keeps the pair apart.
    #[inline(always)]
    pub(super) fn free_with_split(&self, axis: Axis) -> f32 {
        let (motion, other) = (self.motion, self.other);
        let at = other.centre();
        let velocity = motion.velocity + motion.split.velocity(at) - self.other_turning;
        let across = motion.split.across(axis.n);
        let own = motion.other.across(axis.n);
        self.free_attached(
            axis,
            bending(across, motion.split.rate(), 1.0),
            motion.split.rate(),
            &SweepingNode {
                rate: dot(axis.n, velocity) + other.reach(own - across),
                distance: motion.split.arm(at) + other.radius(),
                speed: self.other_speed,
                own_rate: motion.other.rate(),
            },
        )
    }

    /// Returns the time for which a plane that turns with the other body keeps the pair apart.
    #[inline(always)]
    pub(super) fn free_with_other(&self, pair: &Lane, axis: Axis) -> f32 {
        let (motion, children) = (self.motion, self.children);
        let at = children.centre(pair.lane);
        let velocity = motion.velocity + motion.split.velocity(at) - motion.other.velocity(at);
        let across = motion.other.across(axis.n);
        let own = motion.split.across(axis.n);
        self.free_attached(
            axis,
            bending(across, motion.other.rate(), 1.0),
            motion.other.rate(),
            &SweepingNode {
                rate: dot(axis.n, velocity) + children.reach(pair.lane, own - across),
                distance: motion.other.arm(at) + children.radius(pair.lane),
                speed: pair.speed,
                own_rate: motion.split.rate(),
            },
        )
    }

    #[inline(always)]
    fn free_attached(&self, axis: Axis, across: f32, spin: f32, sweep: &SweepingNode) -> f32 {
        let motion = self.motion;
        let straight = length(motion.velocity) + motion.rate_slack;
        let speed = straight + sweep.speed;
        let far = sweep.distance + speed * ATTACHED_TIME;
        let bend = across * (spin * far + 2.0 * speed) + sweep.own_rate * sweep.speed;
        // The sweep happens at its own distance from the turning body's centre.
        let rate_slack = motion.rate_slack + RATE_F32 * spin * sweep.distance;
        let free = clock::free_time(
            axis.gap - motion.slack,
            motion.closed,
            sweep.rate + rate_slack,
            bend * BEND_F32 + LEAST_BEND_F32,
        );
        min(free, ATTACHED_TIME)
    }
}
