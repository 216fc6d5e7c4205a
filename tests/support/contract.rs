//! The laws of [`DistanceOracle`], for any oracle.

use crate::referee::{point_segment, point_triangle};
use crate::tolerance::rounding;
use ccd_core::glam::{DMat3, DQuat, DVec3};
use ccd_core::order::{greater, lesser};
use ccd_core::{
    Claim, DistanceOracle, Facet, Frame, GiveUp, Origin, Piece, PiecePair, Pieces, Polytope,
};
use std::collections::BTreeSet;

/// A pair of pieces, owned.
#[derive(Clone, Debug)]
pub struct Pair {
    a: Hull,
    b: Hull,
    b_to_a: Frame,
}

/// The points of a piece, with the facets of their hull if those are known.
#[derive(Clone, Debug)]
pub struct Hull {
    points: Vec<DVec3>,
    /// The same points with facets.
    with_facets: Option<Pieces>,
}

/// The bounds that follow from a claim.
#[derive(Clone, Copy, Debug)]
pub struct Checked {
    /// The gap of the supports along the claimed axis: a lower bound of the distance.
    pub lower: f64,
    /// The distance of the claimed points: an upper bound.
    pub upper: f64,
}

impl Hull {
    /// Finds the facets of the points' hull, unless some points are coplanar.
    pub fn new(points: Vec<DVec3>) -> Self {
        let facets = facets(&points);
        Hull::with_facets(points, facets)
    }

    /// Combines points and the facets of their hull; without facets, the hull is known by its points only.
    pub fn with_facets(points: Vec<DVec3>, facets: Vec<Facet>) -> Self {
        let known = !facets.is_empty();
        let polytope = Polytope {
            points: points.clone(),
            facets,
            ..Polytope::default()
        };
        let with_facets = known.then(|| Pieces::polytopes(&[polytope]).expect("a polytope"));
        Hull {
            points,
            with_facets,
        }
    }

    /// Returns the mean of the points.
    pub fn middle(&self) -> DVec3 {
        self.points.iter().sum::<DVec3>() / self.points.len() as f64
    }

    fn piece(&self) -> Piece<'_> {
        match &self.with_facets {
            Some(pieces) => pieces.get(0),
            None => Piece::from_points(&self.points),
        }
    }

    /// Returns true if a backend that needs facets may refuse the hull.
    fn lacks_facets(&self) -> bool {
        self.points.len() > 3 && self.with_facets.is_none()
    }
}

impl Pair {
    /// Combines two hulls and a placement of B's frame in A's.
    pub fn new(a: Hull, b: Hull, rotation: DQuat, translation: DVec3) -> Self {
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
            a: self.a.piece(),
            b: self.b.piece(),
            b_to_a: self.b_to_a,
        }
    }

    fn b_in_a(&self) -> Vec<DVec3> {
        let points = self.b.points.iter();
        points.map(|&p| self.b_to_a.point(p)).collect()
    }

    /// Returns true if an oracle may give up for this reason, which is missing facets only.
    fn excuses(&self, why: GiveUp) -> bool {
        why == GiveUp::BadFacets && (self.a.lacks_facets() || self.b.lacks_facets())
    }

    /// Bounds the rounding of a distance of this pair.
    pub fn rounding(&self) -> f64 {
        let largest = |points: &[DVec3]| points.iter().map(|p| p.length()).fold(0.0, greater);
        rounding(largest(&self.a.points) + largest(&self.b_in_a()) + largest(&self.b.points))
    }

    /// Returns the bounds that follow from a claim about this pair; a claim without points is an error.
    ///
    /// # Errors
    /// The part that the claim lacks.
    pub fn check(&self, claim: &Claim) -> Result<Checked, String> {
        let b = self.b_in_a();
        let point_a = claim.a.of(&self.a.points).ok_or("names no point of A")?;
        let point_b = claim.b.of(&b).ok_or("names no point of B")?;
        let n = claim.axis.try_normalize();
        let lower = n.map_or(f64::NEG_INFINITY, |n| {
            let along = self.a.points.iter().map(|p| p.dot(n));
            let most = along.fold(f64::NEG_INFINITY, greater);
            b.iter().map(|p| p.dot(n)).fold(f64::INFINITY, lesser) - most
        });
        Ok(Checked {
            lower,
            upper: point_a.distance(point_b),
        })
    }

    /// Returns the distance of the two hulls by brute force: the least over all their triangles.
    ///
    /// The result is exact up to rounding for hulls that are apart: then, and only then, the line
    /// between the two nearest points is an axis that separates the hulls. It is 0 for hulls that meet.
    pub fn distance(&self) -> f64 {
        let b = self.b_in_a();
        let (all_a, all_b) = (simplices(&self.a.points), simplices(&b));
        let mut best = DVec3::INFINITY;
        for s in &all_a {
            for t in &all_b {
                simplex_distance(s, t, &mut best);
            }
        }
        let along = self.a.points.iter().map(|p| p.dot(best));
        let most = along.fold(f64::NEG_INFINITY, greater);
        let least = b.iter().map(|p| p.dot(best)).fold(f64::INFINITY, lesser);
        if least > most { best.length() } else { 0.0 }
    }
}

/// Returns the triangles of more than three points that have all others below them. Returns none
/// unless they close a surface, which they do if no four points are coplanar.
fn facets(points: &[DVec3]) -> Vec<Facet> {
    let size = points.iter().map(|p| p.length()).fold(0.0, greater);
    let slack = rounding(size.powi(3));
    let count = points.len() as u32;
    let at = |v: u32| points[v as usize];
    let mut out = Vec::new();
    for [i, j, k] in triples(count) {
        let normal = (at(j) - at(i)).cross(at(k) - at(i));
        let others = (0..count).filter(|v| ![i, j, k].contains(v));
        let (mut before, mut behind) = (false, false);
        for v in others {
            let height = (at(v) - at(i)).dot(normal);
            before |= height >= -slack;
            behind |= height <= slack;
        }
        match (before, behind) {
            (false, true) => out.push(vec![i, j, k]),
            (true, false) => out.push(vec![i, k, j]),
            _ => {}
        }
    }
    let sides = |corners: &Vec<u32>| [0, 1, 2].map(|n| (corners[n], corners[(n + 1) % 3]));
    let all: BTreeSet<(u32, u32)> = out.iter().flat_map(sides).collect();
    let closed = all.iter().all(|&(v, w)| all.contains(&(w, v)));
    let facet = |corners| Facet {
        origin: Origin::Virtual,
        corners,
    };
    if closed {
        out.into_iter().map(facet).collect()
    } else {
        Vec::new()
    }
}

/// Returns all ways to choose three of `count` indices, in order.
fn triples(count: u32) -> impl Iterator<Item = [u32; 3]> {
    let pairs = (0..count).flat_map(move |i| (i + 1..count).map(move |j| [i, j]));
    pairs.flat_map(move |[i, j]| (j + 1..count).map(move |k| [i, j, k]))
}

/// Returns all triangles among some points with the rest on one side, or all points if there are fewer than three. They
/// cover the hull's surface.
fn simplices(points: &[DVec3]) -> Vec<Vec<DVec3>> {
    if points.len() <= 3 {
        return vec![points.to_vec()];
    }
    let size = points.iter().map(|p| p.length()).fold(0.0, greater);
    // Additional triangles do no harm: they lie inside the hull.
    let slack = rounding(size.powi(3));
    let mut out = Vec::new();
    for triple in triples(points.len() as u32) {
        let [a, b, c] = triple.map(|v| points[v as usize]);
        let normal = (b - a).cross(c - a);
        let heights = points.iter().map(|p| (*p - a).dot(normal));
        let (least, most) = heights.fold((0.0, 0.0), |(lo, hi): (f64, f64), h| {
            (lesser(lo, h), greater(hi, h))
        });
        if most <= slack || least >= -slack {
            out.push(vec![a, b, c]);
        }
    }
    out
}

/// Replaces the best vector by the shortest vector from `s` to `t` if that is shorter.
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

/// Returns the shortest vector between two lines, if its ends lie inside the segments.
fn crossing(e: [DVec3; 2], f: [DVec3; 2]) -> Option<DVec3> {
    let (u, v, w) = (e[1] - e[0], f[1] - f[0], f[0] - e[0]);
    let n = u.cross(v);
    let inside = |x: f64| (0.0..=n.length_squared()).contains(&x);
    let (s, t) = (w.cross(v).dot(n), w.cross(u).dot(n));
    (n.length_squared() > 0.0 && inside(s) && inside(t))
        .then(|| n * (w.dot(n) / n.length_squared()))
}

/// The kind of a pair in the test of a law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Met {
    /// The pieces are apart.
    Apart,
    /// The pieces have a common point, or are apart by no more than rounding.
    Meeting,
    /// The oracle gave up for a documented reason.
    Refused,
}

/// Checks the law of bounds: the bounds of a claim enclose the true distance closely.
///
/// # Errors
/// The mistake of the oracle.
pub fn bounds_law<O: DistanceOracle>(
    oracle: &mut O,
    pair: &Pair,
    slack: f64,
) -> Result<Met, String> {
    let claim = match oracle.separation(&pair.as_pieces(), &mut O::Cache::default()) {
        Ok(claim) => claim,
        Err(why) if pair.excuses(why) => return Ok(Met::Refused),
        Err(why) => return Err(format!("gave up: {why:?}")),
    };
    let (checked, distance) = (pair.check(&claim)?, pair.distance());
    let rounding = pair.rounding();
    // The two enclosing inequalities hold for any claim; they check the brute force too.
    if !(checked.lower <= distance + rounding && distance <= checked.upper + rounding) {
        return Err(format!("{checked:?} does not enclose {distance}"));
    }
    let (far, near) = (checked.upper - distance, distance - checked.lower);
    if !(far <= slack + rounding) {
        return Err(format!(
            "the witnesses of {checked:?} are not {distance} apart"
        ));
    }
    if !(distance > rounding) {
        return Ok(Met::Meeting);
    }
    if !(near <= slack + rounding) {
        return Err(format!("{checked:?} is loose about {distance}"));
    }
    Ok(Met::Apart)
}

/// Checks the law of caches: a cache from another pair, of any size, changes the result by at most `slack`.
///
/// # Errors
/// The change by the stale cache.
pub fn cache_law<O: DistanceOracle>(
    oracle: &mut O,
    pairs: [&Pair; 2],
    slack: f64,
) -> Result<Met, String> {
    let mut cache = O::Cache::default();
    // The answer for the first pair is ignored; the second one counts.
    let _ = oracle.separation(&pairs[0].as_pieces(), &mut cache);
    let pair = pairs[1];
    let stale = oracle.separation(&pair.as_pieces(), &mut cache);
    let fresh = oracle.separation(&pair.as_pieces(), &mut O::Cache::default());
    let (stale, fresh) = match (stale, fresh) {
        (Ok(stale), Ok(fresh)) => (pair.check(&stale)?, pair.check(&fresh)?),
        (Err(stale), Err(fresh)) if stale == fresh && pair.excuses(fresh) => {
            return Ok(Met::Refused);
        }
        (stale, fresh) => return Err(format!("stale {stale:?}, fresh {fresh:?}")),
    };
    let distance = pair.distance();
    let off = |checked: Checked| greater(checked.upper - distance, distance - checked.lower);
    let as_good = off(stale) <= off(fresh) + slack + pair.rounding();
    if !(distance > pair.rounding()) {
        return Ok(Met::Meeting);
    }
    if !as_good {
        return Err(format!(
            "stale {stale:?}, fresh {fresh:?}, distance {distance}"
        ));
    }
    Ok(Met::Apart)
}

/// Checks the law of ends: for any points, the answer names points of the pieces, or is a typed refusal.
///
/// # Errors
/// The named point that a piece lacks.
pub fn ends_law<O: DistanceOracle>(oracle: &mut O, pair: &Pair) -> Result<(), String> {
    let mut cache = O::Cache::default();
    for _ in 0..3 {
        let Ok(claim) = oracle.separation(&pair.as_pieces(), &mut cache) else {
            continue;
        };
        for (named, of) in [(claim.a, &pair.a), (claim.b, &pair.b)] {
            if named
                .support()
                .iter()
                .any(|&k| k as usize >= of.points.len())
            {
                return Err(format!("{claim:?} names no point of {:?}", of.points));
            }
        }
    }
    Ok(())
}
