//! Proves that two triangles share a point at an instant.

use super::enclosure::IntervalVector;
use super::interval::Interval;
use super::snapshot::IntervalMaps;
use super::surface::Triangle;
use std::cmp::Ordering;

impl IntervalMaps {
    /// Returns true if an edge of one triangle certainly passes through the interior of the other.
    pub(super) fn certainly_meet(&self, a: &Triangle, b: &Triangle) -> bool {
        let (rotation, offset) = &self.placement;
        let a = a.map(|p| rotation * &IntervalVector::from(p) + *offset);
        let b = b.map(IntervalVector::from);
        (0..3).any(|i| {
            let next = (i + 1) % 3;
            certainly_pierces([&a[i], &a[next]], &b) || certainly_pierces([&b[i], &b[next]], &a)
        })
    }
}

/// Returns true if a segment certainly passes through a triangle. It checks five signs, each of which must be certain:
/// the ends lie on both sides of the triangle's plane, and the line passes all its edges on the same side.
fn certainly_pierces([from, to]: [&IntervalVector; 2], [a, b, c]: &[IntervalVector; 3]) -> bool {
    let normal = (*b - *a).cross(&(*c - *a));
    let [before, after] = [from, to].map(|end| interval_sign(normal.dot(&(*end - *a))));
    if before.is_none() || after != before.map(Ordering::reverse) {
        return false;
    }
    let along = *to - *from;
    let passes = |p: &IntervalVector, q: &IntervalVector| {
        interval_sign(along.dot(&(*p - *from).cross(&(*q - *from))))
    };
    let side = passes(a, b);
    side.is_some() && passes(b, c) == side && passes(c, a) == side
}

/// Returns the sign of all numbers of an interval; `None` if it contains 0.
fn interval_sign(x: Interval) -> Option<Ordering> {
    if x.inf() > 0.0 {
        Some(Ordering::Greater)
    } else {
        (x.sup() < 0.0).then_some(Ordering::Less)
    }
}
