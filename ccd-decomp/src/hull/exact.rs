//! The hull by exact predicates alone.

use super::proof::{Refutation, loops, prove};
use crate::exact_hull::ExactHull;
use ccd_core::glam::DVec3;

/// The facets of the hull of points that span a volume; none if that cannot be proven.
///
/// Only some of the points are hulled: those that are likely to be corners, and those that then are
/// found outside, so that no point is outside of the second hull.
///
/// # Complexity
/// O(k f) exact predicates for k points that are hulled and f triangles; O(n f) rounded heights.
pub(super) fn facets(points: &[DVec3], mut likely: Vec<u32>) -> Option<Vec<Vec<u32>>> {
    likely.sort_unstable();
    likely.dedup();
    let first = prove(points, hulled(points, &likely)?);
    let Err(Refutation::Outside(outside)) = first else {
        return first.ok();
    };
    likely.extend(outside);
    prove(points, hulled(points, &likely)?).ok()
}

/// The facets of the hull of some of the points; none when they are in one plane.
fn hulled(points: &[DVec3], some: &[u32]) -> Option<Vec<Vec<u32>>> {
    let chosen: Vec<DVec3> = some.iter().map(|&v| points[v as usize]).collect();
    let hull = ExactHull::of(&chosen)?;
    let named = hull.facets().iter().map(|t| t.map(|k| some[k as usize]));
    Some(loops(points, &named.collect::<Vec<_>>()))
}
