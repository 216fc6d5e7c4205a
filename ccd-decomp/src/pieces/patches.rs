//! Decomposes the surface of a closed mesh into convex patches, whose hulls lie inside the solid.

mod growing_patch;
mod obstacle;
mod order;
mod patch;

pub use order::PatchOrder;
pub use patch::Patch;

use crate::mesh::TriangleMesh;
use crate::pieces::convex::convex_polytope;
use crate::solid::error::DecomposeError;
use crate::solid::flats::ConvexPolygons;
use crate::solid::manifold::{Dihedral, Manifold};
use crate::solid::solid_surface;
use crate::tolerance::MAX_PATCH_POLYGONS;
use crate::work::WorkBudget;
use growing_patch::{GrowingPatch, JoinResult};
use order::seed_order;
use std::collections::VecDeque;

/// A decomposition of a solid's surface into convex patches.
#[derive(Clone, Debug)]
pub struct Decomposition {
    /// The patches, in the order in which they were made. Every triangle of the mesh is in exactly one.
    pub patches: Vec<Patch>,
}

/// Decomposes the surface of a solid into convex patches `[FAST06 §3.3]` `[SWIFT01]`.
///
/// A patch grows over edges that are not reflex. A polygon joins if all polygons stay on the boundary of the common
/// hull, and the hull stays within the solid. A convex solid becomes one patch; other patches grow to a size for which
/// oracles are fast.
///
/// # Guarantee
/// Exact, by adaptive predicates on the mesh's own coordinates: the hull of every patch lies inside the
/// solid or on its surface, and every triangle is part of exactly one patch and of the boundary of its
/// hull. The same mesh and order give the same patches. No tolerance, no change of the mesh.
///
/// # Errors
/// [`DecomposeError`] when the mesh does not bound a solid. It names the faulty elements.
///
/// # Complexity
/// O(n log n) in the number of triangles where few of them are near each other.
///
/// ```
/// use ccd_decomp::{decompose, Format, PatchOrder, TriangleMesh};
/// let file = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
/// let mesh = TriangleMesh::from_reader(Format::Obj, file.as_bytes()).unwrap();
/// let decomposition = decompose(&mesh, PatchOrder::Cresting).unwrap();
/// assert_eq!(decomposition.patches.len(), 1);
/// ```
pub fn decompose(mesh: &TriangleMesh, order: PatchOrder) -> Result<Decomposition, DecomposeError> {
    let manifold = solid_surface(mesh)?;
    patches_from_polygons(
        &manifold,
        &ConvexPolygons::new(&manifold),
        order,
        &WorkBudget::unbounded(),
    )
}

/// Decomposes the surface of a solid into convex patches, given its convex polygons.
///
/// # Errors
/// [`DecomposeError::WorkBudgetExceeded`] when the work does not suffice.
pub(crate) fn patches_from_polygons(
    manifold: &Manifold<'_>,
    flats: &ConvexPolygons,
    order: PatchOrder,
    work: &WorkBudget,
) -> Result<Decomposition, DecomposeError> {
    if let Ok(polytope) = convex_polytope(manifold) {
        let faces = (0..manifold.faces().len() as u32).collect();
        let patches = vec![Patch { faces, polytope }];
        return Ok(Decomposition { patches });
    }
    let mut grower = PatchGrower {
        manifold,
        polygons: flats,
        order,
        work_budget: work,
        is_polygon_in_patch: vec![false; flats.len()],
        tested_patch_by_polygon: vec![u32::MAX; flats.len()],
    };
    let mut patches = Vec::new();
    for seed in seed_order(manifold, flats, order) {
        if !grower.is_polygon_in_patch[seed as usize] {
            let region = grower.grow_patch(seed, patches.len() as u32);
            work.check()?;
            patches.push(Patch::new(manifold, flats, &region));
        }
    }
    Ok(Decomposition { patches })
}

struct PatchGrower<'a, 'm> {
    manifold: &'a Manifold<'m>,
    polygons: &'a ConvexPolygons,
    order: PatchOrder,
    work_budget: &'a WorkBudget,
    /// For each polygon, whether it belongs to a patch.
    is_polygon_in_patch: Vec<bool>,
    /// For each polygon, the number of the last patch that tried to add it. A refusal is final, because the hull only
    /// grows.
    tested_patch_by_polygon: Vec<u32>,
}

impl PatchGrower<'_, '_> {
    fn grow_patch(&mut self, seed: u32, patch: u32) -> GrowingPatch {
        let mut region = GrowingPatch::new(self.polygons, seed);
        self.is_polygon_in_patch[seed as usize] = true;
        let mut frontier = VecDeque::new();
        self.push_neighbours(&mut frontier, seed);
        // A flat patch takes no coplanar polygon, because the union need not be convex. These are tried again once the
        // patch has volume.
        let mut in_plane = Vec::new();
        // Polygons are pushed when another one joins, and each joins once.
        while let Some(next) = self.order.pop(&mut frontier) {
            let tried = &mut self.tested_patch_by_polygon[next as usize];
            if self.is_polygon_in_patch[next as usize]
                || *tried == patch
                || region.polygons.len() >= MAX_PATCH_POLYGONS
            {
                continue;
            }
            *tried = patch;
            self.work_budget.spend(region.hull.facets().len());
            match region.join(self.manifold, self.polygons, next, self.work_budget) {
                JoinResult::Refused => {}
                JoinResult::Coplanar => in_plane.push(next),
                JoinResult::Joined => {
                    self.is_polygon_in_patch[next as usize] = true;
                    self.push_neighbours(&mut frontier, next);
                    for waiting in in_plane.drain(..) {
                        self.tested_patch_by_polygon[waiting as usize] = u32::MAX;
                        frontier.push_back(waiting);
                    }
                }
            }
        }
        region
    }

    /// Adds the neighbours of a polygon to the frontier, except those across a reflex edge.
    fn push_neighbours(&self, frontier: &mut VecDeque<u32>, flat: u32) {
        for &edge in &self.polygons.get(flat).rim {
            if self.manifold.classify_dihedral(edge) != Dihedral::Reflex {
                frontier.push_back(self.polygons.polygon_of_face(self.manifold.twin(edge) / 3));
            }
        }
    }
}

#[cfg(test)]
mod tests;
