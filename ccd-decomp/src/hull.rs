//! Convex hulls: of some points a library's, of few or many computed exactly; proven by exact predicates.
//!
//! ```text
//! points ─┬─ in one plane ───────────────────► flat.rs ───────────────────────┐
//!         ├─ some ─► library.rs ─► proof.rs ─┬─ proven ──────────────────────┼─► Hull
//!         │                                  └─ refuted ─► exact_hull.rs ─────┤
//!         └─ few or many ──────────────────► exact_hull.rs ─► proof.rs ───────┘
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
use ccd_core::tolerance::MAX_COORDINATE;
use span::Span;

/// The convex hull of points, by their indices.
///
/// # Guarantee
/// In exact arithmetic on the points as they are stored: every point is inside or on the hull; the
/// facets are whole, i.e. no two are in one plane (but for the two sides of a flat hull), and strictly
/// convex; every edge is an edge of two of them, once in either direction, so that they tile the hull's
/// boundary.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Hull {
    /// The hull's corners in ascending order; of several points at one place, the first.
    pub(crate) vertices: Vec<u32>,
    /// Convex polygons, counter-clockwise seen from outside.
    pub(crate) facets: Loops,
    /// How it was found.
    pub(crate) method: Method,
}

/// How a hull was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Method {
    /// By the library, and proven.
    Library,
    /// The library's hull is not the hull, or there was none: computed exactly instead.
    Rebuilt,
    /// The points are too few for the library to be worth it, or too many: computed exactly.
    Exact,
    /// All points are in one plane: a polygon, seen from either side.
    Flat,
}

/// Why points have no hull with facets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum HullError {
    /// There is none.
    #[error("a hull of no points")]
    Empty,
    /// All of them are at the place of the one named.
    #[error("all points are at the place of point {0}")]
    Single(u32),
    /// All of them are on the segment between the two named.
    #[error("all points are on a line, between points {0} and {1}")]
    Collinear(u32, u32),
    /// A coordinate is so near to 0 that predicates are not exact, not finite, or too large.
    #[error("point {0} has a coordinate that is out of range for exact predicates")]
    OutOfRange(u32),
    /// Not even the hull that was computed exactly could be proven.
    #[error("the hull of {0} points could not be proven")]
    Unproven(usize),
}

/// The convex hull of points, of which several may be at one place.
///
/// # Errors
/// See [`HullError`].
///
/// # Complexity
/// O(n log n), and as much memory as a few points each take.
pub(crate) fn hull(points: &[DVec3]) -> Result<Hull, HullError> {
    hull_by(points, solid)
}

/// The same by exact predicates alone, for those who prove it themselves.
///
/// # Errors
/// See [`HullError`].
///
/// # Complexity
/// As [`hull`].
pub(crate) fn unproven_hull(points: &[DVec3]) -> Result<Hull, HullError> {
    hull_by(points, |points| match ExactHull::facets_of(points) {
        Some(triangles) => Ok((loops(points, &triangles), Method::Exact)),
        None => Err(HullError::Unproven(points.len())),
    })
}

/// `solid` takes points at different places that span a volume.
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
    let cloud = DistinctPoints::of(points);
    let name = |k: usize| cloud.ids[k];
    let found = match Span::of(&cloud.points) {
        Span::Nothing => Err(HullError::Empty),
        Span::Point(a) => Err(HullError::Single(name(a))),
        Span::Line(a, b) => Err(HullError::Collinear(name(a), name(b))),
        Span::Plane(triangle) => Ok((flat::facets(&cloud.points, triangle), Method::Flat)),
        Span::Volume => solid(&cloud.points),
    };
    found.map(|(facets, method)| cloud.named(facets, method))
}

/// The triangles of what is likely the hull of points: of a number between few and many the library's, of
/// which nothing is proven, which makes it fast. None where that fails, or few or many points lie in one plane.
pub(crate) fn likely_triangles(points: &[DVec3]) -> Option<Vec<[u32; 3]>> {
    match (FEW_POINTS + 1..=LIKELY_POINTS).contains(&points.len()) {
        true => library::triangles(points),
        false => ExactHull::facets_of(points),
    }
}

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

/// The facets of the hull of points that span a volume, by exact predicates; none if they cannot be proven to
/// close a convex surface.
///
/// No point is in front of any: each was a corner, or was in front of none when the hull came to it, which
/// only grew from then on.
fn computed(points: &[DVec3]) -> Option<Loops> {
    let triangles = ExactHull::facets_of(points)?;
    proof::prove_convex(points, loops(points, &triangles)).ok()
}

/// Points at different places, and the number of the first given point at each.
struct DistinctPoints {
    points: Vec<DVec3>,
    ids: Vec<u32>,
}

impl DistinctPoints {
    fn of(points: &[DVec3]) -> Self {
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
