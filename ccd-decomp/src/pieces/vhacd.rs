//! Approximates a mesh by a few convex hulls, with certified bounds on what they miss and on what they exceed.
//!
//! ```text
//! mesh ─ voxels.rs ─ labels.rs (the library's V-HACD) ─ cover.rs ─ merge.rs ─► hulls ─ excess.rs ─► errors
//! ```
//!
//! The library only assigns voxels to parts `[MAM16]`. Its hulls are not used, because they need not contain the mesh.
//! Each hull is computed anew, around the part of the solid in its voxels.

mod cover;
mod excess;
mod labels;
mod merge;
mod target;
mod voxels;

use crate::hull::HullError;
use crate::mesh::TriangleMesh;
use crate::pieces::convex::convex_polytope;
use crate::solid::manifold::Manifold;
use crate::solid::star_shaped::is_star_shaped;
use crate::solid::topology::Topology;
use crate::tolerance;
use ccd_core::{Facet, FacetOrigin, Hull, Polytope};
use target::Target;
use voxels::VoxelGrid;

/// Hulls that together cover a solid, or a surface if the mesh is open.
///
/// # Guarantee
/// Let S be the solid (the points about which the mesh winds) with its surface, or the surface alone if the mesh
/// is open. Every point of S is within `uncovered` of the hull of a polytope's points, and therefore within that
/// polytope, whose radius this is. No point of a polytope is farther than `sticks_out` from S.
#[derive(Clone, Debug)]
pub(crate) struct Approximation {
    /// The hulls, at most the requested number. None of their facets is part of the mesh.
    pub(crate) polytopes: Vec<Polytope>,
    /// A bound on how far rounding may let S stick out of the hulls. It is the radius of every polytope, in the
    /// mesh's unit of length.
    pub(crate) uncovered_bound: f64,
    /// A bound on how far the polytopes extend beyond S, in the mesh's unit of length.
    pub(crate) excess_bound: f64,
}

/// The reason why a mesh cannot be approximated.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum VhacdError {
    /// The requested number of hulls is 0.
    #[error("a mesh cannot be approximated by no hulls")]
    NoHulls,
    /// A coordinate is too near to 0 for exact predicates.
    #[error("vertex {vertex} has a coordinate that is too near to 0 for exact predicates")]
    CoordinateTooSmall {
        /// The number of the vertex in the mesh.
        vertex: u32,
    },
    /// The library's V-HACD failed on the mesh's voxels.
    #[error("V-HACD failed on this mesh")]
    LibraryFailed,
    /// The hull of a part could not be computed.
    #[error("the hull of a part failed: {0}")]
    Hull(HullError),
    /// The certified bound on the excess of the hulls is too large to be useful.
    #[error(
        "the hulls may stick out by {excess_bound:.3e}, more than {limit:.3e}, a quarter of the \
         diagonal; mend the mesh, or use triangles"
    )]
    TooCoarse {
        /// The certified bound, in the mesh's unit of length.
        excess_bound: f64,
        /// The largest accepted bound, in the mesh's unit of length.
        limit: f64,
    },
}

/// Approximates a mesh by at most `hulls` convex hulls. A convex solid gets one hull, and so does a mesh without a
/// suitable voxel grid.
///
/// # Errors
/// [`VhacdError`] if `hulls` is 0, or none can be certified.
///
/// # Complexity
/// The library takes O(r³) in the resolution r. The bound on the errors takes a branch and bound of about
/// [`tolerance::EXCESS_WORK`] steps.
pub(crate) fn approximate(
    mesh: &TriangleMesh,
    topology: &Topology,
    hulls: u32,
) -> Result<Approximation, VhacdError> {
    if hulls == 0 {
        return Err(VhacdError::NoHulls);
    }
    if let Some(vertex) = crate::exact::predicates::too_fine(mesh.vertices()) {
        return Err(VhacdError::CoordinateTooSmall {
            vertex: vertex as u32,
        });
    }
    let target = Target::new(mesh, topology);
    let is_convex = is_convex(mesh, topology);
    let voxels = VoxelGrid::new(&target, hulls).filter(|_| hulls > 1 && !is_convex);
    let parts = match voxels {
        Some(voxels) => {
            let labels = labels::label_voxels(&target, &voxels, hulls);
            cover::points_by_part(&target, &voxels, &labels.ok_or(VhacdError::LibraryFailed)?)
        }
        None => vec![target.triangles().flatten().collect()],
    };
    let parts = parts.into_iter().filter(|points| !points.is_empty());
    let parts = merge::merge_to_count(&parts.collect::<Vec<_>>(), hulls as usize);
    let parts = parts.map_err(VhacdError::Hull)?;
    let uncovered = tolerance::clip_rounding(target.farthest_coordinate());
    let excess = if is_convex {
        0.0
    } else {
        excess::excess_bound(&target, &parts)
    };
    let sticks_out = (excess + uncovered).next_up();
    let limit = tolerance::MAX_RELATIVE_EXCESS * target.half_diagonal() + 2.0 * uncovered;
    // Written so that NaN fails.
    if !(sticks_out <= limit) {
        return Err(VhacdError::TooCoarse {
            excess_bound: sticks_out,
            limit,
        });
    }
    Ok(Approximation {
        polytopes: parts.into_iter().map(|p| polytope(p, uncovered)).collect(),
        uncovered_bound: uncovered,
        excess_bound: sticks_out,
    })
}

fn polytope(hull: Hull, radius: f64) -> Polytope {
    let facet = |corners: &[u32]| Facet {
        origin: FacetOrigin::Virtual,
        corners: corners.to_vec(),
    };
    Polytope {
        points: hull.points,
        facets: hull.facets.iter().map(facet).collect(),
        radius,
        ..Polytope::default()
    }
}

/// Returns whether the mesh is known to be a convex solid, whose hull has no error.
fn is_convex(mesh: &TriangleMesh, topology: &Topology) -> bool {
    let manifold = Manifold::without_intersection_check(mesh, topology);
    manifold.is_ok_and(|manifold| is_star_shaped(&manifold) && convex_polytope(&manifold).is_ok())
}

#[cfg(test)]
mod tests;
