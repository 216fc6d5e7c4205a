//! Tests the clipping of an edge against exact fractions. A random search looks for the largest error.

use super::clip_to_half_space;
use crate::rational::{Exact3, exact_fraction};
use crate::tolerance::excess_rounding_bound;
use crate::worst::{RandomCase, WorstCaseSearch, error_fraction};
use ccd_core::glam::DVec3;
use ccd_core::order::greater;

/// Returns a random edge, which may be far from the origin.
fn edge(tape: &mut RandomCase) -> [DVec3; 2] {
    let scale = tape.size(-200..=39);
    let middle = DVec3::from(tape.vector(-8..=0));
    let small = tape.size(-50..=0);
    [(); 2].map(|()| (middle + DVec3::from(tape.vector(-8..=0)) * small) * scale)
}

/// Returns the distance from a point to the line through an edge. The square is an exact fraction; the root is
/// rounded once.
fn distance_from_line(point: DVec3, [p, q]: [DVec3; 2]) -> f64 {
    let [x, p, q] = [point, p, q].map(Exact3::from_coordinates);
    let along = q.minus(&p);
    let across = x.minus(&p).cross(&along);
    let square = across.dot(&across) / along.dot(&along);
    // Scaled, because squares of small lengths underflow.
    let scale = exact_fraction(2f64.powi(500));
    let root = (square * &scale).to_f64().value().sqrt();
    root * 2f64.powi(-250)
}

/// Clips an edge at a random coordinate plane between its ends, and keeps the part on one side.
fn clip_at_random_plane(tape: &mut RandomCase, polygon: &mut Vec<DVec3>) -> Option<()> {
    let (axis, keep) = (tape.index_below(3), tape.index_below(2) == 0);
    let (p, q) = (polygon[0][axis], polygon[1][axis]);
    let plane = p + (q - p) * tape.next_fraction();
    let mut part = Vec::new();
    clip_to_half_space(polygon, axis, |x| (x >= plane) == keep, plane, &mut part);
    part.dedup();
    part.truncate(2);
    let more = part.len() == 2 && part[0] != part[1];
    *polygon = part;
    more.then_some(())
}

fn largest_absolute_coordinate(of: [DVec3; 2]) -> f64 {
    greater(of[0].abs().max_element(), of[1].abs().max_element())
}

/// Tests that an edge clipped six times, once for each side of a box, stays on its line to within `excess_rounding`.
#[test]
fn worst_cuts() {
    let found = WorstCaseSearch::new("excess_rounding, 6 cuts", 20_000).search(|tape| {
        let edge = edge(tape);
        if edge[0] == edge[1] {
            return None;
        }
        let mut polygon = edge.to_vec();
        for _ in 0..6 {
            let before = polygon.clone();
            if clip_at_random_plane(tape, &mut polygon).is_none() {
                polygon = before;
            }
        }
        let off = polygon.iter().map(|&x| distance_from_line(x, edge));
        let bound = excess_rounding_bound(0.0, largest_absolute_coordinate(edge));
        Some(error_fraction(off.fold(0.0, greater), bound))
    });
    found.assert_tight_bound(4_000.0);
}
