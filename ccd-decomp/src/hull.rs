//! Convex hulls of points, proven by exact predicates.
//!
//! ```text
//! points ─► span.rs ─┬─ in one plane ─► flat.rs ────────────────────────────┬─► Hull
//!                    └─ else ─► exact_hull.rs ─► polygons.rs ─► proof.rs ───┘
//! ```

pub(crate) mod exact_hull;
mod flat;
pub(crate) mod polygons;
mod proof;
mod span;

use crate::exact::predicates::{self, lexicographic};
use crate::hull::exact_hull::ExactHull;
use crate::hull::polygons::loops;
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
    hull_by(points, |points| proof::prove(points, facets(points)?).ok())
}

/// Computes the convex hull by exact predicates, without a proof, for callers that prove it themselves.
///
/// # Errors
/// [`HullError`] if there is no hull with facets.
///
/// # Complexity
/// O(n log n) time, and O(n) memory.
pub(crate) fn unproven_hull(points: &[DVec3]) -> Result<Hull, HullError> {
    hull_by(points, facets)
}

/// Computes a convex hull; `solid` computes the facets of distinct points that span a volume.
fn hull_by(
    points: &[DVec3],
    solid: impl FnOnce(&[DVec3]) -> Option<Loops>,
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
        Span::Plane(triangle) => Ok(flat::facets(&cloud.points, triangle)),
        Span::Volume => solid(&cloud.points).ok_or(HullError::Unproven(cloud.points.len())),
    };
    found.map(|facets| cloud.named(facets))
}

/// Computes the facets of the hull of points that span a volume, by exact predicates.
fn facets(points: &[DVec3]) -> Option<Loops> {
    ExactHull::facets_of(points).map(|triangles| loops(points, &triangles))
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
    fn named(&self, mut facets: Loops) -> Hull {
        for corner in facets.corners_mut() {
            *corner = self.ids[*corner as usize];
        }
        let mut vertices: Vec<u32> = facets.corners().to_vec();
        vertices.sort_unstable();
        vertices.dedup();
        Hull { vertices, facets }
    }
}

#[cfg(test)]
mod tests;
