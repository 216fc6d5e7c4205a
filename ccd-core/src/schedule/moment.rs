//! Two pieces at one moment, and for how long an axis keeps them apart from then on.

use crate::motion_bound::{Angle, AxisMotion, Gap, Track, first_crossing};
use crate::oracle::{DistanceOracle, PiecePair};
use crate::outcome::Stats;
use crate::pose::Frame;
use crate::problem::{Problem, Side};
use crate::separation::{self, Checked};
use crate::tolerance::{AXIS_ROUNDS, RATE_F64};
use glam::DVec3;

/// Two pieces where they are at a clock.
pub(crate) struct Moment<'p> {
    pub(crate) problem: &'p Problem<'p>,
    /// Of A and B, in the problem's coordinates.
    pub(crate) frames: [Frame; 2],
    pub(crate) pieces: PiecePair<'p>,
    clock: f64,
}

impl<'p> Moment<'p> {
    /// Piece `a` of A and piece `b` of B at a clock.
    pub(crate) fn new(problem: &'p Problem<'_>, a: u32, b: u32, clock: f64) -> Self {
        let frames = [problem.a.path.frame(clock), problem.b.path.frame(clock)];
        Moment {
            problem,
            frames,
            pieces: PiecePair {
                a: problem.a.body.pieces().get(a as usize),
                b: problem.b.body.pieces().get(b as usize),
                b_to_a: frames[0].from_frame(&frames[1]),
            },
            clock,
        }
    }

    /// Asks the oracle and checks what it says; none when it gave up.
    pub(crate) fn ask<O: DistanceOracle>(
        &self,
        oracle: &mut O,
        cache: &mut O::Cache,
        stats: &mut Stats,
    ) -> Option<Checked> {
        stats.oracle_calls += 1;
        match oracle.separation(&self.pieces, cache) {
            Ok(claim) => Some(separation::check(
                &self.pieces,
                &claim,
                self.problem.rounding,
            )),
            Err(_) => {
                stats.give_ups += 1;
                None
            }
        }
    }

    /// A time for which the pieces certainly stay farther apart than `kept`, or none when that is
    /// for good: along the axis of the claim, or along the one on which the witnesses pass each
    /// other.
    pub(crate) fn free_time(&self, checked: &Checked, kept: f64) -> Option<f64> {
        let normal = self.frames[0].rotation * checked.axis;
        let direct = self.free_along(normal, checked.lower - kept)?;
        let Some(passing) = self.passing(checked) else {
            return Some(direct);
        };
        let axis = self.frames[0].inverse_vector(passing);
        let radii = self.pieces.a.radius + self.pieces.b.radius;
        let gap = separation::support_gap(&self.pieces, axis, checked.witness_a) - radii;
        let slack = gap - self.problem.rounding - kept;
        if !(slack > 0.0) {
            return Some(direct);
        }
        self.free_along(passing, slack).map(|free| free.max(direct))
    }

    /// The direction between the witnesses when they are nearest, should they go on as they do.
    fn passing(&self, checked: &Checked) -> Option<DVec3> {
        let [a, b] = [checked.witness_a, checked.witness_b].map(|w| self.frames[0].point(w));
        let velocity = self.problem.a.path.velocity_at(a, self.clock)
            - self.problem.b.path.velocity_at(b, self.clock);
        let nearest = (b - a).dot(velocity) / velocity.length_squared();
        (b - a - velocity * nearest.clamp(0.0, self.horizon())).try_normalize()
    }

    fn horizon(&self) -> f64 {
        1.0 - self.clock
    }

    /// A time for which a fixed axis certainly separates the pieces by what it must, or none when it
    /// does so for good; `slack` is by how much more than that it separates them now.
    ///
    /// Every point's height along the axis is known exactly ([`Track`]); the least gap between any
    /// two of them is followed by Newton's method with a bound on its curvature.
    fn free_along(&self, normal: DVec3, slack: f64) -> Option<f64> {
        let (problem, [frame_a, frame_b]) = (self.problem, &self.frames);
        let a = Heights::new(&problem.a, self.pieces.a.points, frame_a, normal);
        let b = Heights::new(&problem.b, self.pieces.b.points, frame_b, normal);
        // Heights are measured such that the nearest two points are `slack` apart.
        let (top, bottom) = (a.extreme(f64::max), b.extreme(f64::min));
        let rounding = RATE_F64 * (a.speed + b.speed);
        let rounds = match a.straight() && b.straight() {
            true => 1,
            false => AXIS_ROUNDS,
        };
        first_crossing(self.horizon(), rounds, |tau| {
            let gap = |above: Point, below: Point| Gap {
                gap: slack + (above.height - bottom) - (below.height - top),
                rate: below.rate - above.rate + rounding,
                bend: (above.bend + below.bend) * (1.0 + RATE_F64),
            };
            least_free_time(&a, &b, tau, gap)
        })
    }
}

/// The least free time over all pairs of points, or that of the two envelopes where there are many.
fn least_free_time(
    a: &Heights<'_>,
    b: &Heights<'_>,
    tau: f64,
    gap: impl Fn(Point, Point) -> Gap,
) -> f64 {
    let (below, above) = (a.points(tau), b.points(tau));
    if a.points.len() * b.points.len() <= PAIRWISE {
        return below.fold(f64::INFINITY, |least, below| {
            let times = above.clone().map(|above| gap(above, below).free_time());
            times.fold(least, f64::min)
        });
    }
    match (above.reduce(Point::lowest), below.reduce(Point::highest)) {
        (Some(above), Some(below)) => gap(above, below).free_time(),
        _ => 0.0,
    }
}

/// Up to this many pairs of points are followed each on its own; above, the two envelopes are.
const PAIRWISE: usize = 64;

/// The points of a piece seen along an axis.
struct Heights<'a> {
    points: &'a [DVec3],
    frame: &'a Frame,
    /// Where the centre is in the body's frame.
    centre: DVec3,
    normal: DVec3,
    along: AxisMotion,
    omega: f64,
    /// The fastest that any point moves, in any direction.
    speed: f64,
}

/// One point's height, how fast it rises, and how much that may change.
#[derive(Clone, Copy)]
struct Point {
    height: f64,
    rate: f64,
    bend: f64,
}

impl Point {
    /// Bounds both from above.
    fn highest(self, other: Point) -> Point {
        Point {
            height: self.height.max(other.height),
            rate: self.rate.max(other.rate),
            bend: self.bend.max(other.bend),
        }
    }

    /// Bounds both from below.
    fn lowest(self, other: Point) -> Point {
        Point {
            height: self.height.min(other.height),
            rate: self.rate.min(other.rate),
            bend: self.bend.max(other.bend),
        }
    }
}

impl<'a> Heights<'a> {
    fn new(side: &Side<'_>, points: &'a [DVec3], frame: &'a Frame, normal: DVec3) -> Self {
        let path = &side.path;
        let unit = if path.turns() {
            path.spin / path.rate
        } else {
            DVec3::ZERO
        };
        let mut heights = Heights {
            points,
            frame,
            centre: path.centre,
            normal,
            along: AxisMotion::new(path.velocity, unit, path.rate, normal),
            omega: path.rate,
            speed: path.velocity.length(),
        };
        if path.turns() {
            let farthest = points.iter().map(|&x| (x - path.centre).length_squared());
            heights.speed += path.rate * farthest.fold(0.0, f64::max).sqrt();
        }
        heights
    }

    fn straight(&self) -> bool {
        !(self.omega > 0.0)
    }

    fn angle(&self, tau: f64) -> Angle {
        if tau > 0.0 && !self.straight() {
            Angle::new(self.omega * tau)
        } else {
            Angle::ZERO
        }
    }

    fn tracks(&self) -> impl Iterator<Item = Track> + Clone + '_ {
        self.points.iter().map(|&x| {
            let arm = self.frame.rotation * (x - self.centre);
            self.along.track(self.normal.dot(arm), arm)
        })
    }

    fn extreme(&self, pick: impl Fn(f64, f64) -> f64) -> f64 {
        self.tracks()
            .map(|track| track.height_at(0.0, Angle::ZERO))
            .reduce(pick)
            .unwrap_or(0.0)
    }

    fn points(&self, tau: f64) -> impl Iterator<Item = Point> + Clone + '_ {
        let angle = self.angle(tau);
        self.tracks().map(move |track| Point {
            height: track.height_at(tau, angle),
            rate: track.rate_at(angle),
            bend: track.bend(),
        })
    }
}
