//! Proves that two triangles share a point at an instant.

use super::enclosure::{IntervalMatrix, IntervalVector};
use super::interval::Interval;
use super::snapshot::IntervalMaps;
use super::surface::Triangle;
use super::track::EnclosedMotion;

/// The positions of both bodies at an instant, in B's frame.
pub(super) struct RelativePlacement {
    rotation: IntervalMatrix,
    offset: IntervalVector,
}

impl RelativePlacement {
    pub(super) fn new(a: &EnclosedMotion, b: &EnclosedMotion, time: f64) -> Self {
        let (rotation, offset) = IntervalMaps::new(a, b, time).placement;
        RelativePlacement { rotation, offset }
    }

    /// Returns true if an edge of one triangle certainly passes through the interior of the other.
    pub(super) fn certainly_meet(&self, a: &Triangle, b: &Triangle) -> bool {
        let a = a.map(|p| &self.rotation * &IntervalVector::from(p) + self.offset);
        let b = b.map(IntervalVector::from);
        (0..3).any(|i| {
            let next = (i + 1) % 3;
            pierces([&a[i], &a[next]], &b) || pierces([&b[i], &b[next]], &a)
        })
    }
}

/// Returns true if a segment certainly passes through a triangle. It checks five signs, each of which must be certain:
/// the ends lie on both sides of the triangle's plane, and the line passes all its edges on the same side.
fn pierces([from, to]: [&IntervalVector; 2], [a, b, c]: &[IntervalVector; 3]) -> bool {
    let normal = (*b - *a).cross(&(*c - *a));
    let before = sign(normal.dot(&(*from - *a)));
    if before == Sign::Unknown || sign(normal.dot(&(*to - *a))) != before.opposite() {
        return false;
    }
    let along = *to - *from;
    let passes = |p: &IntervalVector, q: &IntervalVector| {
        sign(along.dot(&(*p - *from).cross(&(*q - *from))))
    };
    let side = passes(a, b);
    side != Sign::Unknown && passes(b, c) == side && passes(c, a) == side
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sign {
    Negative,
    Positive,
    Unknown,
}

impl Sign {
    fn opposite(self) -> Self {
        match self {
            Sign::Negative => Sign::Positive,
            Sign::Positive => Sign::Negative,
            Sign::Unknown => Sign::Unknown,
        }
    }
}

fn sign(x: Interval) -> Sign {
    if x.inf() > 0.0 {
        Sign::Positive
    } else if x.sup() < 0.0 {
        Sign::Negative
    } else {
        Sign::Unknown
    }
}
