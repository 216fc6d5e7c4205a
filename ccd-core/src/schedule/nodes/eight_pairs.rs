//! The children of a group, each paired with one node of the other body, and their closing rates.

use super::axis::Axis;
use super::clock;
use super::shape::{Children, OtherNode};
use super::turn::Turn;
use super::vector_f32::{dot, length};
use crate::tolerance::{ACROSS_F32, BEND_F32, LEAST_BEND_F32};
use glam::Vec3;

/// The relative motion that all lanes share, in f32, with allowances for rounding.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RelativeMotionF32<S, O> {
    /// The velocity of the split side's centre minus that of the other side's.
    pub(crate) velocity: Vec3,
    pub(crate) split: S,
    pub(crate) other: O,
    /// The time left.
    pub(crate) horizon: f32,
    /// The gap to be kept, plus the rounding of a gap.
    pub(crate) slack: f32,
    /// The gap that is certainly kept: the slack minus the rounding of a gap.
    pub(crate) kept: f32,
    /// A gap that exceeds the slack by no more than this counts as closed.
    pub(crate) closed: f32,
    /// A bound of the rounding of a rate.
    pub(crate) rate_slack: f32,
}

/// The children of a group, each with the other node.
pub(super) struct EightPairs<'a, C, P, S, O> {
    pub(super) children: &'a C,
    pub(super) other: &'a P,
    pub(super) motion: &'a RelativeMotionF32<S, O>,
    /// The velocity of the other node's centre due to turning.
    pub(super) other_turning: Vec3,
    /// An upper bound of the other node's points' speeds due to turning.
    pub(super) other_speed: f32,
}

/// One child and the other node.
#[derive(Clone, Copy)]
pub(super) struct Lane {
    pub(super) lane: usize,
    /// From the child's centre to the other's.
    pub(super) way: Vec3,
    /// The velocity of the child's centre relative to the other's.
    pub(super) velocity: Vec3,
    /// An upper bound of the child's points' speeds due to turning.
    pub(super) speed: f32,
}

impl<'a, C: Children, P: OtherNode, S: Turn, O: Turn> EightPairs<'a, C, P, S, O> {
    #[inline(always)]
    pub(super) fn new(children: &'a C, other: &'a P, motion: &'a RelativeMotionF32<S, O>) -> Self {
        let other_turning = motion.other.velocity(other.centre());
        EightPairs {
            children,
            other,
            motion,
            other_turning,
            // A slack on the speeds covers the rounding of the bends.
            other_speed: length(other_turning)
                + motion.other.rate() * other.radius()
                + motion.rate_slack,
        }
    }

    #[inline(always)]
    pub(super) fn lane(&self, lane: usize) -> Lane {
        let centre = self.children.centre(lane);
        let turning = self.motion.split.velocity(centre);
        Lane {
            lane,
            way: self.other.centre() - centre,
            velocity: self.motion.velocity + turning - self.other_turning,
            speed: length(turning)
                + self.motion.split.rate() * self.children.radius(lane)
                + self.motion.rate_slack,
        }
    }

    /// Returns the time for which a fixed plane across the axis keeps the pair apart.
    #[inline(always)]
    pub(super) fn free(&self, pair: &Lane, axis: Axis) -> f32 {
        let motion = self.motion;
        // n·(v + ω×arm) of the centres, plus the share of the points around them.
        let mut rate = dot(axis.n, pair.velocity) + motion.rate_slack;
        let mut bend = LEAST_BEND_F32;
        if S::TURNS {
            let m = motion.split.across(axis.n);
            rate += self.children.reach(pair.lane, m);
            bend += bending(m, motion.split.rate(), pair.speed);
        }
        if O::TURNS {
            let m = motion.other.across(axis.n);
            rate += self.other.reach(m);
            bend += bending(m, motion.other.rate(), self.other_speed);
        }
        let apart = axis.gap - motion.slack;
        if S::TURNS || O::TURNS {
            clock::free_time(apart, motion.closed, rate, bend)
        } else {
            clock::straight_free_time(apart, motion.closed, rate)
        }
    }
}

/// Bounds the bending along `n` of paths that turn at a rate of `|ω|`, at `speed` at most; `m` is
/// `n × ω`.
#[inline(always)]
pub(super) fn bending(m: Vec3, rate: f32, speed: f32) -> f32 {
    (length(m) * BEND_F32 + ACROSS_F32 * rate) * speed
}
