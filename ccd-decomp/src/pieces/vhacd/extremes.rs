//! Reduces a set of points to candidates for the corners of its hull: extreme points, and all points outside their
//! hull.

use crate::bounds::Bounds;
use crate::exact::predicates::{side, too_fine};
use crate::hull::exact_hull::ExactHull;
use ccd_core::glam::DVec3;
use std::cmp::Ordering;
use std::f64::consts::PI;

/// Returns the extreme points in `directions` evenly spread directions, without duplicates, in the order of the list.
///
/// The directions are spread evenly over the box of the points, stretched to a cube.
pub(super) fn extreme_points(points: &[DVec3], directions: u32) -> Vec<DVec3> {
    let Bounds { lo, hi } = Bounds::enclosing(points.iter().copied());
    let stretch = |x: f64| if x > 0.0 { x.recip() } else { 0.0 };
    let scale = DVec3::from_array((hi - lo).to_array().map(stretch));
    let mut found: Vec<usize> = (0..directions)
        .filter_map(|k| {
            let direction_of = scale * direction(k, directions);
            let along = points.iter().map(|&p| direction_of.dot(p - lo)).enumerate();
            let best = along.reduce(|best, next| if next.1 > best.1 { next } else { best });
            best.map(|(place, _)| place)
        })
        .collect();
    found.sort_unstable();
    found.dedup();
    found.into_iter().map(|place| points[place]).collect()
}

/// Returns the `k`-th of `count` evenly spread directions (golden-angle spiral).
fn direction(k: u32, count: u32) -> DVec3 {
    let z = 1.0 - (2.0 * f64::from(k) + 1.0) / f64::from(count);
    let radius = (1.0 - z * z).sqrt();
    let angle = PI * (3.0 - 5.0_f64.sqrt()) * f64::from(k);
    DVec3::new(radius * angle.cos(), radius * angle.sin(), z)
}

/// The number of directions whose extreme points span the inner hull.
const DIRECTIONS: u32 = 32;

/// Removes points inside the hull of the extreme points, which does not change the hull of all.
///
/// # Guarantee
/// Exact: a removed point is in the hull of the others. No point is removed if a coordinate is too near to 0 for exact
/// predicates.
pub(super) fn remove_inner_points(points: Vec<DVec3>) -> Vec<DVec3> {
    if points.len() <= DIRECTIONS as usize || too_fine(&points).is_some() {
        return points;
    }
    let far = extreme_points(&points, DIRECTIONS);
    let Some(facets) = ExactHull::facets_of(&far) else {
        return points;
    };
    let is_outside = |p: &DVec3| {
        let mut facets = facets.iter().map(|facet| facet.map(|v| far[v as usize]));
        facets.any(|facet| side(facet, *p) == Ordering::Greater)
    };
    let outside = points.into_iter().filter(is_outside);
    far.iter().copied().chain(outside).collect()
}

#[cfg(test)]
mod tests;
