//! The first test of a path: eight intervals at once, in f32.
//!
//! | step | file |
//! |---|---|
//! | balls that cover the links, made once a robot | `cell/cover.rs` |
//! | the motion in eight intervals | `path/lanes.rs`, `ball_test/intervals.rs` |
//! | the frames of all links at the midpoints of eight intervals, with velocities | `ball_test/frames.rs`, `sine.rs` |
//! | the obstacles that a ball around each link may meet in any of the intervals | `obstacles.rs` |
//! | for each ball, the distances of its center, and how far the center gets | `ball_test.rs` |
//! | the result for a pair | `tested_pair.rs` |
//! | links against links: tables of distances, and balls against balls | `self_pairs.rs`, `distance_table.rs` |
//! | bounds of rounding errors | `error.rs` |
//!
//! Let `c` be the center of a ball at the midpoint of an interval, `v` its velocity there, `h` half the length of the
//! interval and `M` a bound of the second derivative of its position. Within the interval, the center stays within
//! `h |v| + h² M / 2` of `c`. If its distance from an obstacle exceeds that and the radius, the ball is free in the
//! interval. A ball does not turn about its center, so only the center matters. If the distance is less than the radius
//! of a ball inside the link, the link touches the obstacle.

mod distance_table;
mod error;
mod frames;
mod intervals;
mod obstacles;
mod placed_balls;
mod self_pairs;
mod sine;
mod tested_pair;

use super::part_pairs::{PartPair, PartPairs};
use crate::cell::Cell;
use crate::cell::ball_model::BallModel;
use crate::cell::cover::Covers;
use crate::kinematics::joint_arms::{JointArms, JointMotion};
use crate::path::joint_path::JointPath;
use crate::path::lanes::{LANES, Lanes};
use ccd_core::fearless_simd::{Simd, f32x8};
use ccd_core::order::greater;
use ccd_core::schedule::VectorInstructions;
use ccd_core::simd::{Vec3x8, splat};
use ccd_core::vectorize;
use error::{ENLARGED, LaneErrors};
use frames::{LaneFrame, LaneJoint, place_frames};
use obstacles::Obstacles;
use placed_balls::{LaneBall, LaneBalls, PlacedBall};
use self_pairs::SelfPair;
use std::collections::HashMap;
use tested_pair::BallGaps;
pub(crate) use tested_pair::{BallPair, Margins, TestedPair, TouchingPair};

/// Tests eight intervals of a path at once.
pub(crate) struct BallTest<'c> {
    cell: &'c Cell,
    joints: Vec<LaneJoint>,
    balls: LaneBalls,
    obstacles: Obstacles,
    self_pairs: Vec<SelfPair>,
    /// The joints between frames and their ancestors: first for each frame and the base, then for pairs.
    arms: Vec<JointArms>,
    /// The number of these that the test uses. The others are those of pairs with a table.
    tested_arms: usize,
    // For the current path:
    /// A bound of the distance of any point of a robot's part from the base and from any joint axis.
    longest_arm: f64,
    pose_rounding: f64,
    // For the current intervals:
    /// The segment that contains all of them, if there is one.
    segment: Option<usize>,
    /// Bounds of the motions of all joints in the segment, or of their motions along chords.
    motions: Vec<JointMotion>,
    /// Bounds of the deviations of all joints from these motions.
    deviations: Vec<f64>,
    /// The intervals whose midpoint belongs to the path, as bits.
    exact_lanes: u8,
    errors: LaneErrors,
    /// For each obstacle the errors of gaps, and of distances that prove a contact.
    obstacle_errors: Vec<[f64; 2]>,
    /// For each of the tested `arms`, a bound of the second derivatives of positions, and of displacements by deviations.
    motion_bounds: Vec<[f64; 2]>,
    half_length: f64,
    /// For each joint, its positions at the ends of all intervals.
    ends: Vec<[f64; LANES + 1]>,
    configuration: Vec<f64>,
    positions: Vec<[f32; LANES]>,
    rates: Vec<[f32; LANES]>,
    frames: Vec<LaneFrame>,
    placed: Vec<PlacedBall>,
    /// The tested pairs, and what the test has found out about each. Pairs with obstacles are sorted by part.
    tested: Vec<TestedPair>,
    /// A pair that is proven to touch at the midpoint of an interval.
    touching: Option<TouchingPair>,
    near: Vec<u32>,
}

impl<'c> BallTest<'c> {
    pub(crate) fn new(cell: &'c Cell, pairs: &PartPairs<'c>) -> Self {
        let model = cell.ball_model(|| BallModel {
            covers: Covers::of_parts(&cell.parts()[..cell.robot_part_count()]),
            tables: distance_table::tables_of(cell, pairs.self_pairs()),
        });
        let kinematics = cell.kinematics();
        let (joints, to_lane_frames) = LaneJoint::of_robot(kinematics);
        let robot_parts = &cell.parts()[..cell.robot_part_count()];
        let points_of = |frame: usize| {
            let parts = robot_parts.iter().filter(|part| part.frame == frame);
            let points = parts.flat_map(|part| part.points().iter().copied());
            points.collect::<Vec<_>>()
        };
        let frame_count = joints.len() + 1;
        let new_arms = |[frame, ancestor]: [usize; 2]| {
            JointArms::new(kinematics, (frame, &points_of(frame)), ancestor)
        };
        let mut arms: Vec<JointArms> = (0..frame_count).map(|frame| new_arms([frame, 0])).collect();
        let mut index_by_frames = HashMap::new();
        let mut index_of = |frames: [usize; 2]| match frames {
            [frame, 0] => frame,
            _ => *index_by_frames.entry(frames).or_insert_with(|| {
                arms.push(new_arms(frames));
                arms.len() - 1
            }),
        };
        let mut self_pairs = Vec::new();
        for (pair, table) in pairs.self_pairs().iter().zip(&model.tables) {
            let parts = [pair.a as usize, pair.b as usize];
            self_pairs.push(SelfPair::new(cell, parts, table.as_ref()));
        }
        let (without_table, with_table): (Vec<_>, Vec<_>) =
            self_pairs.iter_mut().partition(|pair| !pair.has_table());
        let mut tested_arms = frame_count;
        for pair in without_table {
            pair.set_arms(&mut index_of);
            tested_arms = tested_arms.max(1 + pair.arms[0].max(pair.arms[1]));
        }
        for pair in with_table {
            pair.set_arms(&mut index_of);
        }
        BallTest {
            balls: LaneBalls::new(&model.covers, robot_parts, &to_lane_frames),
            obstacles: Obstacles::new(&cell.parts()[robot_parts.len()..], robot_parts.len()),
            self_pairs,
            segment: None,
            motions: Vec::new(),
            deviations: Vec::new(),
            exact_lanes: 0,
            longest_arm: 0.0,
            pose_rounding: 0.0,
            errors: LaneErrors::default(),
            obstacle_errors: Vec::new(),
            motion_bounds: Vec::new(),
            tested_arms,
            arms,
            half_length: 0.0,
            ends: vec![[0.0; LANES + 1]; joints.len()],
            configuration: Vec::new(),
            positions: vec![[0.0; LANES]; joints.len()],
            rates: vec![[0.0; LANES]; joints.len()],
            frames: vec![LaneFrame::BASE; frame_count],
            placed: Vec::new(),
            tested: Vec::new(),
            touching: None,
            near: Vec::new(),
            joints,
            cell,
        }
    }

    /// Returns a bound of the sum of the speeds that all joints give to any point, in a segment of the path.
    pub(crate) fn speed_bound(&self, (path, segment): (&JointPath, usize)) -> f64 {
        let joints = self.cell.kinematics().joints().iter().enumerate();
        let speeds = joints.map(|(k, joint)| {
            let arm = if joint.is_prismatic {
                1.0
            } else {
                self.longest_arm
            };
            path.joint_motion(segment, k).rate * arm
        });
        speeds.sum()
    }

    /// Returns a bound of the second derivatives of both parts' positions relative to their common ancestor frame, in a
    /// segment of the path.
    pub(crate) fn acceleration_bound(
        &self,
        (path, segment): (&JointPath, usize),
        pair: BallPair,
    ) -> f64 {
        let motion = |joint: usize| path.joint_motion(segment, joint);
        let of_arms = |arms: usize| self.arms[arms].acceleration_bound(motion);
        match pair {
            BallPair::Obstacle { part, .. } => of_arms(self.cell.parts()[part as usize].frame),
            BallPair::OfRobot(index) => {
                let [a, b] = self.self_pairs[index as usize].arms;
                of_arms(a) + of_arms(b)
            }
        }
    }

    /// Returns the pair with its margin.
    pub(crate) fn part_pair(&self, pairs: &PartPairs<'c>, pair: BallPair) -> PartPair {
        match pair {
            BallPair::Obstacle { part, obstacle } => {
                let obstacle = self.obstacles.all[obstacle as usize].part;
                pairs.pair_with_obstacle([part as usize, obstacle])
            }
            BallPair::OfRobot(index) => pairs.self_pairs()[index as usize],
        }
    }

    /// Tests eight intervals: for the pairs `among`, with the margins that they have, or for all pairs if it is `None`.
    /// The result is in [`BallTest::open_pairs`], and in [`BallTest::touching`] if a pair touches. If it does, some pairs
    /// are not tested. Returns whether the test can be used for the intervals.
    #[must_use]
    pub(crate) fn test(
        &mut self,
        (path, lanes): (&JointPath, &Lanes),
        (pairs, margins): (&PartPairs<'c>, Margins),
        among: Option<&[TestedPair]>,
    ) -> bool {
        let simd_level = VectorInstructions::Best.simd_level();
        vectorize!(simd_level, level => self.test_intervals(level, (path, lanes), (pairs, margins), among))
    }

    /// Returns the tested pairs that are open in some interval.
    pub(crate) fn open_pairs(&self) -> impl Iterator<Item = &TestedPair> {
        self.tested.iter().filter(|pair| pair.open != 0)
    }

    /// Returns the radius of the largest ball.
    pub(crate) fn largest_radius(&self) -> f64 {
        self.balls.largest_radius
    }

    /// Returns a bound of the distance of any point from the base.
    pub(crate) fn reach(&self) -> f64 {
        self.longest_arm
    }

    pub(crate) fn touching(&self) -> Option<TouchingPair> {
        self.touching
    }

    /// Returns the number of the pairs that the last test compared.
    pub(crate) fn tested_pair_count(&self) -> usize {
        self.tested.len()
    }

    #[inline(always)]
    fn test_intervals<L: Simd>(
        &mut self,
        level: L,
        (path, lanes): (&JointPath, &Lanes),
        pairs: (&PartPairs<'c>, Margins),
        among: Option<&[TestedPair]>,
    ) -> bool {
        self.touching = None;
        self.tested.clear();
        if !self.set_intervals(path, lanes) {
            return false;
        }
        place_frames(
            level,
            &self.joints,
            (&self.positions, &self.rates),
            &mut self.frames,
        );
        self.balls.place(level, &self.frames, &mut self.placed);
        match among {
            Some(among) => {
                self.tested.extend(among.iter().map(TestedPair::untested));
                self.renew_touching_errors();
            }
            None => self.append_all_pairs(level, pairs),
        }
        let mut first = 0;
        while first < self.tested.len() && self.touching.is_none() {
            match self.tested[first].pair {
                BallPair::Obstacle { part, .. } => {
                    first = self.compare_obstacles(level, part, first);
                }
                BallPair::OfRobot(index) => {
                    self.compare_self_pair(level, first, index as usize);
                    first += 1;
                }
            }
        }
        true
    }

    /// Sets the errors of distances that prove a contact to those of the current intervals.
    fn renew_touching_errors(&mut self) {
        for index in 0..self.tested.len() {
            let [_, error] = self.errors_of(self.tested[index].pair);
            self.tested[index].set_touching_error(error);
        }
    }

    /// Returns the errors of a pair's gaps, and of distances that prove a contact.
    #[inline(always)]
    fn errors_of(&self, pair: BallPair) -> [f64; 2] {
        match pair {
            BallPair::Obstacle { obstacle, .. } => self.obstacle_errors[obstacle as usize],
            BallPair::OfRobot(index) => self.self_pair_errors(index as usize),
        }
    }

    /// Appends the pairs of all links with the obstacles that may come near them, and the pairs of the robot's own
    /// parts. The links farthest from the base come first: they get farther, and touch more often.
    #[inline(always)]
    fn append_all_pairs<L: Simd>(&mut self, level: L, (pairs, margins): (&PartPairs<'c>, Margins)) {
        let parts = self.cell.parts();
        for frame in (1..self.frames.len()).rev() {
            let Some(ball) = self.balls.ball_around_frame[frame] else {
                continue;
            };
            let displacement = self.displacement_beyond_velocity(frame);
            let half_length = splat(level, self.half_length as f32);
            let [centers, velocities] = self.frames[frame].load(level).point(level, ball.center);
            let middle = 0.5 * (vector_of_lane(centers, 3) + vector_of_lane(centers, 4));
            let offset = centers - Vec3x8::splat(level, middle);
            let reach = offset.length() + velocities.length() * half_length;
            let mut farthest = 0.0;
            for lane in 0..LANES {
                farthest = greater(farthest, reach[lane]);
            }
            let radius = (f64::from(farthest) + f64::from(ball.radius)) * ENLARGED
                + displacement
                + margins.of_pair(pairs.largest_obstacle_margin());
            self.near.clear();
            let near = &mut self.near;
            let point = (middle, self.longest_arm);
            self.obstacles
                .for_each_near(level, point, radius, |obstacle| near.push(obstacle));
            for &part in &self.balls.parts_by_frame[frame] {
                for &obstacle in &self.near {
                    let both = [part as usize, self.obstacles.all[obstacle as usize].part];
                    let bodies = both.map(|part| parts[part].owner);
                    if !self.cell.is_allowed(bodies) && !pairs.is_ignored(bodies) {
                        let pair = BallPair::Obstacle { part, obstacle };
                        let margin = margins.of_pair(pairs.obstacle_margin(bodies));
                        let errors = self.errors_of(pair);
                        self.tested.push(TestedPair::new(pair, margin, errors));
                    }
                }
            }
        }
        for (index, pair) in (0..).zip(pairs.self_pairs()) {
            if pairs.is_ignored(pair.body_indices(parts)) {
                continue;
            }
            let margin = margins.of_pair(pair.margin);
            let pair = BallPair::OfRobot(index);
            let errors = self.errors_of(pair);
            self.tested.push(TestedPair::new(pair, margin, errors));
        }
    }

    /// Compares a part with obstacles: the tested pairs from the index `first` that begin with the part. Returns the
    /// index of the next pair.
    #[inline(always)]
    fn compare_obstacles<L: Simd>(&mut self, level: L, part: u32, first: usize) -> usize {
        let of_part = |tested: &TestedPair| match tested.pair {
            BallPair::Obstacle { part: own, .. } => own == part,
            BallPair::OfRobot(_) => false,
        };
        let count = self.tested[first..]
            .iter()
            .take_while(|pair| of_part(pair))
            .count();
        let frame = self.cell.parts()[part as usize].frame;
        let displacement = self.displacement_beyond_velocity(frame);
        for index in self.balls.of_part(part as usize) {
            let ball: LaneBall = self.balls.all[index];
            let (center, velocity) = self.placed[index].load(level);
            let way = self.way(level, velocity, displacement);
            for k in first..first + count {
                let BallPair::Obstacle { obstacle, .. } = self.tested[k].pair else {
                    continue;
                };
                let gaps = BallGaps {
                    gap: self.obstacles.all[obstacle as usize].distances(level, center)
                        - splat(level, ball.radius),
                    way,
                    inner_gap: ball.inner_radius - ball.radius,
                };
                self.record(level, k, gaps);
            }
        }
        first + count
    }

    /// Returns a bound of the displacement of a point in half an interval, without the part that follows from its
    /// velocity: by the second derivative, deviations and errors. `arms` is an index of `motion_bounds`.
    #[inline(always)]
    fn displacement_beyond_velocity(&self, arms: usize) -> f64 {
        let (h, [acceleration, deviation]) = (self.half_length, self.motion_bounds[arms]);
        let displacement = 0.5 * h * h * acceleration + deviation;
        (displacement + h * self.errors.velocity + self.errors.position) * ENLARGED
    }

    /// Returns how far balls get in half an interval, from their velocities and from the rest of the displacement.
    #[inline(always)]
    fn way<L: Simd>(&self, level: L, velocity: Vec3x8<L>, displacement: f64) -> f32x8<L> {
        let half_length = splat(level, (self.half_length * ENLARGED) as f32);
        velocity.length() * half_length + splat(level, displacement as f32)
    }

    /// Records the intervals in which a ball of a tested pair may touch.
    #[inline(always)]
    fn record<L: Simd>(&mut self, level: L, index: usize, gaps: BallGaps<L>) {
        let tested = &mut self.tested[index];
        let touching = tested.record(level, gaps) & self.exact_lanes;
        if touching != 0 {
            let lane = touching.trailing_zeros() as usize;
            if self.touching.is_none_or(|known| lane < known.lane) {
                self.touching = Some(TouchingPair {
                    pair: tested.pair,
                    lane,
                });
            }
        }
    }
}

#[inline(always)]
fn vector_of_lane<L: Simd>(vectors: Vec3x8<L>, lane: usize) -> rigid_ccd::glam::Vec3 {
    rigid_ccd::glam::Vec3::new(vectors.x[lane], vectors.y[lane], vectors.z[lane])
}

#[cfg(test)]
mod tests;
