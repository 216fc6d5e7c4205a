//! A pair of parts, and the intervals in which it may touch.

use super::error::ENLARGED;
use crate::path::lanes::LANES;
use crate::tuning::MIN_DIVIDED_DISPLACEMENT;
use ccd_core::fearless_simd::{Simd, f32x8, prelude::*};
use ccd_core::simd::splat;

/// A pair of parts that the ball test compares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BallPair {
    /// A part of the robot, and the index of an obstacle's part among those of all obstacles.
    Obstacle { part: u32, obstacle: u32 },
    /// The index of a pair of the robot's own parts.
    OfRobot(u32),
}

/// A pair, and what the test has found out about it in eight intervals.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TestedPair {
    pub(crate) pair: BallPair,
    /// A bound of the margin of the pair plus the error of gaps between its balls.
    pub(super) allowance: f32,
    /// A bound of the error of the distance between the center of a ball and the other shape; infinity if being inside
    /// that shape proves no contact.
    touching_error: f32,
    /// The intervals in which the pair may touch, as bits.
    pub(crate) open: u8,
    /// The open intervals in which a ball gets far.
    pub(crate) far_moving: u8,
    /// The interval with the least gap at its midpoint, and that gap.
    pub(crate) nearest: u8,
    pub(crate) least_gap: f32,
}

/// The distances at which pairs count as touching.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Margins {
    OfPairs,
    /// The same for all pairs; infinity leaves all of them open.
    Common(f64),
}

/// A pair that touches at the midpoint of an interval.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TouchingPair {
    pub(crate) pair: BallPair,
    pub(crate) lane: usize,
}

/// The result of comparing one ball in eight intervals.
#[derive(Clone, Copy)]
pub(super) struct BallGaps<L: Simd> {
    /// The gap between the ball and the other shape at the midpoints.
    pub(super) gap: f32x8<L>,
    /// How far the ball gets in the interval.
    pub(super) way: f32x8<L>,
    /// The gap below which the balls inside touch, but for errors.
    pub(super) inner_gap: f32,
}

impl Margins {
    /// Returns the margin of a pair whose own margin is `own`.
    #[inline(always)]
    pub(super) fn of_pair(self, own: f64) -> f64 {
        match self {
            Margins::OfPairs => own,
            Margins::Common(margin) => margin,
        }
    }
}

impl TestedPair {
    pub(super) fn new(pair: BallPair, margin: f64, [error, touching_error]: [f64; 2]) -> Self {
        TestedPair {
            pair,
            allowance: ((margin + error) * ENLARGED) as f32,
            touching_error: (touching_error * ENLARGED) as f32,
            open: 0,
            far_moving: 0,
            nearest: 0,
            least_gap: f32::INFINITY,
        }
    }

    pub(super) fn set_touching_error(&mut self, error: f64) {
        self.touching_error = (error * ENLARGED) as f32;
    }

    /// Returns the pair without results.
    pub(super) fn untested(&self) -> Self {
        TestedPair {
            open: 0,
            far_moving: 0,
            least_gap: f32::INFINITY,
            ..*self
        }
    }

    /// Returns whether the test compares the pair by shapes that are more than boxes around the bodies.
    pub(crate) fn is_exact(&self) -> bool {
        self.touching_error < f32::INFINITY
    }

    /// Records the intervals in which a ball of the pair may touch. Returns those in which it touches at the midpoint,
    /// as bits.
    #[inline(always)]
    pub(super) fn record<L: Simd>(&mut self, level: L, gaps: BallGaps<L>) -> u8 {
        let required = gaps.way + splat(level, self.allowance);
        // Written so that NaN stays open.
        let open = !gaps.gap.simd_gt(required).to_bitmask() as u8;
        if open == 0 {
            return 0;
        }
        let far = gaps.way.simd_gt(splat(level, MIN_DIVIDED_DISPLACEMENT));
        let touching = splat(level, gaps.inner_gap - self.touching_error);
        let touching = gaps.gap.simd_lt(touching);
        let mut gap = [0.0; LANES];
        gaps.gap.store_slice(&mut gap);
        self.record_open(open, open & far.to_bitmask() as u8, &gap);
        open & touching.to_bitmask() as u8
    }

    #[inline(never)]
    fn record_open(&mut self, open: u8, far_moving: u8, gap: &[f32; LANES]) {
        self.open |= open;
        self.far_moving |= far_moving;
        for (lane, &gap) in gap.iter().enumerate() {
            if gap < self.least_gap && open >> lane & 1 == 1 {
                (self.nearest, self.least_gap) = (lane as u8, gap);
            }
        }
    }
}
