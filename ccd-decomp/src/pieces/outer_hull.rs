//! Encloses a mesh by its convex hull, with a certified bound on how far the hull extends beyond the mesh.

mod enclosed_mesh;
mod facet_planes;
mod search;
mod shrink;
mod under;

use crate::hull::{HullError, hull};
use crate::mesh::TriangleMesh;
use crate::pieces::convex::convex_polytope;
use crate::solid::manifold::Manifold;
use crate::solid::star_shaped::star_center;
use crate::solid::topology::TopologyDefects;
use crate::tolerance::EXCESS_TOLERANCE_PER_HALF_DIAGONAL;
use ccd_core::glam::DVec3;
use ccd_core::order::lesser;
use ccd_core::{Facet, FacetOrigin, Hull, Polytope};
use enclosed_mesh::EnclosedMesh;

/// The convex hull of a mesh. None of its facets counts as part of the mesh.
///
/// # Guarantee
/// Let S be the solid (the points about which the mesh winds) with its surface, or the surface alone if the mesh is
/// open. The hull contains S exactly. No point of the hull is farther than `excess_bound` from S.
#[derive(Clone, Debug)]
pub(crate) struct OuterHull {
    pub(crate) polytope: Polytope,
    /// An upper bound on how far the hull extends beyond the solid or the open surface, in the mesh's unit of length; 0
    /// for a convex solid.
    pub(crate) excess_bound: f64,
}

/// Computes the convex hull of a mesh, and an upper bound on how far the hull extends beyond the mesh.
///
/// # Errors
/// [`HullError`] with the number of the mesh's vertex.
///
/// # Complexity
/// O(n log n) for the hull. The bound takes about [`EXCESS_WORK_BUDGET`](crate::tolerance::EXCESS_WORK_BUDGET) steps.
pub(crate) fn outer_hull(
    mesh: &TriangleMesh,
    topology: &TopologyDefects,
) -> Result<OuterHull, HullError> {
    let mut corners: Vec<u32> = mesh.faces().iter().flatten().copied().collect();
    corners.sort_unstable();
    corners.dedup();
    let at = |&v: &u32| mesh.vertices()[v as usize];
    let points: Vec<DVec3> = corners.iter().map(at).collect();
    let hull = hull(&points).map_err(|error| HullError {
        point_index: corners[error.point_index as usize],
    })?;
    Ok(OuterHull {
        excess_bound: excess_bound(mesh, topology, &hull),
        polytope: polytope(hull),
    })
}

fn polytope(hull: Hull) -> Polytope {
    let facet = |corners: &[u32]| Facet {
        origin: FacetOrigin::Virtual,
        corners: corners.to_vec(),
    };
    Polytope {
        points: hull.points,
        facets: hull.facets.iter().map(facet).collect(),
        ..Polytope::default()
    }
}

/// Returns an upper bound on how far the hull extends beyond the mesh; 0 for a convex solid.
fn excess_bound(mesh: &TriangleMesh, topology: &TopologyDefects, hull: &Hull) -> f64 {
    let target = EnclosedMesh::new(mesh, topology);
    let mut by_shrinking = f64::INFINITY;
    if let Ok(manifold) = Manifold::without_intersection_check(mesh, topology)
        && let Some(center) = star_center(&manifold)
    {
        if convex_polytope(&manifold).is_ok() {
            return 0.0;
        }
        by_shrinking = shrink::excess_bound(&target, hull, center).unwrap_or(f64::INFINITY);
    }
    if by_shrinking <= EXCESS_TOLERANCE_PER_HALF_DIAGONAL * target.half_diagonal {
        return by_shrinking;
    }
    lesser(by_shrinking, search::excess_bound(&target, hull))
}

#[cfg(test)]
mod tests;
