//! The hull by exact predicates alone.

use super::proof::prove_convex;
use crate::exact_hull::ExactHull;
use crate::polygons::loops;
use ccd_core::Loops;
use ccd_core::glam::DVec3;

/// The facets of the hull of points that span a volume; none if they cannot be proven to close
/// a convex surface.
///
/// No point is in front of any: each was a corner, or was in front of none when the hull came to it, which
/// only grew from then on.
pub(super) fn facets(points: &[DVec3]) -> Option<Loops> {
    let triangles = ExactHull::facets_of(points)?;
    prove_convex(points, loops(points, &triangles)).ok()
}
