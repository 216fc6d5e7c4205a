//! The hull by exact predicates alone.

use super::Loops;
use super::proof::{loops, prove};
use crate::exact_hull::ExactHull;
use ccd_core::glam::DVec3;

/// The facets of the hull of points that span a volume; none if that cannot be proven.
pub(super) fn facets(points: &[DVec3]) -> Option<Loops> {
    let hull = ExactHull::of(points)?;
    prove(points, loops(points, hull.facets())).ok()
}
