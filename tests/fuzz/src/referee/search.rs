//! Searches for the first contact by conservative advancement over all pairs of triangles, in f64, checked in
//! [`DoubleDouble`].

use super::{Ball, ContactCriterion, MarginViolation, RELATIVE_RECHECK_DISTANCE, Scene};
use crate::double::DoubleDouble;
use crate::nearest::{Triangle, distance, penetration_depth};
use crate::raw_motion::Snapshot;
use crate::vector::{Number, larger, smaller};

/// The maximum number of steps of one pair of triangles, before the rest of the time is sampled.
const MAX_PAIR_STEPS: usize = 300;
/// The maximum number of steps of all pairs of triangles together.
const MAX_TOTAL_STEPS: usize = 60_000;
const SAMPLE_COUNT: usize = 24;

/// The search for the first time at which two bodies are nearer than allowed.
pub(super) struct Search<'a> {
    scene: &'a Scene,
    limit: ContactCriterion,
    threshold: f64,
    search_end: f64,
    violation: Option<MarginViolation>,
    steps: usize,
    is_complete: bool,
}

/// A gap beyond the threshold, a bound on its closing rate, and a bound on the change of the rate per unit of time.
struct GapBounds {
    gap: f64,
    rate_bound: f64,
    rate_change_bound: f64,
}

/// Returns a time during which a gap certainly stays open: slightly less than the root τ of `gap = rate τ + bend τ²/2`,
/// by a formula without cancellation.
fn free_time(gap: f64, rate: f64, bend: f64) -> f64 {
    (1.0 - 1e-9) * 2.0 * gap / (rate + (rate * rate + 2.0 * bend * gap).sqrt())
}

impl<'a> Search<'a> {
    pub(super) fn new(scene: &'a Scene, limit: ContactCriterion, until: f64) -> Self {
        Search {
            scene,
            limit,
            threshold: limit.distance_threshold,
            search_end: until,
            violation: None,
            steps: 0,
            is_complete: true,
        }
    }

    pub(super) fn run(mut self) -> (Option<MarginViolation>, bool) {
        let [a, b] = &self.scene.sides;
        let begin = self.center_balls_apart_until(a.reach + b.reach);
        let begin = self.bodies_apart_until(begin);
        if !(begin < self.search_end) {
            return (None, true);
        }
        for (i, p) in a.balls.iter().enumerate() {
            let begin = self.balls_apart_until([p, &b.bounding_ball], begin);
            if !(begin < self.search_end) {
                continue;
            }
            for j in 0..b.balls.len() {
                self.search_pair(i, j, begin);
            }
        }
        (self.violation, self.is_complete)
    }

    /// Returns a time until which the balls around the bodies' centers of rotation are certainly apart.
    fn center_balls_apart_until(&self, reaches: f64) -> f64 {
        let [a, b] = &self.scene.sides;
        let way = (b.track.start - a.track.start).to_f64();
        let v = (b.track.velocity - a.track.velocity).to_f64();
        let kept = (reaches + self.threshold) * (1.0 + 1e-9)
            + RELATIVE_RECHECK_DISTANCE * self.scene.scale;
        let (square, along) = (v.dot(v), way.dot(v));
        let excess = way.dot(way) - kept * kept;
        let root = along * along - square * excess;
        if !(excess > 0.0) {
            0.0
        } else if along >= 0.0 || root < 0.0 {
            self.search_end
        } else {
            // The smaller root, in the form without cancellation.
            smaller(
                self.search_end,
                larger(0.0, 0.999_999 * excess / (-along + root.sqrt())),
            )
        }
    }

    fn search_pair(&mut self, i: usize, j: usize, begin: f64) {
        let mut t = begin;
        for _ in 0..MAX_PAIR_STEPS {
            self.steps += 1;
            if self.steps > MAX_TOTAL_STEPS {
                break;
            }
            let GapBounds {
                gap,
                rate_bound: rate,
                rate_change_bound: bend,
            } = self.triangle_gap_bounds(i, j, t);
            if !(gap > RELATIVE_RECHECK_DISTANCE * self.scene.scale) {
                if self.stop_if_below_threshold(i, j, t) {
                    return;
                }
                break;
            }
            t += free_time(gap, rate, bend);
            if !(t < self.search_end) {
                return;
            }
        }
        self.is_complete = false;
        let left = self.search_end - t;
        for k in 0..=SAMPLE_COUNT {
            let t = t + left * (k as f64 / SAMPLE_COUNT as f64);
            let gap = self.triangle_gap_bounds(i, j, t).gap;
            if !(gap > RELATIVE_RECHECK_DISTANCE * self.scene.scale)
                && self.stop_if_below_threshold(i, j, t)
            {
                return;
            }
        }
    }

    /// Returns a time after `begin` until which the bodies are certainly apart, by one bound on the closing rate of all
    /// pairs of triangles.
    fn bodies_apart_until(&self, begin: f64) -> f64 {
        let mut t = begin;
        for _ in 0..MAX_PAIR_STEPS {
            let [a, b] = [0, 1].map(|side| self.scene.triangles_at(side, t));
            let near = self.scene.near_triangle_pairs(&a, &b);
            let least = near
                .iter()
                .fold(f64::INFINITY, |least, &(d, ..)| smaller(least, d));
            let whole = self.scene.sides.each_ref().map(|side| &side.bounding_ball);
            let GapBounds {
                rate_bound: rate,
                rate_change_bound: bend,
                ..
            } = self.ball_gap_bounds(whole, &self.scene.snapshots(t));
            let tau = free_time(least - self.threshold, rate, bend);
            // A hundred more such steps would not reach the end, so it is faster pair by pair.
            if !(tau > 0.003 * (self.search_end - t)) {
                break;
            }
            t += tau;
            if !(t < self.search_end) {
                break;
            }
        }
        t
    }

    /// Returns a time after `begin` until which two balls are certainly farther apart than the threshold.
    fn balls_apart_until(&self, [p, q]: [&Ball; 2], begin: f64) -> f64 {
        let mut t = begin;
        for _ in 0..MAX_PAIR_STEPS {
            let GapBounds {
                gap,
                rate_bound: rate,
                rate_change_bound: bend,
            } = self.ball_gap_bounds([p, q], &self.scene.snapshots(t));
            if !(gap > 0.25 * smaller(p.radius, q.radius)
                && gap > RELATIVE_RECHECK_DISTANCE * self.scene.scale)
            {
                break;
            }
            t += free_time(gap, rate, bend);
            if !(t < self.search_end) {
                break;
            }
        }
        t
    }

    /// Returns the gap of two balls beyond the threshold, a bound on its closing rate, and a bound on the change of the
    /// rate.
    fn ball_gap_bounds(&self, [p, q]: [&Ball; 2], snapshots: &[Snapshot; 2]) -> GapBounds {
        let [a, b] = &self.scene.sides;
        let between = snapshots[1].center - snapshots[0].center;
        let middles = [
            snapshots[0].world_arm(p.middle),
            snapshots[1].world_arm(q.middle),
        ];
        let apart = (middles[1] + between - middles[0]).length().to_f64();
        let rates = [a.track.rate.to_f64(), b.track.rate.to_f64()];
        let velocity = a.track.point_velocity(middles[0].to_f64())
            - b.track.point_velocity(middles[1].to_f64());
        let rate = velocity.length() + rates[0] * p.radius + rates[1] * q.radius;
        let bend = rates[0] * rates[0] * p.arm + rates[1] * rates[1] * q.arm;
        GapBounds {
            gap: apart - p.radius - q.radius - self.threshold,
            rate_bound: rate,
            rate_change_bound: bend,
        }
    }

    fn triangle_gap_bounds(&self, i: usize, j: usize, t: f64) -> GapBounds {
        let (p, q) = (&self.scene.sides[0].balls[i], &self.scene.sides[1].balls[j]);
        let snapshots = self.scene.snapshots(t);
        let near = self.ball_gap_bounds([p, q], &snapshots);
        if near.gap > 0.5 * (p.radius + q.radius) {
            return near;
        }
        let [[a, b, c], [d, e, f]] = self.triangles(i, j, &snapshots);
        let s = [a.to_f64(), b.to_f64(), c.to_f64()];
        let t = [d.to_f64(), e.to_f64(), f.to_f64()];
        GapBounds {
            gap: distance(&s, &t) - self.threshold,
            ..near
        }
    }

    fn triangles(
        &self,
        i: usize,
        j: usize,
        snapshots: &[Snapshot; 2],
    ) -> [Triangle<DoubleDouble>; 2] {
        let [a, b] = &self.scene.sides;
        let origin = snapshots[0].center;
        [
            a.triangle(i, &snapshots[0], origin),
            b.triangle(j, &snapshots[1], origin),
        ]
    }

    /// Checks in [`DoubleDouble`] whether a pair of triangles is below the threshold at a time. If so, the search ends
    /// there.
    fn stop_if_below_threshold(&mut self, i: usize, j: usize, t: f64) -> bool {
        let [s, o] = self.triangles(i, j, &self.scene.snapshots(t));
        let (distance, error) = (distance(&s, &o).to_f64(), self.scene.distance_error_bound());
        let depth = if distance > error {
            0.0
        } else {
            penetration_depth(&s, &o).to_f64()
        };
        let below = distance < self.threshold - error || depth > larger(self.limit.depth, error);
        if below {
            self.search_end = t;
            self.violation = Some(MarginViolation {
                time: t,
                distance,
                depth,
            });
        }
        below
    }
}
