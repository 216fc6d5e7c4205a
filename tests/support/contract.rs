//! The laws of [`DistanceOracle`], to be run over any oracle.

use crate::referee::{point_segment, point_triangle};
use crate::tolerance::rounding;
use ccd_core::glam::{DMat3, DQuat, DVec3};
use ccd_core::order::{greater, lesser};
use ccd_core::{Claim, DistanceOracle, Frame, Piece, PiecePair};

/// A pair of pieces, owned.
#[derive(Clone, Debug)]
pub struct Pair {
    /// The points of A's piece.
    pub a: Vec<DVec3>,
    /// The points of B's piece, in B's frame.
    pub b: Vec<DVec3>,
    /// Maps B's coordinates to A's.
    pub b_to_a: Frame,
}

/// What a claim comes to when it is checked.
#[derive(Clone, Copy, Debug)]
pub struct Checked {
    /// The gap of the supports along the claimed axis: a lower bound of the distance.
    pub lower: f64,
    /// The distance of the claimed points: an upper bound.
    pub upper: f64,
}

impl Pair {
    /// From points and a placement of B's frame in A's.
    pub fn new(a: Vec<DVec3>, b: Vec<DVec3>, rotation: DQuat, translation: DVec3) -> Self {
        Pair {
            a,
            b,
            b_to_a: Frame {
                rotation: DMat3::from_quat(rotation),
                translation,
            },
        }
    }

    fn as_pieces(&self) -> PiecePair<'_> {
        PiecePair {
            a: Piece::from_points(&self.a),
            b: Piece::from_points(&self.b),
            b_to_a: self.b_to_a,
        }
    }

    fn b_in_a(&self) -> Vec<DVec3> {
        self.b.iter().map(|&p| self.b_to_a.point(p)).collect()
    }

    /// Bounds the rounding of a distance of this pair.
    pub fn rounding(&self) -> f64 {
        let largest = |points: &[DVec3]| points.iter().map(|p| p.length()).fold(0.0, greater);
        rounding(largest(&self.a) + largest(&self.b_in_a()) + largest(&self.b))
    }

    /// What a claim about this pair comes to; a claim that names no points is an error.
    ///
    /// # Errors
    /// What the claim lacks.
    pub fn check(&self, claim: &Claim) -> Result<Checked, String> {
        let b = self.b_in_a();
        let point_a = claim.a.of(&self.a).ok_or("names no point of A")?;
        let point_b = claim.b.of(&b).ok_or("names no point of B")?;
        let n = claim.axis.try_normalize();
        let lower = n.map_or(f64::NEG_INFINITY, |n| {
            let most = self
                .a
                .iter()
                .map(|p| p.dot(n))
                .fold(f64::NEG_INFINITY, greater);
            b.iter().map(|p| p.dot(n)).fold(f64::INFINITY, lesser) - most
        });
        Ok(Checked {
            lower,
            upper: point_a.distance(point_b),
        })
    }

    /// The distance of the two hulls by brute force: the nearest two of all their triangles.
    ///
    /// Exact up to rounding for hulls that are apart: then, and only then, the line between the two
    /// nearest points is an axis that separates the hulls. 0 for hulls that meet.
    pub fn distance(&self) -> f64 {
        let b = self.b_in_a();
        let (all_a, all_b) = (simplices(&self.a), simplices(&b));
        let mut best = DVec3::INFINITY;
        for s in &all_a {
            for t in &all_b {
                simplex_distance(s, t, &mut best);
            }
        }
        let most = self
            .a
            .iter()
            .map(|p| p.dot(best))
            .fold(f64::NEG_INFINITY, greater);
        let least = b.iter().map(|p| p.dot(best)).fold(f64::INFINITY, lesser);
        if least > most { best.length() } else { 0.0 }
    }
}

/// All triangles among some points that have the rest on one side (or what there is, for fewer than
/// three points): they cover the hull's surface.
fn simplices(points: &[DVec3]) -> Vec<Vec<DVec3>> {
    if points.len() <= 3 {
        return vec![points.to_vec()];
    }
    let size = points.iter().map(|p| p.length()).fold(0.0, greater);
    // More triangles than needed do no harm: they lie inside of the hull.
    let slack = rounding(size.powi(3));
    let mut out = Vec::new();
    for (i, &a) in points.iter().enumerate() {
        for (j, &b) in points.iter().enumerate().skip(i + 1) {
            for &c in &points[j + 1..] {
                let normal = (b - a).cross(c - a);
                let heights = points.iter().map(|p| (*p - a).dot(normal));
                let (least, most) = heights.fold((0.0, 0.0), |(lo, hi): (f64, f64), h| {
                    (lesser(lo, h), greater(hi, h))
                });
                if most <= slack || least >= -slack {
                    out.push(vec![a, b, c]);
                }
            }
        }
    }
    out
}

/// Keeps the shortest vector from `s` to `t` if it is shorter than the best so far.
fn simplex_distance(s: &[DVec3], t: &[DVec3], best: &mut DVec3) {
    let mut offer = |vector: DVec3| {
        if vector.length_squared() < best.length_squared() {
            *best = vector;
        }
    };
    s.iter().for_each(|&p| offer(nearest(p, t) - p));
    t.iter().for_each(|&p| offer(p - nearest(p, s)));
    for &(i, j) in edges(s) {
        for &(k, l) in edges(t) {
            crossing([s[i], s[j]], [t[k], t[l]])
                .into_iter()
                .for_each(&mut offer);
        }
    }
}

fn nearest(p: DVec3, simplex: &[DVec3]) -> DVec3 {
    match *simplex {
        [a] => a,
        [a, b] => point_segment(p, [a, b]),
        [a, b, c] => point_triangle(p, [a, b, c]),
        _ => p,
    }
}

fn edges(simplex: &[DVec3]) -> &'static [(usize, usize)] {
    match simplex.len() {
        2 => &[(0, 1)],
        3 => &[(0, 1), (1, 2), (2, 0)],
        _ => &[],
    }
}

/// The shortest vector between two lines, where its ends lie inside of the segments.
fn crossing(e: [DVec3; 2], f: [DVec3; 2]) -> Option<DVec3> {
    let (u, v, w) = (e[1] - e[0], f[1] - f[0], f[0] - e[0]);
    let n = u.cross(v);
    let inside = |x: f64| (0.0..=n.length_squared()).contains(&x);
    let (s, t) = (w.cross(v).dot(n), w.cross(u).dot(n));
    (n.length_squared() > 0.0 && inside(s) && inside(t))
        .then(|| n * (w.dot(n) / n.length_squared()))
}

/// The law of bounds: what is claimed, checked, encloses the true distance, and closely.
///
/// # Errors
/// What the oracle got wrong.
pub fn bounds_law<O: DistanceOracle>(
    oracle: &mut O,
    pair: &Pair,
    slack: f64,
) -> Result<(), String> {
    let claim = oracle
        .separation(&pair.as_pieces(), &mut O::Cache::default())
        .map_err(|give_up| format!("gave up: {give_up:?}"))?;
    let (checked, distance) = (pair.check(&claim)?, pair.distance());
    let rounding = pair.rounding();
    // The two enclosing inequalities hold for any claim; they check the brute force, too.
    if !(checked.lower <= distance + rounding && distance <= checked.upper + rounding) {
        return Err(format!("{checked:?} does not enclose {distance}"));
    }
    let (far, near) = (checked.upper - distance, distance - checked.lower);
    if distance > rounding && !(far <= slack + rounding && near <= slack + rounding) {
        return Err(format!("{checked:?} is loose about {distance}"));
    }
    Ok(())
}

/// The law of caches: one left by another pair, whatever its size, changes nothing beyond `slack`.
///
/// # Errors
/// What the stale cache changed.
pub fn cache_law<O: DistanceOracle>(
    oracle: &mut O,
    pairs: [&Pair; 2],
    slack: f64,
) -> Result<(), String> {
    let mut cache = O::Cache::default();
    // Whatever it says of the first pair, the second one is what counts.
    let _ = oracle.separation(&pairs[0].as_pieces(), &mut cache);
    let pair = pairs[1];
    let stale = oracle.separation(&pair.as_pieces(), &mut cache);
    let fresh = oracle.separation(&pair.as_pieces(), &mut O::Cache::default());
    let (stale, fresh) = match (stale, fresh) {
        (Ok(stale), Ok(fresh)) => (pair.check(&stale)?, pair.check(&fresh)?),
        (Err(_), Err(_)) => return Ok(()),
        (stale, fresh) => return Err(format!("stale {stale:?}, fresh {fresh:?}")),
    };
    let distance = pair.distance();
    let off = |checked: Checked| greater(checked.upper - distance, distance - checked.lower);
    let as_good = off(stale) <= off(fresh) + slack + pair.rounding();
    if distance > pair.rounding() && !as_good {
        return Err(format!(
            "stale {stale:?}, fresh {fresh:?}, distance {distance}"
        ));
    }
    Ok(())
}

/// The law of ends: an answer or a typed refusal, whatever the points.
pub fn ends_law<O: DistanceOracle>(oracle: &mut O, pair: &Pair) {
    let mut cache = O::Cache::default();
    for _ in 0..3 {
        let _ = oracle.separation(&pair.as_pieces(), &mut cache);
    }
}
