//! The balls of all links in f32, and their centers in eight configurations.

use super::frames::{LaneFrame, Rows, store_vectors};
use crate::cell::cover::{CoverBall, Covers};
use crate::cell::part::HullPart;
use ccd_core::fearless_simd::Simd;
use ccd_core::order::greater;
use ccd_core::simd::Vec3x8;
use rigid_ccd::glam::{DMat3, DVec3, Vec3};
use std::ops::Range;

/// Enlarges radii beyond the rounding to f32, and reduces radii of inner balls.
const ROUNDED_UP: f64 = 1.0 + 2.0 * f32::EPSILON as f64;
const ROUNDED_DOWN: f64 = 1.0 - 2.0 * f32::EPSILON as f64;

/// The balls of all parts of a robot.
#[derive(Clone, Debug, Default)]
pub(super) struct LaneBalls {
    /// The balls that cover the parts, sorted by part, then one ball around each part.
    pub(super) all: Vec<LaneBall>,
    first_ball_by_part: Vec<usize>,
    /// For each frame a ball around all its parts; `None` if it has none.
    pub(super) ball_around_frame: Vec<Option<LaneBall>>,
    pub(super) parts_by_frame: Vec<Vec<u32>>,
    /// The radius of the largest ball, half-spaces left out.
    pub(super) largest_radius: f64,
    /// A bound of the coordinates of static parts, half-spaces left out.
    pub(super) static_reach: f64,
}

/// A ball in the frame of its link, turned as in [`LaneFrame`].
#[derive(Clone, Copy, Debug)]
pub(super) struct LaneBall {
    frame: usize,
    pub(super) center: Vec3,
    pub(super) radius: f32,
    pub(super) inner_radius: f32,
}

/// The center of a ball in eight configurations, and its velocity.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PlacedBall {
    center: Rows,
    velocity: Rows,
}

impl LaneBalls {
    pub(super) fn new(covers: &Covers, parts: &[HullPart], to_lane_frames: &[DMat3]) -> Self {
        let lane_ball = |ball: &CoverBall, frame: usize| LaneBall {
            frame,
            center: (to_lane_frames[frame] * ball.center).as_vec3(),
            radius: (ball.radius * ROUNDED_UP) as f32,
            inner_radius: (ball.inner_radius * ROUNDED_DOWN) as f32,
        };
        let mut all = Vec::new();
        for (part, range) in parts.iter().zip(covers.first_ball_by_part.windows(2)) {
            let own = &covers.balls[range[0]..range[1]];
            all.extend(own.iter().map(|ball| lane_ball(ball, part.frame)));
        }
        let around_parts = parts.iter().zip(&covers.enclosing_balls);
        all.extend(around_parts.map(|(part, ball)| lane_ball(ball, part.frame)));
        let mut parts_by_frame = vec![Vec::new(); to_lane_frames.len()];
        for (index, part) in (0..).zip(parts) {
            parts_by_frame[part.frame].push(index);
        }
        let around_frame = |(frame, parts): (usize, &Vec<u32>)| {
            let balls = parts
                .iter()
                .map(|&part| covers.enclosing_balls[part as usize]);
            Some(lane_ball(&ball_around(&balls.collect::<Vec<_>>())?, frame))
        };
        let balls_of_parts = parts.iter().zip(covers.first_ball_by_part.windows(2));
        let largest_radius = balls_of_parts
            .filter(|(part, _)| part.plane.is_none())
            .flat_map(|(_, range)| &covers.balls[range[0]..range[1]])
            .map(|ball| ball.radius)
            .fold(0.0, greater);
        let static_parts = parts
            .iter()
            .filter(|part| part.frame == 0 && part.plane.is_none());
        LaneBalls {
            static_reach: static_parts
                .map(|part| part.coordinate_bound)
                .fold(0.0, greater),
            all,
            first_ball_by_part: covers.first_ball_by_part.clone(),
            ball_around_frame: parts_by_frame
                .iter()
                .enumerate()
                .map(around_frame)
                .collect(),
            parts_by_frame,
            largest_radius,
        }
    }

    /// Returns the indices of the balls that cover a part.
    #[inline(always)]
    pub(super) fn of_part(&self, part: usize) -> Range<usize> {
        self.first_ball_by_part[part]..self.first_ball_by_part[part + 1]
    }

    /// Returns the index of the ball around a part.
    #[inline(always)]
    pub(super) fn around_part(&self, part: usize) -> usize {
        self.first_ball_by_part[self.first_ball_by_part.len() - 1] + part
    }

    /// Computes the centers and velocities of all balls.
    #[inline(always)]
    pub(super) fn place<L: Simd>(
        &self,
        level: L,
        frames: &[LaneFrame],
        placed: &mut Vec<PlacedBall>,
    ) {
        placed.resize(self.all.len(), PlacedBall::default());
        for (ball, placed) in self.all.iter().zip(placed) {
            let [center, velocity] = frames[ball.frame].load(level).point(level, ball.center);
            store_vectors(center, &mut placed.center);
            store_vectors(velocity, &mut placed.velocity);
        }
    }
}

impl PlacedBall {
    #[inline(always)]
    pub(super) fn load<L: Simd>(&self, level: L) -> (Vec3x8<L>, Vec3x8<L>) {
        (
            Vec3x8::load(level, &self.center),
            Vec3x8::load(level, &self.velocity),
        )
    }
}

/// Returns a ball around balls, about the mean of their centers; `None` if there are none.
fn ball_around(balls: &[CoverBall]) -> Option<CoverBall> {
    if balls.is_empty() {
        return None;
    }
    let center = balls.iter().map(|ball| ball.center).sum::<DVec3>() / balls.len() as f64;
    let reach = |ball: &CoverBall| ball.center.distance(center) + ball.radius;
    Some(CoverBall {
        center,
        radius: balls.iter().map(reach).fold(0.0, greater) * (1.0 + 1e-12),
        inner_radius: f64::NEG_INFINITY,
    })
}
