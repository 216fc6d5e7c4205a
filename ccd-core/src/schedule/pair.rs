//! One pair of pieces: ask the oracle, check its claim, advance the pair's own clock.

use crate::motion_bound::{Angle, AxisMotion, Gap, Track, first_crossing};
use crate::oracle::{DistanceOracle, PiecePair};
use crate::outcome::{Contact, Separation, Stats};
use crate::overlap;
use crate::pose::Frame;
use crate::problem::{Problem, Side, StartPolicy};
use crate::separation::{self, Checked};
use crate::tolerance::{AXIS_ROUNDS, RATE_F64, RESTING};
use glam::DVec3;

/// A pair of pieces that is being advanced.
#[derive(Clone, Debug)]
pub(crate) struct Pair<C> {
    pub(crate) a: u32,
    pub(crate) b: u32,
    goal: Goal,
    /// What the oracle left for its next call.
    cache: C,
}

/// What a pair's clock proves, and when the pair is in contact; distances beyond the margin.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Goal {
    /// In contact at the query's tolerance; half of it is proven kept.
    Apart,
    /// Began within the tolerance: in contact at half the gap it began with.
    LetGo { tolerance: f64 },
    /// Began in contact to within rounding: in contact once it cannot be proven above this.
    Resting { floor: f64 },
}

/// What became of a pair at its clock.
pub(crate) enum Step {
    /// Certified apart until this clock, which is past the present one; beyond 1 is forever.
    FreeUntil(f64),
    /// Within the tolerance.
    Contact(Contact),
    /// Intersecting; only at the start.
    Overlap(Contact),
    /// The next clock is not past the present one.
    Stalled,
    /// The oracle has no answer.
    GaveUp,
}

impl<C: Default + Clone> Pair<C> {
    pub(crate) fn new(a: u32, b: u32) -> Self {
        Pair {
            a,
            b,
            goal: Goal::Apart,
            cache: C::default(),
        }
    }

    /// Looks at the pair at clock `s`, until which it is certified apart, and certifies it further.
    pub(crate) fn advance<O: DistanceOracle<Cache = C>>(
        &mut self,
        problem: &Problem<'_>,
        oracle: &mut O,
        stats: &mut Stats,
        s: f64,
    ) -> Step {
        let frames = [problem.a.path.frame(s), problem.b.path.frame(s)];
        let pieces = self.placed(problem, &frames);
        let Some(checked) = ask(&pieces, &mut self.cache, problem, oracle, stats) else {
            return Step::GaveUp;
        };
        let ids = [self.a, self.b];
        let contact = || contact(problem, ids, &frames[0], &checked);
        let apart = problem.margin + problem.tolerance;
        if checked.upper <= apart {
            if s == 0.0 && overlap::intersects(&pieces, &checked, problem.rounding) {
                return Step::Overlap(contact());
            }
            if self.goal == Goal::Apart {
                match self.goal_of_start(problem, oracle, stats) {
                    Some(goal) => self.goal = goal,
                    None => return Step::Contact(contact()),
                }
            }
        } else if checked.lower > apart {
            self.goal = Goal::Apart;
        }
        let kept = match self.goal {
            Goal::Apart => problem.gap(),
            Goal::LetGo { tolerance } if checked.upper <= problem.margin + tolerance => {
                return Step::Contact(contact());
            }
            Goal::LetGo { tolerance } => problem.margin + 0.5 * tolerance,
            Goal::Resting { floor } => floor,
        };
        let free = self.free_time(problem, &pieces, &frames, &checked, kept, 1.0 - s);
        match free {
            None => Step::FreeUntil(f64::INFINITY),
            Some(tau) if (s + tau).next_down() > s => Step::FreeUntil((s + tau).next_down()),
            Some(_) if matches!(self.goal, Goal::Resting { .. }) => Step::Contact(contact()),
            Some(_) => Step::Stalled,
        }
    }

    /// What a pair that is within the tolerance has to keep from now on, or none when it is in
    /// contact.
    fn goal_of_start<O: DistanceOracle<Cache = C>>(
        &self,
        problem: &Problem<'_>,
        oracle: &mut O,
        stats: &mut Stats,
    ) -> Option<Goal> {
        if problem.start == StartPolicy::Report {
            return None;
        }
        let frames = [problem.a.path.frame(0.0), problem.b.path.frame(0.0)];
        let pieces = self.placed(problem, &frames);
        let start = ask(&pieces, &mut C::default(), problem, oracle, stats)?;
        if !(start.upper <= problem.margin + problem.tolerance) {
            return None;
        }
        let gap = start.lower - problem.margin;
        Some(if gap > 2.0 * RESTING * problem.rounding {
            Goal::LetGo {
                tolerance: 0.5 * gap,
            }
        } else {
            Goal::Resting {
                floor: start.lower - RESTING * problem.rounding,
            }
        })
    }

    /// Along the axis of the claim, or along the one on which the witnesses pass each other.
    fn free_time(
        &self,
        problem: &Problem<'_>,
        pieces: &PiecePair<'_>,
        frames: &[Frame; 2],
        checked: &Checked,
        kept: f64,
        horizon: f64,
    ) -> Option<f64> {
        let to_world = frames[0].rotation;
        let normal = to_world * checked.axis;
        let direct = free_time(
            problem,
            pieces,
            frames,
            normal,
            checked.lower - kept,
            horizon,
        )?;
        let ends = [checked.witness_a, checked.witness_b].map(|w| frames[0].point(w));
        let way = ends[1] - ends[0];
        let velocity = problem.a.path.velocity_at(ends[0], horizon_start(horizon))
            - problem.b.path.velocity_at(ends[1], horizon_start(horizon));
        let closest = (way.dot(velocity) / velocity.length_squared()).clamp(0.0, horizon);
        let passing = way - velocity * closest;
        let Some(passing) = passing.try_normalize() else {
            return Some(direct);
        };
        let local = frames[0].inverse_vector(passing);
        let gap = separation::support_gap(pieces, local, checked.witness_a)
            - pieces.a.radius
            - pieces.b.radius
            - problem.rounding;
        if !(gap > kept) {
            return Some(direct);
        }
        free_time(problem, pieces, frames, passing, gap - kept, horizon).map(|t| t.max(direct))
    }

    fn placed<'p>(&self, problem: &Problem<'p>, frames: &[Frame; 2]) -> PiecePair<'p> {
        PiecePair {
            a: problem.a.body.pieces().get(self.a as usize),
            b: problem.b.body.pieces().get(self.b as usize),
            b_to_a: frames[0].from_frame(&frames[1]),
        }
    }
}

fn horizon_start(h: f64) -> f64 {
    1.0 - h
}

/// Asks the oracle and checks what it says.
fn ask<O: DistanceOracle>(
    pieces: &PiecePair<'_>,
    cache: &mut O::Cache,
    problem: &Problem<'_>,
    oracle: &mut O,
    stats: &mut Stats,
) -> Option<Checked> {
    stats.oracle_calls += 1;
    match oracle.separation(pieces, cache) {
        Ok(claim) => Some(separation::check(pieces, &claim, problem.rounding)),
        Err(_) => {
            stats.give_ups += 1;
            None
        }
    }
}

/// A checked pair in the world's coordinates, with its features.
fn contact(problem: &Problem<'_>, ids: [u32; 2], a_to_world: &Frame, checked: &Checked) -> Contact {
    let world = |x: DVec3| problem.world(a_to_world.point(x));
    let feature = |side: &Side<'_>, piece: u32, support: &[u32]| {
        side.body.pieces().feature(piece as usize, support)
    };
    let [a, b] = ids;
    Contact {
        separation: Separation {
            lower: checked.lower,
            upper: checked.upper,
            normal: (a_to_world.rotation * checked.axis).normalize(),
            witness_a: world(checked.witness_a),
            witness_b: world(checked.witness_b),
        },
        feature_a: feature(&problem.a, a, checked.claim.a.support()),
        feature_b: feature(&problem.b, b, checked.claim.b.support()),
        piece_a: a,
        piece_b: b,
    }
}

/// A time for which a fixed axis certainly separates two pieces by what it must, or none when it
/// does so beyond `horizon`; `slack` is by how much it does now.
///
/// Every point's height along the axis is known exactly ([`Track`]); the least gap between any two
/// of them is followed by Newton's method with a bound on its curvature.
fn free_time(
    problem: &Problem<'_>,
    pieces: &PiecePair<'_>,
    frames: &[Frame; 2],
    normal: DVec3,
    slack: f64,
    horizon: f64,
) -> Option<f64> {
    let a = Heights::new(&problem.a, pieces.a.points, &frames[0], normal);
    let b = Heights::new(&problem.b, pieces.b.points, &frames[1], normal);
    // Heights are measured such that the nearest two points are `slack` apart.
    let (top, bottom) = (a.extreme(f64::max), b.extreme(f64::min));
    let rounding = RATE_F64 * (a.speed + b.speed);
    let rounds = if a.straight() && b.straight() {
        1
    } else {
        AXIS_ROUNDS
    };
    first_crossing(horizon, rounds, |tau| {
        let angles = [a.angle(tau), b.angle(tau)];
        let gap = |above: Point, below: Point| Gap {
            gap: slack + (above.height - bottom) - (below.height - top),
            rate: below.rate - above.rate + rounding,
            bend: (above.bend + below.bend) * (1.0 + RATE_F64),
        };
        if a.len() * b.len() <= PAIRWISE {
            let below = a.points(tau, angles[0]);
            below.fold(f64::INFINITY, |least, below| {
                b.points(tau, angles[1])
                    .map(|above| gap(above, below).free_time())
                    .fold(least, f64::min)
            })
        } else {
            let below = a.points(tau, angles[0]).reduce(Point::highest);
            let above = b.points(tau, angles[1]).reduce(Point::lowest);
            match (above, below) {
                (Some(above), Some(below)) => gap(above, below).free_time(),
                _ => 0.0,
            }
        }
    })
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

    fn len(&self) -> usize {
        self.points.len()
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

    fn tracks(&self) -> impl Iterator<Item = Track> + '_ {
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

    fn points(&self, tau: f64, angle: Angle) -> impl Iterator<Item = Point> + '_ {
        self.tracks().map(move |track| Point {
            height: track.height_at(tau, angle),
            rate: track.rate_at(angle),
            bend: track.bend(),
        })
    }
}
