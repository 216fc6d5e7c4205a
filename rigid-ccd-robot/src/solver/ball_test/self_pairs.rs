//! Links against links: by a table of distances, or balls against balls.

use super::error::{ENLARGED, UNIT_ROUNDOFF};
use super::frames::LoadedFrame;
use super::obstacles::Obstacle;
use super::{BallGaps, BallTest, LANES};
use crate::cell::Cell;
use crate::cell::ball_model::DistanceTable;
use ccd_core::fearless_simd::{Simd, f32x8, prelude::*};
use ccd_core::order::greater;
use ccd_core::simd::{load, splat};
use std::f64::consts::TAU;

/// The error of the number of a cell in a table, in units of roundoff: an angle is subtracted, divided by a turn, and
/// multiplied.
const CELL_NUMBER_ERROR: f64 = 16.0;

/// The error of the gap between two balls, in units of roundoff of the longest arm.
const BALL_GAP_ERROR: f64 = 16.0;

/// Two parts of the robot that are checked against each other.
#[derive(Clone, Debug)]
pub(super) struct SelfPair {
    parts: [usize; 2],
    /// The nearest common ancestor of both frames.
    common_frame: usize,
    /// For both parts, the indices of the bounds of their motion relative to the common frame.
    pub(super) arms: [usize; 2],
    table: Option<LaneTable>,
    /// The half-space of the second part, if it is one.
    half_space: Option<Obstacle>,
    /// Whether both parts are exactly their bodies.
    is_convex: bool,
}

/// A table of distances in f32.
#[derive(Clone, Debug)]
struct LaneTable {
    axes: Vec<LaneAxis>,
    /// The distances, then one entry of 0 for angles outside the table.
    distances: Vec<f32>,
}

/// An axis of a table.
#[derive(Clone, Copy, Debug)]
struct LaneAxis {
    joint: usize,
    low: f32,
    cells_per_turn: f32,
    cell_count: f32,
    arm_length: f64,
}

impl SelfPair {
    pub(super) fn new(cell: &Cell, parts: [usize; 2], table: Option<&DistanceTable>) -> Self {
        let frames = parts.map(|part| cell.parts()[part].frame);
        let second = &cell.parts()[parts[1]];
        SelfPair {
            parts,
            common_frame: cell.kinematics().common_frame(frames),
            arms: frames,
            table: table.map(LaneTable::new),
            half_space: second.plane.map(|_| Obstacle::new(second, parts[1])),
            is_convex: parts.iter().all(|&part| cell.parts()[part].is_convex),
        }
    }

    pub(super) fn has_table(&self) -> bool {
        self.table.is_some()
    }

    /// Sets the joints between the frames of both parts and their common frame. `index_of` returns the index of those
    /// between a frame and its ancestor.
    pub(super) fn set_arms(&mut self, mut index_of: impl FnMut([usize; 2]) -> usize) {
        // At first the arms are the frames.
        self.arms = self.arms.map(|frame| index_of([frame, self.common_frame]));
    }
}

impl LaneTable {
    fn new(table: &DistanceTable) -> Self {
        let axes = table.axes.iter().map(|axis| LaneAxis {
            joint: axis.joint,
            low: axis.low as f32,
            cells_per_turn: (TAU / axis.cell_size) as f32,
            cell_count: axis.cell_count as f32,
            arm_length: axis.arm_length,
        });
        let mut distances = table.distances.clone();
        distances.push(0.0);
        LaneTable {
            axes: axes.collect(),
            distances,
        }
    }

    /// Returns lower bounds of the distance for eight configurations; 0 outside the table.
    #[inline(always)]
    fn lower_bounds<L: Simd>(&self, level: L, positions: &[[f32; LANES]]) -> f32x8<L> {
        let number = |x: f32| splat(level, x);
        let outside = number((self.distances.len() - 1) as f32);
        let (mut index, mut is_inside) = (number(0.0), number(0.0).simd_eq(number(0.0)));
        for axis in self.axes.iter().rev() {
            let angle = load(level, &positions[axis.joint]) - number(axis.low);
            let turns = angle * number((1.0 / TAU) as f32);
            let cell = (turns - turns.floor()) * number(axis.cells_per_turn);
            let cell = cell.floor();
            let count = number(axis.cell_count);
            is_inside = is_inside & cell.simd_lt(count) & cell.simd_ge(number(0.0));
            index = index * count + cell;
        }
        let mut indices = [0.0; LANES];
        is_inside.select(index, outside).store_slice(&mut indices);
        let mut distances = [0.0; LANES];
        for lane in 0..LANES {
            let found = self.distances.get(indices[lane] as usize);
            distances[lane] = found.copied().unwrap_or(0.0);
        }
        load(level, &distances)
    }
}

impl BallTest<'_> {
    /// Returns bounds of the errors of a pair's gaps, and of distances that prove a contact.
    pub(super) fn self_pair_errors(&self, index: usize) -> [f64; 2] {
        let pair = &self.self_pairs[index];
        if pair.table.is_some() {
            return [2.0 * self.pose_rounding, f64::INFINITY];
        }
        match &pair.half_space {
            Some(half_space) => {
                let error = half_space.error(self.longest_arm);
                [error, error + self.errors.position]
            }
            None => {
                let error = BALL_GAP_ERROR * UNIT_ROUNDOFF * self.longest_arm;
                let touching_error = if pair.is_convex {
                    error + 2.0 * self.errors.position
                } else {
                    f64::INFINITY
                };
                [error, touching_error]
            }
        }
    }

    /// Compares two parts of the robot.
    #[inline(always)]
    pub(super) fn compare_self_pair<L: Simd>(&mut self, level: L, tested: usize, index: usize) {
        let pair = &self.self_pairs[index];
        if let Some(table) = &pair.table {
            let gaps = BallGaps {
                gap: table.lower_bounds(level, &self.positions),
                way: splat(level, self.displacement_in_table(table) as f32),
                inner_gap: f32::NEG_INFINITY,
            };
            return self.record(level, tested, gaps);
        }
        let ([a, b], arms) = (pair.parts, pair.arms);
        if let Some(half_space) = pair.half_space {
            return self.compare_half_space(level, tested, (a, arms[0]), &half_space);
        }
        let common = self.frames[pair.common_frame].load(level);
        let around = [self.balls.around_part(a), self.balls.around_part(b)];
        let displacement = self.displacement_of_pair(arms);
        let gaps = self.ball_gaps(level, around, &common, displacement);
        let required = gaps.way + splat(level, self.tested[tested].allowance);
        if gaps.gap.simd_gt(required).to_bitmask() as u8 == u8::MAX {
            return;
        }
        for one in self.balls.of_part(a) {
            for other in self.balls.of_part(b) {
                let gaps = self.ball_gaps(level, [one, other], &common, displacement);
                self.record(level, tested, gaps);
            }
        }
    }

    /// Compares two balls, by their velocities relative to a frame.
    #[inline(always)]
    fn ball_gaps<L: Simd>(
        &self,
        level: L,
        [one, other]: [usize; 2],
        common: &LoadedFrame<L>,
        displacement: f64,
    ) -> BallGaps<L> {
        let (ball, other_ball) = (&self.balls.all[one], &self.balls.all[other]);
        let (center, velocity) = self.placed[one].load(level);
        let (other_center, other_velocity) = self.placed[other].load(level);
        let offset = center - other_center;
        let velocity = velocity - other_velocity - common.angular_velocity.cross(offset);
        let radii = ball.radius + other_ball.radius;
        BallGaps {
            gap: offset.length() - splat(level, radii),
            way: self.way(level, velocity, displacement),
            inner_gap: ball.inner_radius + other_ball.inner_radius - radii,
        }
    }

    /// Compares the balls of a part with a half-space.
    #[inline(always)]
    fn compare_half_space<L: Simd>(
        &mut self,
        level: L,
        tested: usize,
        (part, arms): (usize, usize),
        half_space: &Obstacle,
    ) {
        let displacement = self.displacement_beyond_velocity(arms);
        for index in self.balls.of_part(part) {
            let ball = self.balls.all[index];
            let (center, velocity) = self.placed[index].load(level);
            let gaps = BallGaps {
                gap: half_space.distances(level, center) - splat(level, ball.radius),
                way: self.way(level, velocity, displacement),
                inner_gap: ball.inner_radius - ball.radius,
            };
            self.record(level, tested, gaps);
        }
    }

    /// Returns a bound of the relative displacement of two balls in half an interval, without the part that follows
    /// from their velocities. Velocities and positions have two errors, and the velocity of the common frame a third.
    #[inline(always)]
    fn displacement_of_pair(&self, [one, other]: [usize; 2]) -> f64 {
        let h = self.half_length;
        let [a, b] = [one, other].map(|arms| self.motion_bounds[arms]);
        let displacement = 0.5 * h * h * (a[0] + b[0])
            + (a[1] + b[1])
            + 3.0 * h * self.errors.velocity
            + 2.0 * self.errors.position;
        displacement * ENLARGED
    }

    /// Returns a bound of the displacement in half an interval, by the table's joints and by the error of their angles.
    #[inline(always)]
    fn displacement_in_table(&self, table: &LaneTable) -> f64 {
        let mut displacement = 0.0;
        for axis in &table.axes {
            let turn =
                self.motions[axis.joint].rate * self.half_length + self.deviations[axis.joint];
            let angle_error = self.errors.angle
                + CELL_NUMBER_ERROR * UNIT_ROUNDOFF * greater(TAU, f64::from(axis.low.abs()));
            displacement += (turn + 2.0 * angle_error) * axis.arm_length;
        }
        displacement * ENLARGED
    }
}
