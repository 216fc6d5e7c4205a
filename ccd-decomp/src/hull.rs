//! Convex hulls of points in three dimensions, by exact predicates.
//!
//! ```text
//! points ─► exact_hull.rs ─┬─ a volume ─► polygons.rs ─┬─► Hull
//!                          └─ no volume ─► flat.rs ────┘
//! ```

pub(crate) mod exact_hull;
mod flat;
pub(crate) mod polygons;

use crate::exact::predicates::{
    compare_lexicographically, first_point_out_of_range, first_underflow_prone_point_index,
};
use crate::hull::exact_hull::ExactHull;
use crate::hull::polygons::merged_polygons;
use ccd_core::glam::DVec3;
use ccd_core::{Hull, PolygonList};

/// The error of a hull that cannot be computed: a coordinate of a point is too near to 0 for exact predicates, too
/// large, or not finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("point {point_index} has a coordinate that is out of range for exact predicates")]
pub struct HullError {
    /// The index of the first point that is out of range.
    pub point_index: u32,
}

/// Computes the convex hull of points. Several points may be equal.
///
/// # Guarantee
/// Exact for the stored points: every point is inside or on the hull. The corners are in the order of the points.
///
/// # Errors
/// [`HullError`].
///
/// # Complexity
/// O(n log n) time, and O(n) memory.
pub fn hull(points: &[DVec3]) -> Result<Hull, HullError> {
    if let Some(point) =
        first_point_out_of_range(points).or_else(|| first_underflow_prone_point_index(points))
    {
        let point = point as u32;
        return Err(HullError { point_index: point });
    }
    let points = distinct_points(points);
    Ok(match ExactHull::facets_of(&points) {
        Some(triangles) => hull_from_facets(&points, merged_polygons(&points, &triangles)),
        None => flat::hull(&points),
    })
}

/// Creates a hull from its facets, which keeps only the points that are corners of facets.
fn hull_from_facets(points: &[DVec3], mut facets: PolygonList) -> Hull {
    let mut corners: Vec<u32> = facets.corners().to_vec();
    corners.sort_unstable();
    corners.dedup();
    let mut number = vec![0; points.len()];
    for (k, &v) in (0..).zip(&corners) {
        number[v as usize] = k;
    }
    for corner in facets.corners_mut() {
        *corner = number[*corner as usize];
    }
    Hull {
        points: corners.iter().map(|&v| points[v as usize]).collect(),
        facets,
    }
}

/// Returns the points of a list without duplicates, in the order in which they first appear.
fn distinct_points(points: &[DVec3]) -> Vec<DVec3> {
    let at = |k: u32| points[k as usize];
    let mut first: Vec<u32> = (0..points.len() as u32).collect();
    first.sort_unstable_by(|&v, &w| compare_lexicographically(at(v), at(w)).then(v.cmp(&w)));
    first.dedup_by(|w, v| at(*v) == at(*w));
    first.sort_unstable();
    first.into_iter().map(at).collect()
}

#[cfg(test)]
mod tests;
