//! Computes the distance of two bodies over time, with a proven lower bound of this distance.

use ccd_core::order::{greater, lesser};
use ccd_core::{Body, InputError, Settings, Stretch};
use ccd_tables::batch::BodyPair;
use ccd_tables::movements::Movements;
use ccd_view::{GapCurve, GapSample};
use rigid_ccd::Solver;
use std::time::{Duration, Instant};

/// The maximum number of poses, besides the start, at which a query's bodies are also drawn as translucent ghosts.
const MAX_GHOSTS: f64 = 12.0;
/// The maximum number of times at which the distance is measured.
const MAX_MEASUREMENTS: usize = 96;
/// The maximum number of steps of conservative advancement.
const MAX_ADVANCEMENT_STEPS: usize = 48;
/// The time limit for all measurements of one query, checked after each measurement.
const TIME_LIMIT: Duration = Duration::from_secs(1);
/// The budget of one measurement of a distance, in the units of [`Settings::budget`].
const MEASUREMENT_BUDGET: u64 = 100_000;
/// The factor by which a bound on a speed or a deviation is enlarged to cover rounding.
const ROUNDING_FACTOR: f64 = 1.0 + 1e-9;

/// The distance of two bodies over time, and the steps of conservative advancement.
#[derive(Clone, Debug)]
pub struct GapOverTime {
    /// The measured distances, and the proven lower bound between them.
    pub gap: GapCurve,
    /// The times of the steps, starting with 0; from each step to the next the bodies are proven to stay apart.
    pub step_times: Vec<f64>,
}

impl GapOverTime {
    /// Returns the least value of the proven lower bound; `None` without a bound.
    pub(super) fn least_proven_gap(&self) -> Option<f64> {
        let gaps = self.gap.proven.iter().map(|[_, gap]| *gap);
        gaps.reduce(lesser)
    }

    /// Returns the times at which the bodies are also drawn as translucent ghosts: those steps that are more than a twelfth of
    /// `duration` apart.
    pub fn ghost_times(&self, duration: f64) -> Vec<f64> {
        let mut drawn: Vec<f64> = Vec::new();
        for &step in &self.step_times {
            if drawn
                .last()
                .is_none_or(|last| step - last > duration / MAX_GHOSTS)
            {
                drawn.push(step);
            }
        }
        drawn
    }

    /// Returns the time at which the measured distance is least.
    pub fn least_distance_time(&self) -> f64 {
        let points = self.gap.points.iter();
        let nearest = points.min_by(|one, other| one.upper.total_cmp(&other.upper));
        nearest.map_or(0.0, |point| point.time)
    }
}

/// Samples the distance of two bodies over time, most densely where its proven lower bound is loose. Between two
/// samples the lower bound follows from a bound on the bodies' closing speed. The lower bound is nowhere less than
/// `floor`, which the answer proves for all times.
///
/// # Errors
/// If the motions are out of range.
pub fn measure_gap_over_time(
    solver: &mut Solver,
    bodies: BodyPair<'_>,
    movements: &Movements,
    floor: f64,
) -> Result<GapOverTime, InputError> {
    solver.set_settings(Settings {
        budget: MEASUREMENT_BUDGET,
        ..Settings::DEFAULT
    });
    let mut sampler = GapSampler {
        solver,
        bodies,
        movements,
        distance_lower_bound: greater(floor, 0.0),
        deadline: Instant::now() + TIME_LIMIT,
    };
    let (mut points, steps) = sampler.advance()?;
    sampler.add_measurements(&mut points)?;
    Ok(GapOverTime {
        gap: GapCurve {
            proven: sampler.lower_bound_curve(&points)?,
            points,
            ..GapCurve::default()
        },
        step_times: steps,
    })
}

struct GapSampler<'a> {
    solver: &'a mut Solver,
    bodies: BodyPair<'a>,
    movements: &'a Movements,
    distance_lower_bound: f64,
    deadline: Instant,
}

/// Bounds that hold between two times: of the closing speed of two bodies, and of their deviation from their motions.
#[derive(Clone, Copy, Debug)]
struct ApproachBounds {
    /// The bound of the closing speed.
    speed: f64,
    /// The bound of the deviation, at the measured times and between them.
    deviation: f64,
}

impl GapSampler<'_> {
    /// Advances conservatively from the start until the bodies may touch, then measures at the end.
    fn advance(&mut self) -> Result<(Vec<GapSample>, Vec<f64>), InputError> {
        let end = self.movements.duration();
        let (mut time, mut points, mut steps) = (0.0, Vec::new(), Vec::new());
        while points.len() < MAX_ADVANCEMENT_STEPS && Instant::now() < self.deadline {
            let point = self.measure(time)?;
            points.push(point);
            steps.push(time);
            let ApproachBounds { speed, deviation } = self.closing_speed_bounds(time, end)?;
            let next = time + (point.lower - deviation) / speed;
            // At a contact the steps become shorter than rounding.
            if !(point.lower > deviation && next > time && next < end) {
                break;
            }
            time = next;
        }
        if points.last().is_none_or(|last| last.time < end) {
            points.push(self.measure(end)?);
        }
        Ok((points, steps))
    }

    /// Measures the distance at more times, each in the middle of the interval with the largest gain.
    fn add_measurements(&mut self, points: &mut Vec<GapSample>) -> Result<(), InputError> {
        let mut gains = Vec::new();
        for k in 1..points.len() {
            gains.push(self.gain_of_measurement_between(points[k - 1], points[k])?);
        }
        while points.len() < MAX_MEASUREMENTS && Instant::now() < self.deadline {
            let best = (0..gains.len()).max_by(|i, k| gains[*i].total_cmp(&gains[*k]));
            let Some(interval) = best.filter(|interval| gains[*interval] > 0.0) else {
                return Ok(());
            };
            let (before, after) = (points[interval], points[interval + 1]);
            let middle = self.measure(0.5 * before.time + 0.5 * after.time)?;
            gains[interval] = self.gain_of_measurement_between(before, middle)?;
            gains.insert(
                interval + 1,
                self.gain_of_measurement_between(middle, after)?,
            );
            points.insert(interval + 1, middle);
        }
        Ok(())
    }

    /// Returns the gain of one more measurement between two others: an upper bound of the area between the distance and
    /// its proven lower bound.
    fn gain_of_measurement_between(
        &self,
        before: GapSample,
        after: GapSample,
    ) -> Result<f64, InputError> {
        let time = after.time - before.time;
        if !(time > 1e-6 * self.movements.duration()) {
            return Ok(0.0);
        }
        let ApproachBounds { speed, deviation } =
            self.closing_speed_bounds(before.time, after.time)?;
        let lower = 0.5 * (before.lower + after.lower - speed * time) - deviation;
        let largest_distance = greater(before.upper, after.upper);
        Ok(time * (largest_distance - greater(lower, 0.0) + 1e-3 * largest_distance))
    }

    fn measure(&mut self, time: f64) -> Result<GapSample, InputError> {
        let [a, b] = self.movements.poses_at(time)?;
        let answer = (self.solver).distance((self.bodies.a, a), (self.bodies.b, b))?;
        let closest = &answer.outcome;
        let (lower, upper) = (greater(closest.lower(), 0.0), closest.upper());
        let upper = if upper.is_finite() { upper } else { lower };
        Ok(GapSample { time, lower, upper })
    }

    /// Bounds the closing speed of the bodies between two times, and how far their trajectories deviate from the motions that
    /// approximate them there.
    fn closing_speed_bounds(&self, from: f64, to: f64) -> Result<ApproachBounds, InputError> {
        let [a, b] = self.movements.trajectories();
        let (a, b) = (a.stretch_between(from, to)?, b.stretch_between(from, to)?);
        let [reach_a, reach_b] =
            [(&a, self.bodies.a), (&b, self.bodies.b)].map(max_distance_from_rotation_center);
        let relative_speed = (a.motion.velocity() - b.motion.velocity()).length();
        let rotation_speed = a.motion.angular_velocity().length() * reach_a
            + b.motion.angular_velocity().length() * reach_b;
        let speed_gain = (a.acceleration.length() + b.acceleration.length()) * (to - from);
        Ok(ApproachBounds {
            speed: (relative_speed + rotation_speed + speed_gain) * ROUNDING_FACTOR,
            deviation: 2.0
                * (a.deviation_bound.at_reach(reach_a) + b.deviation_bound.at_reach(reach_b))
                * ROUNDING_FACTOR,
        })
    }

    /// Returns the proven lower bound of the distance as a polyline over time. It falls on both sides of each
    /// measurement, but not below the bound that is proven for all times.
    fn lower_bound_curve(&self, points: &[GapSample]) -> Result<Vec<[f64; 2]>, InputError> {
        let floor = self.distance_lower_bound;
        let mut line = Vec::new();
        for pair in points.windows(2) {
            let [previous, next] = [pair[0], pair[1]];
            let ApproachBounds { speed, deviation } =
                self.closing_speed_bounds(previous.time, next.time)?;
            let bound_at = |point: GapSample| greater(point.lower - deviation, floor);
            let (left, right) = (bound_at(previous), bound_at(next));
            line.push([previous.time, left]);
            // Add the point where both lines meet, or the points where they meet the floor.
            let time = next.time - previous.time;
            let lowest = 0.5 * (left + right - speed * time);
            if speed > 0.0 && lowest > floor {
                let meeting_time = 0.5 * (time + (left - right) / speed);
                line.push([previous.time + meeting_time.clamp(0.0, time), lowest]);
            } else if speed > 0.0 {
                let ends = [(left - floor) / speed, time - (right - floor) / speed];
                line.extend(ends.map(|end| [previous.time + end.clamp(0.0, time), floor]));
            }
            line.push([next.time, right]);
        }
        if let ([], [only]) = (line.as_slice(), points) {
            line.push([only.time, only.lower]);
        }
        Ok(line)
    }
}

/// Bounds the distance of a body's points from the center of rotation of a stretch's motion.
fn max_distance_from_rotation_center((stretch, body): (&Stretch, &Body)) -> f64 {
    body.bounding_radius() + stretch.motion.center().length()
}
