//! The referee computes distances of the bodies by brute force. It finds the first time with a distance below a
//! threshold, by conservative advancement over all pairs of triangles.
//!
//! Positions and their differences are computed in [`DoubleDouble`]. Distances are searched in f64 and
//! judged in [`DoubleDouble`]. A contact found is evidence; contacts may exist that are not found.

mod search;

use crate::case::Case;
use crate::double::DoubleDouble;
use crate::nearest::{Triangle, distance, penetration_depth};
use crate::raw_motion::{ExactMotion, Snapshot};
use crate::vector::{Number, Vector, larger, smaller};
use search::Search;

/// The largest error of the referee's distances, as a fraction of a scene's size.
const MAX_RELATIVE_DISTANCE_ERROR: f64 = 1e-25;
/// The distance, as a fraction of a scene's size, below which results of f64 are checked in [`DoubleDouble`].
const RELATIVE_RECHECK_DISTANCE: f64 = 1e-13;

/// A body's triangles and its motion.
pub struct MovingBody {
    pub track: ExactMotion,
    /// The triangles relative to the center of rotation, in the body's frame.
    pub triangles: Vec<Triangle<DoubleDouble>>,
    balls: Vec<Ball>,
    /// The bounding ball of all triangles.
    bounding_ball: Ball,
    /// The radius of the ball around the center of rotation that contains all triangles.
    reach: f64,
}

struct Ball {
    middle: Vector<DoubleDouble>,
    radius: f64,
    /// The largest distance of a point from the center of rotation; 0 for a body that does not rotate.
    arm: f64,
}

/// Two bodies and their motions.
pub struct Scene {
    pub sides: [MovingBody; 2],
    /// A bound on every length in the scene: distances of points, displacements and the margin.
    pub scale: f64,
}

/// A time at which the bodies are nearer than allowed, with their distance and penetration depth.
#[derive(Clone, Copy, Debug)]
pub struct MarginViolation {
    pub time: f64,
    pub distance: f64,
    pub depth: f64,
}

impl MovingBody {
    fn new(triangles: &[Triangle<f64>], track: ExactMotion) -> Self {
        let arm = |p: Vector<f64>| Vector::from_array(p.0) - track.center;
        let triangles: Vec<Triangle<DoubleDouble>> = triangles.iter().map(|t| t.map(arm)).collect();
        let balls: Vec<Ball> = triangles
            .iter()
            .map(|t| Ball::ball_around(t, &track))
            .collect();
        let corners: Vec<Vector<DoubleDouble>> = triangles.iter().flatten().copied().collect();
        let reaches = corners.iter().map(|p| p.length().to_f64());
        let reach = reaches.fold(0.0, larger);
        MovingBody {
            bounding_ball: Ball::ball_around(&corners, &track),
            reach,
            triangles,
            balls,
            track,
        }
    }

    fn triangle(
        &self,
        k: usize,
        snapshot: &Snapshot,
        origin: Vector<DoubleDouble>,
    ) -> Triangle<DoubleDouble> {
        let ([p, q, r], to) = (self.triangles[k], snapshot.center - origin);
        [
            snapshot.world_arm(p) + to,
            snapshot.world_arm(q) + to,
            snapshot.world_arm(r) + to,
        ]
    }
}

impl Ball {
    fn ball_around(points: &[Vector<DoubleDouble>], track: &ExactMotion) -> Self {
        let sum = points.iter().skip(1).fold(points[0], |sum, &p| sum + p);
        let middle = sum * DoubleDouble::new(1.0 / points.len() as f64);
        let far = |r, &p: &Vector<DoubleDouble>| larger(r, (p - middle).length().to_f64());
        let radius = points.iter().fold(0.0, far);
        let arms = points
            .iter()
            .fold(0.0, |r, p| larger(r, p.length().to_f64()));
        Ball {
            middle,
            radius: radius * (1.0 + 1e-9),
            arm: if track.rate.to_f64() > 0.0 { arms } else { 0.0 },
        }
    }
}

impl Scene {
    pub fn new(case: &Case) -> Self {
        let side = |k: usize| {
            MovingBody::new(
                &case.shapes[k].triangles(),
                case.motions[k].exact_motion(case.duration),
            )
        };
        let sides = [side(0), side(1)];
        let way = (sides[0].track.start - sides[1].track.start)
            .length()
            .to_f64();
        let travel = |s: &MovingBody| s.track.velocity.length().to_f64() * case.duration;
        let turn = |s: &MovingBody| 1.0 + s.track.rate.to_f64() * case.duration;
        let scale = way
            + travel(&sides[0])
            + travel(&sides[1])
            + sides.iter().map(|s| s.reach * turn(s)).sum::<f64>()
            + case.config.margin;
        Scene { sides, scale }
    }

    /// Returns a bound on the error of the referee's distances. Positions in the world have a relative error of
    /// 1e-31.
    pub fn distance_error_bound(&self) -> f64 {
        let far = self
            .sides
            .iter()
            .map(|s| s.track.start.max_absolute_component());
        MAX_RELATIVE_DISTANCE_ERROR * self.scale + 1e-29 * far.fold(0.0, larger)
    }

    pub fn snapshots(&self, t: f64) -> [Snapshot; 2] {
        [
            self.sides[0].track.snapshot_at(t),
            self.sides[1].track.snapshot_at(t),
        ]
    }

    /// Returns all triangles of a body at a time, relative to the center of body A.
    pub fn triangles_at(&self, side: usize, t: f64) -> Vec<Triangle<DoubleDouble>> {
        let snapshots = self.snapshots(t);
        let all = 0..self.sides[side].triangles.len();
        all.map(|k| self.sides[side].triangle(k, &snapshots[side], snapshots[0].center))
            .collect()
    }

    /// Returns the distance of the two surfaces at a time.
    pub fn distance(&self, t: f64) -> f64 {
        let [a, b] = [self.triangles_at(0, t), self.triangles_at(1, t)];
        let near = self.near_triangle_pairs(&a, &b);
        let best = near
            .iter()
            .fold(f64::INFINITY, |best, &(d, ..)| smaller(best, d));
        let noise = RELATIVE_RECHECK_DISTANCE * self.scale;
        let nearest = near.into_iter().filter(|&(d, ..)| d <= best + noise);
        let exact = nearest.map(|(_, i, j)| distance(&a[i], &b[j]).to_f64());
        exact.fold(f64::INFINITY, smaller)
    }

    /// Returns pairs of triangles with their distances in f64, including the nearest pair.
    fn near_triangle_pairs(
        &self,
        a: &[Triangle<DoubleDouble>],
        b: &[Triangle<DoubleDouble>],
    ) -> Vec<(f64, usize, usize)> {
        let rounded = |all: &[Triangle<DoubleDouble>]| -> Vec<(Triangle<f64>, Vector<f64>)> {
            let middle = |t: &Triangle<f64>| (t[0] + t[1] + t[2]) * (1.0 / 3.0);
            let rounded = all.iter().map(|t| t.map(Vector::to_f64));
            rounded.map(|t| (t, middle(&t))).collect()
        };
        let (a, b) = (rounded(a), rounded(b));
        let balls = self.sides.each_ref().map(|side| &side.balls);
        let (mut near, mut best) = (Vec::new(), f64::INFINITY);
        for (i, (s, m)) in a.iter().enumerate() {
            for (j, (t, n)) in b.iter().enumerate() {
                let (way, radii) = (*m - *n, balls[0][i].radius + balls[1][j].radius);
                let kept = (best + radii) * (1.0 + 1e-9) + RELATIVE_RECHECK_DISTANCE * self.scale;
                if way.dot(way) < kept * kept {
                    let d = distance(s, t);
                    best = smaller(best, d);
                    near.push((d, i, j));
                }
            }
        }
        near
    }

    /// Returns the distance of the two surfaces at a time, with every pair of triangles in [`DoubleDouble`]. It is computed
    /// before an answer is called wrong.
    pub fn all_pairs_distance(&self, t: f64) -> f64 {
        let [a, b] = [self.triangles_at(0, t), self.triangles_at(1, t)];
        let pairs = a
            .iter()
            .flat_map(|s| b.iter().map(move |t| distance(s, t).to_f64()));
        pairs.fold(f64::INFINITY, smaller)
    }

    /// Returns the greatest penetration depth of any two triangles at a time.
    pub fn penetration_depth(&self, t: f64) -> f64 {
        let [a, b] = [self.triangles_at(0, t), self.triangles_at(1, t)];
        let pairs = a.iter().flat_map(|s| {
            b.iter().map(move |t| {
                let flat = |t: &Triangle<DoubleDouble>| t.map(Vector::to_f64);
                if penetration_depth(&flat(s), &flat(t)) > 0.0 {
                    penetration_depth(s, t).to_f64()
                } else {
                    0.0
                }
            })
        });
        pairs.fold(0.0, larger)
    }

    /// Returns the earliest time found, up to `until`, at which the bodies are nearer than the limit allows. The flag
    /// is true if none was missed, except for f64's rounding.
    pub fn first_violation(
        &self,
        limit: ContactCriterion,
        until: f64,
    ) -> (Option<MarginViolation>, bool) {
        Search::new(self, limit, until).run()
    }
}

/// The conditions under which bodies count as nearer than allowed.
#[derive(Clone, Copy, Debug)]
pub struct ContactCriterion {
    /// The distance below which the bodies are nearer than allowed.
    pub distance_threshold: f64,
    /// The penetration depth of triangles above which the bodies are nearer than allowed.
    pub depth: f64,
}
