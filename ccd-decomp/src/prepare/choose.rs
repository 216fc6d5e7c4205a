//! Chooses the fewest exact pieces for `Detail::Auto`.

use super::parts::PiecesByKind;
use super::report::{PieceReason, QueryTimes};
use crate::mesh::TriangleMesh;
use crate::pieces::convex::convex_polytope;
use crate::pieces::patches::{PatchOrder, decompose_polygons};
use crate::solid::check_solid;
use crate::solid::error::DecomposeError;
use crate::solid::flats::{PlanarRegion, RegionMerger};
use crate::solid::manifold::Manifold;
use crate::solid::topology::Topology;
use crate::tolerance::{PATCH_COST, PieceCost, RESTING_QUERY_SHARE, TRIANGLE_COST};
use crate::work::Work;

/// Chooses one hull if the solid is convex, else patches or triangles, whichever is estimated to be faster.
///
/// Intersection tests and decomposition are slow: they run only if the result would be used, within a budget.
pub(super) fn choose(
    mesh: &TriangleMesh,
    topology: &Topology,
    work: &Work,
) -> (PiecesByKind, PieceReason) {
    let manifold = match Manifold::without_intersection_check(mesh, topology) {
        Ok(manifold) => manifold,
        Err(error) => return triangle_parts(error),
    };
    let convex = convex_polytope(&manifold);
    let mut merger = RegionMerger::merge_all_regions(&manifold);
    let estimate = merger.largest_planar_region().estimate_query_times();
    if convex.is_err() && !(estimate.patches < estimate.triangles) {
        return (
            PiecesByKind::Triangles,
            PieceReason::TrianglesFaster(estimate),
        );
    }
    if let Err(error) = check_solid(&manifold, work) {
        return triangle_parts(error);
    }
    if let Ok(polytope) = convex {
        return (PiecesByKind::Hull(Box::new(polytope)), PieceReason::Convex);
    }
    let flats = merger.into_polygons();
    match decompose_polygons(&manifold, &flats, PatchOrder::default(), work) {
        Ok(decomposition) => (
            PiecesByKind::Patches(decomposition),
            PieceReason::PatchesFaster(estimate),
        ),
        Err(error) => triangle_parts(error),
    }
}

fn triangle_parts(error: DecomposeError) -> (PiecesByKind, PieceReason) {
    let why = match error {
        DecomposeError::WorkBudgetExceeded => PieceReason::WorkBudgetExceeded,
        error => PieceReason::OnlyTrianglesExact(error),
    };
    (PiecesByKind::Triangles, why)
}

impl PlanarRegion {
    /// Estimates the mean time of a query with triangles and with patches as pieces. In a fixed share of the queries
    /// this region is assumed to rest flat on another body.
    fn estimate_query_times(self) -> QueryTimes {
        let cost = |of: PieceCost, count: usize| {
            of.typical_time + RESTING_QUERY_SHARE * of.resting_time * count as f64
        };
        QueryTimes {
            triangles: cost(TRIANGLE_COST, self.triangles),
            patches: cost(PATCH_COST, self.polygons),
        }
    }
}

#[cfg(test)]
mod tests;
