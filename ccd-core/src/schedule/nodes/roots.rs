//! The boxes of two whole bodies: one fixed plane may tell them apart for good.

use super::approach::Approach;
use super::placed::Placed;
use crate::math::vector::unit;
use crate::problem::{Problem, Side};
use crate::tolerance::PROJECTIONS;
use glam::DVec3;

/// Returns whether a fixed plane between the boxes of both bodies keeps them farther apart than a
/// contact is, all the time. It is across the way between the boxes' nearest points.
///
/// # Guarantee
/// Only bodies that are never in contact, up to the tolerance, nor inside each other, are told apart.
pub(crate) fn keep_apart(problem: &Problem<'_>) -> bool {
    let whole = |side: &Side<'_>| side.body.tree().piece(0).is_some();
    // Two single pieces are told apart as fast by themselves.
    if whole(&problem.a) && whole(&problem.b) {
        return false;
    }
    let [a, b] = [&problem.a, &problem.b].map(|side| Placed::whole(side, 0.0));
    // Projected from one box to the other and back, a point goes to the nearest ones.
    let (mut on_a, mut on_b) = (a.centre, b.centre);
    for _ in 0..PROJECTIONS {
        on_a = a.project(on_b);
        on_b = b.project(on_a);
    }
    let Some(n) = unit(on_b - on_a) else {
        return false;
    };
    if keeps_apart(problem, [&a, &b], n) {
        return true;
    }
    // Between faces that are next to each other the way is hardly known, but it is across them.
    [&a, &b].into_iter().any(|whole| {
        let along = whole.axis_along(n);
        along != n && keeps_apart(problem, [&a, &b], along)
    })
}

/// Returns whether a plane across a unit vector keeps the boxes apart.
fn keeps_apart(problem: &Problem<'_>, [a, b]: [&Placed; 2], n: DVec3) -> bool {
    let gap = n.dot(b.centre - a.centre) - a.reach(n) - b.reach(-n);
    let excess = gap - problem.contact_distance() - 2.0 * problem.rounding;
    // Written so that NaN tells nothing.
    excess > 0.0 && Approach::along(problem, [a, b], n, 0.0).free_time(excess) >= 1.0
}
