//! Advances along a pair's open interval, from its nearest point in both directions.
//!
//! At a point of the path the distance of both parts is measured, with the axis along which they are so far apart. No
//! corner approaches the other part along the axis faster than some speed `a`, and the second derivative of its height is
//! at most `M`. So the distance `g` lasts for the time `s` with `a s + M s² / 2 = g`: forwards with the fastest approach,
//! and backwards with the fastest one in the other direction `[FAST06 §4.2]`.

use super::PathSearch;
use super::open_intervals::OpenInterval;
use super::undecided::UndecidedInterval;
use crate::cell::part::HullPart;
use crate::kinematics::moving_frame::MovingFrame;
use crate::solver::Goal;
use crate::solver::measure::{initial_direction, minkowski_support_vertex};
use crate::solver::part_pairs::PartPair;
use crate::tuning::{
    ADVANCE_ACCURACY, LEAST_DISTANCE_ACCURACY, MAX_ADVANCES, PAIRS_BETWEEN_CLOCK_READS,
};
use ccd_core::order::{greater, lesser};
use ccd_core::schedule::VectorInstructions;
use ccd_core::vectorize;
use ccd_distance_gjk::{DistanceBounds, TerminationBounds, bound_distance};
use rigid_ccd::Error;
use rigid_ccd::glam::DVec3;
use std::ops::ControlFlow::{self, Break, Continue};

/// Shortens steps beyond their rounding errors.
const ROUNDED_DOWN: f64 = 1.0 - 1e-9;

/// The rounding error of a speed, in errors of directions, for each unit of the sum of the speeds that all joints give to
/// a point: such a speed is a product of an axis, an arm and a direction.
const SPEED_ERROR: f64 = 4.0;

/// Both parts of a pair at a point of the path, relative to their common ancestor frame.
struct PlacedPair<'c> {
    parts: [&'c HullPart; 2],
    frames: [MovingFrame; 2],
}

/// Bounds of a pair's motion in a segment.
#[derive(Clone, Copy, Debug)]
struct PairMotion {
    /// A bound of the second derivatives of both parts' positions relative to their common ancestor frame.
    acceleration: f64,
    speed_error: f64,
}

/// What is known about a pair around a point of the path.
enum Advance {
    /// The pair stays farther apart than its margin over the whole interval.
    Free,
    /// The parts are within margin + tolerance; in a search for the least distance, they touch.
    Near,
    /// The parts are nearer than the least distance so far, but what they enclose may not be.
    Undecided,
    /// The pair is free for this long before and after the point.
    Steps { back: f64, forth: f64 },
}

impl PathSearch<'_> {
    /// Searches the interval of a pair. Adds what stays undecided to `undecided`, and returns where that begins; infinity
    /// if nothing stays undecided.
    ///
    /// # Errors
    /// Errors of the engine.
    pub(super) fn search_open_interval(
        &mut self,
        open: &OpenInterval,
    ) -> Result<ControlFlow<(), f64>, Error> {
        let mut pair = self.ball_test.part_pair(&self.pairs, open.pair);
        let motion = self.motion_of_pair(open);
        self.set_joints_between(&pair);
        let mut left = std::mem::take(&mut self.unsearched);
        left.clear();
        left.push([open.from, open.to]);
        let mut at = open.nearest;
        let (mut step, mut count) = (Continue(()), 0);
        let mut undecided_at = None;
        while let Some([from, to]) = left.pop() {
            let to = lesser(to, self.result.end);
            // Written so that NaN is searched.
            if from > to || from >= self.result.end {
                continue;
            }
            count += 1;
            if count % PAIRS_BETWEEN_CLOCK_READS == 1 && self.check_limit_before(from).is_break() {
                step = Break(());
                break;
            }
            if count > MAX_ADVANCES {
                left.push([from, to]);
                break;
            }
            // An interval that ends with a contact is searched from its start.
            if !(from <= at && at <= to) {
                at = if to == self.result.end {
                    from
                } else {
                    0.5 * (from + to)
                };
            }
            self.stop_condition.add_work(1);
            let simd_level = VectorInstructions::Best.simd_level();
            let advance = vectorize!(simd_level, _token => self.advance(&mut pair, open, [from, at, to], motion));
            match advance {
                Advance::Free => {}
                Advance::Near if pair.is_convex(self.cell.parts()) => {
                    if self.record_contact(&pair, at, 0.0).is_break() {
                        step = Break(());
                        break;
                    }
                    if from < at {
                        left.push([from, at]);
                    }
                }
                Advance::Near | Advance::Undecided => {
                    left.push([from, to]);
                    undecided_at = Some(at);
                    break;
                }
                Advance::Steps { back, forth } => {
                    push_rest(&mut left, [from, at, to], [back, forth]);
                }
            }
            at = f64::NAN;
        }
        let bodies = pair.body_indices(self.cell.parts());
        let is_known = self.undecided.contains(open.segment, bodies);
        let earliest = self.leave_undecided(&pair, open, &left);
        self.unsearched = left;
        if let (Goal::AnyContact, Some(at), false) = (self.goal, undecided_at, is_known) {
            // A contact of some pair ends the search. Intervals take the engine longer than points.
            step = self.check_nonconvex_candidate(&pair, bodies, at)?;
        }
        Ok(match step {
            Continue(()) => Continue(earliest),
            Break(()) => Break(()),
        })
    }

    /// Adds intervals of a pair to the undecided ones. Returns where the earliest of them begins.
    fn leave_undecided(&mut self, pair: &PartPair, open: &OpenInterval, left: &[[f64; 2]]) -> f64 {
        let bodies = pair.body_indices(self.cell.parts());
        // Written so that NaN stays undecided. An interval without length is measured.
        let undecided = left.iter().filter(|[from, to]| from != to);
        let undecided = undecided.map(|&[from, to]| UndecidedInterval {
            segment: open.segment,
            bodies,
            pair: *pair,
            from,
            to,
            gap: open.gap,
        });
        self.undecided.extend(undecided)
    }

    fn motion_of_pair(&self, open: &OpenInterval) -> PairMotion {
        let segment = (&self.path, open.segment);
        PairMotion {
            acceleration: self.ball_test.acceleration_bound(segment, open.pair),
            speed_error: SPEED_ERROR
                * self.placement.rounding_of_directions
                * self.ball_test.speed_bound(segment),
        }
    }

    /// Finds the joints between the common ancestor frame and both parts of a pair, parents first.
    fn set_joints_between(&mut self, pair: &PartPair) {
        let kinematics = self.cell.kinematics();
        let frames = [pair.a, pair.b].map(|part| self.cell.parts()[part as usize].frame);
        let common = kinematics.common_frame(frames);
        for (joints, frame) in self.joints_between.iter_mut().zip(frames) {
            joints.clear();
            joints.extend(kinematics.joints_between([frame, common]));
            joints.reverse();
        }
    }

    /// Measures a pair at the point `at` of an interval.
    #[inline(always)]
    fn advance(
        &mut self,
        pair: &mut PartPair,
        open: &OpenInterval,
        [from, at, to]: [f64; 3],
        PairMotion {
            acceleration,
            speed_error,
        }: PairMotion,
    ) -> Advance {
        let (path, segment) = (&self.path, open.segment);
        path.interpolate_in_segment(segment, at, &mut self.positions);
        path.rates_in_segment(segment, at, &mut self.rates);
        let (cell, [joints_a, joints_b]) = (self.cell, &self.joints_between);
        let kinematics = cell.kinematics();
        let placed = PlacedPair {
            parts: [pair.a, pair.b].map(|part| &cell.parts()[part as usize]),
            frames: [
                kinematics.moving_frame(joints_a, &self.positions, &self.rates),
                kinematics.moving_frame(joints_b, &self.positions, &self.rates),
            ],
        };
        let rounding = 2.0 * self.placement.rounding;
        let radii = placed.parts[0].radius + placed.parts[1].radius;
        let half_length = greater(at - from, to - at);
        let speed = placed.speed_bound() + speed_error;
        let displacement =
            half_length * (speed + 0.5 * half_length * acceleration) * (2.0 - ROUNDED_DOWN);
        let thresholds = self.thresholds(pair, 0.0);
        let until = TerminationBounds {
            sufficient_lower_bound: displacement
                + thresholds.free_distance_threshold
                + rounding
                + radii,
            sufficient_upper_bound: thresholds.near_distance - rounding + radii,
        };
        // In a search for the least distance, the pair's own distance lowers the threshold.
        let excess = placed.parts[0].excess_over_shape + placed.parts[1].excess_over_shape;
        let upper_bound = |bounds: &DistanceBounds| bounds.upper - radii + rounding + excess;
        let (least, accuracy) = match self.goal {
            Goal::LeastDistance if pair.is_convex(cell.parts()) => {
                (-self.tolerance, LEAST_DISTANCE_ACCURACY)
            }
            _ => (f64::INFINITY, ADVANCE_ACCURACY),
        };
        let bounds = placed.distance_bounds(
            pair.axis,
            #[inline(always)]
            |bounds: &DistanceBounds| {
                let own = upper_bound(bounds) + least;
                let threshold = radii + lesser(thresholds.free_distance_threshold, own);
                until.are_met_by(bounds)
                    || bounds.lower - threshold > accuracy * (bounds.upper - threshold)
            },
        );
        if bounds.lower > until.sufficient_lower_bound {
            return Advance::Free;
        }
        pair.axis = bounds.axis;
        pair.distance_to_proof_ratio =
            (bounds.lower - radii) / (until.sufficient_lower_bound - radii);
        if bounds.upper <= until.sufficient_upper_bound {
            return Advance::Near;
        }
        let upper = upper_bound(&bounds);
        if pair.is_convex(cell.parts()) && self.is_nearest(upper) {
            self.record_nearest(pair, at, upper);
        }
        let threshold = self.thresholds(pair, 0.0).free_distance_threshold;
        let gap = bounds.lower - radii - threshold - rounding;
        // Written so that NaN gives no steps.
        if !(gap > 0.0) && self.goal == Goal::LeastDistance {
            return Advance::Undecided;
        }
        if !(gap > 0.0) {
            return Advance::Steps {
                back: 0.0,
                forth: 0.0,
            };
        }
        let axis = bounds.axis.normalize();
        let [back, forth] = [-1.0, 1.0].map(|sign| {
            let speed = placed.approach_speed(axis, sign) + speed_error;
            step_length(gap, speed, acceleration)
        });
        Advance::Steps { back, forth }
    }
}

impl PlacedPair<'_> {
    /// Returns an upper bound of the relative speed of any points of both parts.
    #[inline(always)]
    fn speed_bound(&self) -> f64 {
        let ([a, b], [frame_a, frame_b]) = (self.parts, &self.frames);
        frame_a.speed_of_ball(a.center, a.ball_radius)
            + frame_b.speed_of_ball(b.center, b.ball_radius)
    }

    /// Bounds the distance of the corners of both parts.
    #[inline(always)]
    fn distance_bounds(
        &self,
        first_axis: DVec3,
        is_enough: impl Fn(&DistanceBounds) -> bool,
    ) -> DistanceBounds {
        let ([a, b], frames) = (self.parts, [self.frames[0].frame, self.frames[1].frame]);
        if let Some(plane) = &b.plane {
            return plane.distance_bounds(a, &frames[0]);
        }
        let first_axis = if first_axis == DVec3::ZERO {
            let centers = [
                frames[0].transform_point(a.center),
                frames[1].transform_point(b.center),
            ];
            initial_direction(b, centers)
        } else {
            first_axis
        };
        bound_distance(
            #[inline(always)]
            |direction: DVec3| minkowski_support_vertex([a, b], &frames, direction),
            first_axis,
            is_enough,
        )
    }

    /// Returns the fastest approach of two points of both parts along a unit vector from the first part to the second:
    /// forwards in time if `sign` is 1, backwards if it is -1.
    #[inline(always)]
    fn approach_speed(&self, axis: DVec3, sign: f64) -> f64 {
        let [a, b] = self.parts;
        let of_first = self.frames[0].largest_speed_along(
            sign * axis,
            #[inline(always)]
            |direction| a.extremal_corner(direction).1,
        );
        let of_second = self.frames[1].largest_speed_along(
            -sign * axis,
            #[inline(always)]
            |direction| b.extremal_corner(direction).1,
        );
        of_first + of_second
    }
}

/// Pushes what is left of an interval if a pair is free for some time before and after the point `at`.
fn push_rest(left: &mut Vec<[f64; 2]>, [from, at, to]: [f64; 3], [back, forth]: [f64; 2]) {
    let later = (at + forth).next_down();
    let earlier = (at - back).next_up();
    // Written so that NaN is searched again.
    if !(later >= to) {
        left.push([if later > from { later } else { from }, to]);
    }
    if !(earlier <= from) {
        left.push([from, if earlier < to { earlier } else { to }]);
    }
}

/// Returns a lower bound of the time for which a gap lasts: of the positive root of `speed s + acceleration s² / 2 = gap`.
#[inline(always)]
fn step_length(gap: f64, speed: f64, acceleration: f64) -> f64 {
    let root = (speed * speed + 2.0 * acceleration * gap).sqrt();
    let step = if speed > 0.0 {
        2.0 * gap / (speed + root)
    } else if acceleration > 0.0 {
        (root - speed) / acceleration
    } else if speed <= 0.0 && acceleration == 0.0 {
        f64::INFINITY
    } else {
        f64::NAN
    };
    step * ROUNDED_DOWN
}
