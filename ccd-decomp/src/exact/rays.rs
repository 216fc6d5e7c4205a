//! Rays through triangles, for winding numbers: exactly.

use super::predicates::side;
use ccd_core::glam::DVec3;
use std::cmp::Ordering;

/// Counts how a segment crosses a triangle: 1 where it leaves through it, −1 where it enters, 0 where it passes
/// by; none when it meets the triangle's edge, or ends on it.
pub(crate) fn crossing([from, to]: [DVec3; 2], triangle: [DVec3; 3]) -> Option<i32> {
    let [a, b, c] = triangle;
    let ends = [from, to].map(|p| side(triangle, p));
    if ends[0] == ends[1] && ends[0] != Ordering::Equal {
        return Some(0);
    }
    let turns = [(a, b), (b, c), (c, a)].map(|(v, w)| side([from, to, v], w));
    if turns.contains(&Ordering::Less) && turns.contains(&Ordering::Greater) {
        return Some(0);
    }
    match ends {
        _ if turns.contains(&Ordering::Equal) => None,
        [Ordering::Less, Ordering::Greater] => Some(1),
        [Ordering::Greater, Ordering::Less] => Some(-1),
        _ => None,
    }
}

/// The `k`-th segment that is tried from a point out of a mesh of some size.
///
/// It runs nearly along an axis, so that few boxes meet its box, and in no special relation to any.
pub(crate) fn probe(from: DVec3, size: f64, k: usize) -> [DVec3; 2] {
    let (along, tilt) = (DVec3::AXES[k % 3], 1e-3 * (1.0 + 0.618 * k as f64));
    let across = DVec3::new(0.7548, 0.5698, -0.3247) * tilt;
    [from, from + 3.0 * size * (along + across)]
}
