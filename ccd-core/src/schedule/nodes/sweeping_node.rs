//! Planes that turn with one of the bodies.
//!
//! A plane that stands still takes the full speed of a turning body's far rim, however small the
//! other body is. A plane that turns with the body does not: the body's own extent along its normal
//! stays as it is, and only the other node sweeps towards it.
//!
//! With `n' = ω×n` and `d` from the turning body's centre to a point of the other node, the height
//! `f = n·d` has `f' = n·ḋ − (n×ω)·d` and, over a time of at most `H`,
//! `|f''| ≤ |n×ω|(|ω|(|d| + |ḋ| H) + 2|ḋ|) + |d̈|`.

use super::axis::Axis;
use super::clock;
use super::eight_pairs::{Lane, Pairing, bending};
use super::shape::{Children, Other};
use super::turn::Turn;
use super::vector::{dot, length, min};
use crate::tolerance::{ATTACHED_TIME, BEND_F32, LEAST_BEND_F32, RATE_F32};

/// The node that sweeps towards a plane attached to the other body.
struct Sweep {
    /// `n·(v_S − v_O)` at its centre, both taken at that point, and what its points around add.
    rate: f32,
    /// How far its points are at most from the turning body's centre.
    distance: f32,
    /// No point of it moves faster due to its own turning.
    speed: f32,
    /// `|ω|` of its own turning.
    own_rate: f32,
}

impl<C: Children, P: Other, S: Turn, O: Turn> Pairing<'_, C, P, S, O> {
    /// For how long a plane that turns with the split body keeps the pair apart.
    #[inline(always)]
    pub(super) fn free_with_split(&self, axis: Axis) -> f32 {
        let (closing, other) = (self.closing, self.other);
        let at = other.centre();
        let velocity = closing.velocity + closing.split.velocity(at) - self.other_turning;
        let across = closing.split.across(axis.n);
        let own = closing.other.across(axis.n);
        self.free_attached(
            axis,
            bending(across, closing.split.rate(), 1.0),
            closing.split.rate(),
            &Sweep {
                rate: dot(axis.n, velocity) + other.reach(own - across),
                distance: closing.split.arm(at) + other.radius(),
                speed: self.other_speed,
                own_rate: closing.other.rate(),
            },
        )
    }

    /// For how long a plane that turns with the other body keeps the pair apart.
    #[inline(always)]
    pub(super) fn free_with_other(&self, pair: &Lane, axis: Axis) -> f32 {
        let (closing, children) = (self.closing, self.children);
        let at = children.centre(pair.lane);
        let velocity = closing.velocity + closing.split.velocity(at) - closing.other.velocity(at);
        let across = closing.other.across(axis.n);
        let own = closing.split.across(axis.n);
        self.free_attached(
            axis,
            bending(across, closing.other.rate(), 1.0),
            closing.other.rate(),
            &Sweep {
                rate: dot(axis.n, velocity) + children.reach(pair.lane, own - across),
                distance: closing.other.arm(at) + children.radius(pair.lane),
                speed: pair.speed,
                own_rate: closing.split.rate(),
            },
        )
    }

    #[inline(always)]
    fn free_attached(&self, axis: Axis, across: f32, spin: f32, sweep: &Sweep) -> f32 {
        let closing = self.closing;
        let straight = length(closing.velocity) + closing.rate_slack;
        let speed = straight + sweep.speed;
        let far = sweep.distance + speed * ATTACHED_TIME;
        let bend = across * (spin * far + 2.0 * speed) + sweep.own_rate * sweep.speed;
        // The sweep takes place at its own distance from the turning body's centre.
        let rate_slack = closing.rate_slack + RATE_F32 * spin * sweep.distance;
        let free = clock::free_time(
            axis.gap - closing.slack,
            closing.closed,
            sweep.rate + rate_slack,
            bend * BEND_F32 + LEAST_BEND_F32,
        );
        min(free, ATTACHED_TIME)
    }
}
