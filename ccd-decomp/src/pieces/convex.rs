//! Converts a convex solid to a single polytope.

use super::polytope::{FacetWithFaces, polytope};
use crate::hull::polygons::for_each_merged_polygon;
use crate::solid::error::DecomposeError;
use crate::solid::manifold::{Dihedral, Manifold};
use crate::solid::shells::shell_numbers;
use crate::solid::topology::Edge;
use ccd_core::Polytope;

/// Returns a convex solid as one polytope; an error if the solid is not convex.
///
/// Exact: a closed surface in one part that nowhere meets itself bounds a convex solid if and only if none of its
/// edges is reflex. About every vertex such a surface is a simple spherical polygon without a reflex angle, which
/// is convex, and a closed connected set that is locally convex is convex `[TIE28]`.
///
/// # Errors
/// [`DecomposeError::NotConvex`] with a reflex edge, [`DecomposeError::NotConnected`] with the number of parts.
pub(crate) fn convex_polytope(manifold: &Manifold<'_>) -> Result<Polytope, DecomposeError> {
    if let Some([v, w]) = first_non_convex_edge(manifold) {
        let edge = Edge(v.min(w), v.max(w));
        return Err(DecomposeError::NotConvex { edge });
    }
    let parts = shell_numbers(manifold)
        .into_iter()
        .max()
        .map_or(0, |last| last + 1);
    if parts > 1 {
        return Err(DecomposeError::NotConnected { parts });
    }
    let mut facets = Vec::new();
    for_each_merged_polygon(
        manifold.mesh().vertices(),
        manifold.faces(),
        |corners, faces| {
            facets.push(FacetWithFaces {
                corners: corners.to_vec(),
                mesh_faces: faces.to_vec(),
                is_facet_covered_by_mesh: true,
            });
        },
    );
    Ok(polytope(manifold, &facets))
}

/// Returns the end vertices of the first reflex or folded edge; `None` if no edge is reflex or folded.
fn first_non_convex_edge(manifold: &Manifold<'_>) -> Option<[u32; 2]> {
    let is_bad = |&h: &u32| {
        matches!(
            manifold.classify_dihedral(h),
            Dihedral::Reflex | Dihedral::Folded
        )
    };
    (0..3 * manifold.faces().len() as u32)
        .find(is_bad)
        .map(|h| manifold.ends(h))
}

#[cfg(test)]
mod tests;
