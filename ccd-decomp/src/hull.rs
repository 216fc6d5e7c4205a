//! Convex hulls of points, proven by exact predicates.
//!
//! ```text
//! points ─► span.rs ─┬─ in one plane ─► flat.rs ───────────────────────────────────────┐
//!                    ├─ some ─► library.rs ─► proof.rs ─┬─ proven ─────────────────────┼─► Hull
//!                    │                                  └─ refuted ─┐                  │
//!                    └─ few or many ────────────────────────────────┴─► exact_hull.rs ─┘
//! ```

pub(crate) mod exact_hull;
mod flat;
mod library;
pub(crate) mod polygons;
mod proof;
mod span;

use crate::exact::predicates::{self, lexicographic};
use crate::hull::exact_hull::ExactHull;
use crate::hull::polygons::loops;
use crate::tolerance::{FEW_POINTS, LIBRARY_POINTS, LIKELY_POINTS};
use ccd_core::Loops;
use ccd_core::glam::DVec3;
use ccd_core::limits::MAX_COORDINATE;
use span::Span;

/// A convex hull of points, by their indices.
///
/// # Guarantee
/// Exact for the stored points: every point is inside or on the hull. Facets are strictly convex and maximal: no two
/// are coplanar, except the two sides of a flat hull. Every edge is in two facets, once in each direction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Hull {
    /// The corners in ascending order; the first of several equal points represents them.
    pub(crate) vertices: Vec<u32>,
    /// Convex polygons, counter-clockwise seen from outside.
    pub(crate) facets: Loops,
    /// The method that found it.
    pub(crate) method: Method,
}

impl Hull {
    /// Returns the points of the corners, and the facets by corner indices.
    pub(crate) fn corners_and_facets(mut self, points: &[DVec3]) -> (Vec<DVec3>, Loops) {
        let mut number = vec![0; points.len()];
        for (k, &v) in (0..).zip(&self.vertices) {
            number[v as usize] = k;
        }
        for corner in self.facets.corners_mut() {
            *corner = number[*corner as usize];
        }
        let corners = self.vertices.iter().map(|&v| points[v as usize]);
        (corners.collect(), self.facets)
    }
}

/// The method that found a hull.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Method {
    /// Computed by the library, and proven.
    Library,
    /// Computed exactly, because the library failed or its hull was refuted.
    Rebuilt,
    /// Computed exactly, because the points are few or many.
    Exact,
    /// The points are coplanar: a polygon with two sides.
    Flat,
}

/// The reason why points have no hull with facets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum HullError {
    /// There are no points.
    #[error("a hull of no points")]
    Empty,
    /// All points equal this one.
    #[error("all points are at the place of point {0}")]
    Single(u32),
    /// All points are on the segment between these two.
    #[error("all points are on a line, between points {0} and {1}")]
    Collinear(u32, u32),
    /// A coordinate is too near to 0 for exact predicates, not finite, or too large.
    #[error("point {0} has a coordinate that is out of range for exact predicates")]
    OutOfRange(u32),
    /// The hull of this many points could not be proven, although it was computed exactly.
    #[error("the hull of {0} points could not be proven")]
    Unproven(usize),
}

/// Computes the convex hull of points, with a proof. Points may be equal.
///
/// # Errors
/// [`HullError`] if there is no hull with facets.
///
/// # Complexity
/// O(n log n) time, and O(n) memory.
pub(crate) fn hull(points: &[DVec3]) -> Result<Hull, HullError> {
    hull_by(points, solid)
}

/// Computes the convex hull by exact predicates, without a proof, for callers that prove it themselves.
///
/// # Errors
/// [`HullError`] if there is no hull with facets.
///
/// # Complexity
/// O(n log n) time, and O(n) memory.
pub(crate) fn unproven_hull(points: &[DVec3]) -> Result<Hull, HullError> {
    hull_by(points, |points| match ExactHull::facets_of(points) {
        Some(triangles) => Ok((loops(points, &triangles), Method::Exact)),
        None => Err(HullError::Unproven(points.len())),
    })
}

/// Computes a convex hull; `solid` computes it for distinct points that span a volume.
fn hull_by(
    points: &[DVec3],
    solid: impl FnOnce(&[DVec3]) -> Result<(Loops, Method), HullError>,
) -> Result<Hull, HullError> {
    // Written so that NaN fails.
    let good = |p: &DVec3| p.abs().max_element() <= MAX_COORDINATE && p.is_finite();
    let out_of_range = points.iter().position(|p| !good(p));
    if let Some(point) = out_of_range.or_else(|| predicates::too_fine(points)) {
        return Err(HullError::OutOfRange(point as u32));
    }
    let cloud = DistinctPoints::new(points);
    let name = |k: usize| cloud.ids[k];
    let found = match Span::new(&cloud.points) {
        Span::Nothing => Err(HullError::Empty),
        Span::Point(a) => Err(HullError::Single(name(a))),
        Span::Line(a, b) => Err(HullError::Collinear(name(a), name(b))),
        Span::Plane(triangle) => Ok((flat::facets(&cloud.points, triangle), Method::Flat)),
        Span::Volume => solid(&cloud.points),
    };
    found.map(|(facets, method)| cloud.named(facets, method))
}

/// Computes triangles that are likely the hull of points: the library's hull without a proof for medium numbers of
/// points. Returns `None` if the library fails, or the points are coplanar.
pub(crate) fn likely_triangles(points: &[DVec3]) -> Option<Vec<[u32; 3]>> {
    if (FEW_POINTS + 1..=LIKELY_POINTS).contains(&points.len()) {
        library::triangles(points)
    } else {
        ExactHull::facets_of(points)
    }
}

/// Computes the hull of distinct points that span a volume, with a proof.
fn solid(points: &[DVec3]) -> Result<(Loops, Method), HullError> {
    let some = FEW_POINTS < points.len() && points.len() <= LIBRARY_POINTS;
    if some
        && let Some(triangles) = library::triangles(points)
        && let Ok(facets) = proof::prove(points, loops(points, &triangles))
    {
        return Ok((facets, Method::Library));
    }
    let method = if some { Method::Rebuilt } else { Method::Exact };
    match computed(points) {
        Some(facets) => Ok((facets, method)),
        None => Err(HullError::Unproven(points.len())),
    }
}

/// Computes the facets of the hull of points that span a volume, by exact predicates; `None` if they cannot be proven.
///
/// No point is in front of a facet: each became a corner or was inside when it was inserted, and the hull only grows.
fn computed(points: &[DVec3]) -> Option<Loops> {
    let triangles = ExactHull::facets_of(points)?;
    proof::prove_convex(points, loops(points, &triangles)).ok()
}

/// The distinct points of a list, and the index of the first point at each.
struct DistinctPoints {
    points: Vec<DVec3>,
    ids: Vec<u32>,
}

impl DistinctPoints {
    fn new(points: &[DVec3]) -> Self {
        let at = |k: u32| points[k as usize];
        let mut ids: Vec<u32> = (0..points.len() as u32).collect();
        ids.sort_unstable_by(|&v, &w| lexicographic(at(v), at(w)).then(v.cmp(&w)));
        ids.dedup_by(|w, v| at(*v) == at(*w));
        ids.sort_unstable();
        DistinctPoints {
            points: ids.iter().map(|&v| at(v)).collect(),
            ids,
        }
    }

    /// Creates a hull of facets, by indices of the original points.
    fn named(&self, mut facets: Loops, method: Method) -> Hull {
        for corner in facets.corners_mut() {
            *corner = self.ids[*corner as usize];
        }
        let mut vertices: Vec<u32> = facets.corners().to_vec();
        vertices.sort_unstable();
        vertices.dedup();
        Hull {
            vertices,
            facets,
            method,
        }
    }
}

#[cfg(test)]
mod tests;
