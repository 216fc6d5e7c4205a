//! The library's hull: a fast candidate in floating point.

use crate::exact::predicates::lexicographic;
use ccd_core::glam::DVec3;
use parry3d_f64::math::Vector;
use parry3d_f64::transformation::try_convex_hull;
use std::panic::catch_unwind;

/// Computes the hull triangles of a few distinct points; `None` if the library gives up.
///
/// The library's time and memory grow with the square of the number of points, and it recurses once per removed
/// triangle.
pub(super) fn triangles(points: &[DVec3]) -> Option<Vec<[u32; 3]>> {
    let cloud: Vec<Vector> = points.iter().map(|p| p.to_array().into()).collect();
    // The library asserts conditions that rounding can violate.
    let (corners, triangles) = catch_unwind(|| try_convex_hull(&cloud)).ok()?.ok()?;
    let corners = corners.iter().map(|p| DVec3::from_array(p.to_array()));
    let ids = identify(points, corners)?;
    let named = |&[a, b, c]: &[u32; 3]| {
        let id = |k: u32| ids.get(k as usize).copied();
        Some([id(a)?, id(b)?, id(c)?])
    };
    triangles.iter().map(named).collect()
}

/// Finds the indices of the corners, which the library does not return.
fn identify(points: &[DVec3], corners: impl Iterator<Item = DVec3>) -> Option<Vec<u32>> {
    let at = |k: u32| points[k as usize];
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    order.sort_unstable_by(|&v, &w| lexicographic(at(v), at(w)));
    let find = |corner| {
        let found = order.binary_search_by(|&v| lexicographic(at(v), corner));
        found.ok().map(|k| order[k])
    };
    corners.map(find).collect()
}
