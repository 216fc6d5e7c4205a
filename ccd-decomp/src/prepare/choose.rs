//! Chooses the fewest exact pieces for `PieceChoice::Auto`.

use super::parts::PiecesOfOneKind;
use super::report::{EstimatedQueryTimes, PieceReason};
use crate::mesh::TriangleMesh;
use crate::pieces::convex::convex_polytope;
use crate::pieces::patches::{PatchOrder, patches_from_polygons};
use crate::solid::check_solid;
use crate::solid::error::DecomposeError;
use crate::solid::flats::{PlanarRegionSize, RegionMerger};
use crate::solid::manifold::Manifold;
use crate::solid::topology::TopologyDefects;
use crate::tolerance::{PATCH_QUERY_COST, QueryCost, RESTING_QUERY_FREQUENCY, TRIANGLE_QUERY_COST};
use crate::work::WorkBudget;

/// Chooses one hull if the solid is convex, else patches or triangles, whichever is estimated to be faster.
///
/// Intersection tests and decomposition are slow: they run only if the result would be used, within a budget.
pub(super) fn choose_pieces(
    mesh: &TriangleMesh,
    topology: &TopologyDefects,
    work: &WorkBudget,
) -> (PiecesOfOneKind, PieceReason) {
    let manifold = match Manifold::without_intersection_check(mesh, topology) {
        Ok(manifold) => manifold,
        Err(error) => return triangles_with_reason(error),
    };
    let convex = convex_polytope(&manifold);
    let mut merger = RegionMerger::merge_all_regions(&manifold);
    let estimate = merger.largest_planar_region_size().estimate_query_times();
    if convex.is_err() && !(estimate.patches < estimate.triangles) {
        return (
            PiecesOfOneKind::Triangles,
            PieceReason::TrianglesFaster(estimate),
        );
    }
    if let Err(error) = check_solid(&manifold, work) {
        return triangles_with_reason(error);
    }
    if let Ok(polytope) = convex {
        return (
            PiecesOfOneKind::Hull(Box::new(polytope)),
            PieceReason::Convex,
        );
    }
    let flats = merger.into_polygons();
    match patches_from_polygons(&manifold, &flats, PatchOrder::default(), work) {
        Ok(decomposition) => (
            PiecesOfOneKind::Patches(decomposition),
            PieceReason::PatchesFaster(estimate),
        ),
        Err(error) => triangles_with_reason(error),
    }
}

fn triangles_with_reason(error: DecomposeError) -> (PiecesOfOneKind, PieceReason) {
    let why = match error {
        DecomposeError::WorkBudgetExceeded => PieceReason::WorkBudgetExceeded,
        error => PieceReason::OnlyTrianglesExact(error),
    };
    (PiecesOfOneKind::Triangles, why)
}

impl PlanarRegionSize {
    /// Estimates the mean time of a query with triangles and with patches as pieces. In a fixed share of the queries
    /// this region is assumed to rest flat on another body.
    fn estimate_query_times(self) -> EstimatedQueryTimes {
        let cost = |of: QueryCost, count: usize| {
            of.median_query_time
                + RESTING_QUERY_FREQUENCY * of.time_per_resting_piece * count as f64
        };
        EstimatedQueryTimes {
            triangles: cost(TRIANGLE_QUERY_COST, self.triangle_count),
            patches: cost(PATCH_QUERY_COST, self.polygon_count),
        }
    }
}

#[cfg(test)]
mod tests;
