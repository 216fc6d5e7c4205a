//! Exact crossings of segments with triangles, for winding numbers.

use super::predicates::side_of_plane;
use ccd_core::glam::DVec3;
use std::cmp::Ordering;

/// Returns the direction in which a segment crosses a triangle: 1 from back to front, −1 from front to back, 0 if the
/// segment misses the triangle. Returns `None` if it meets an edge or ends on the triangle.
pub(crate) fn segment_crossing_sign([from, to]: [DVec3; 2], triangle: [DVec3; 3]) -> Option<i32> {
    let [a, b, c] = triangle;
    let ends = [from, to].map(|p| side_of_plane(triangle, p));
    if ends[0] == ends[1] && ends[0] != Ordering::Equal {
        return Some(0);
    }
    let turns = [(a, b), (b, c), (c, a)].map(|(v, w)| side_of_plane([from, to, v], w));
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

/// Returns the `k`-th of a sequence of segments that lead from the point `from` to the outside of a mesh of length
/// `size`.
///
/// It is nearly parallel to an axis, so that few boxes meet its box, but slightly tilted to avoid degenerate cases.
pub(crate) fn probe_segment(from: DVec3, size: f64, k: usize) -> [DVec3; 2] {
    let (along, tilt) = (DVec3::AXES[k % 3], 1e-3 * (1.0 + 0.618 * k as f64));
    let across = DVec3::new(0.7548, 0.5698, -0.3247) * tilt;
    [from, from + 3.0 * size * (along + across)]
}
