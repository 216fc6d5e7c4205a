//! Convex solids, which are one polytope.

use crate::hull::polygons::polygons;
use crate::solid::error::DecomposeError;
use crate::solid::manifold::{Dihedral, Manifold};
use crate::solid::shells::shells;
use crate::solid::topology::Edge;
use ccd_core::{Face, Facet, Origin, Polytope};

/// Makes the polytope of a convex solid.
///
/// Exact: a closed surface in one part that nowhere meets itself bounds a convex solid if and only if none of its
/// edges is reflex. About every vertex such a surface is a simple spherical polygon without a reflex angle, which
/// is convex, and a closed connected set that is locally convex is convex `[TIE28]`.
///
/// # Errors
/// [`DecomposeError::NotConvex`] with a reflex edge, [`DecomposeError::NotInOnePart`] with the number of parts.
pub(crate) fn as_polytope(manifold: &Manifold<'_>) -> Result<Polytope, DecomposeError> {
    if let Some([v, w]) = bad_edge(manifold) {
        let edge = Edge(v.min(w), v.max(w));
        return Err(DecomposeError::NotConvex { edge });
    }
    let parts = shells(manifold)
        .into_iter()
        .max()
        .map_or(0, |last| last + 1);
    if parts > 1 {
        return Err(DecomposeError::NotInOnePart { parts });
    }
    let points = manifold.mesh().vertices();
    let polygons = polygons(points, manifold.faces());
    let mut corners: Vec<u32> = polygons
        .iter()
        .flat_map(|p| p.corners.iter().copied())
        .collect();
    corners.sort_unstable();
    corners.dedup();
    let mut polytope = Polytope::default();
    let id = |face: u32| manifold.mesh().face_ids()[face as usize];
    for polygon in &polygons {
        let origin = match polygon.triangles[..] {
            [face] => Origin::Face(id(face)),
            _ => {
                polytope
                    .faces
                    .extend(polygon.triangles.iter().map(|&face| Face {
                        id: id(face),
                        vertices: manifold.faces()[face as usize],
                        corners: manifold.triangle(face),
                    }));
                Origin::Faces
            }
        };
        let local = |v: &u32| corners.partition_point(|w| w < v) as u32;
        polytope.facets.push(Facet {
            origin,
            corners: polygon.corners.iter().map(local).collect(),
        });
    }
    polytope.points = corners.iter().map(|&v| points[v as usize]).collect();
    polytope.vertex_ids = corners;
    Ok(polytope)
}

/// Finds the first edge at which the solid has no convex or flat angle.
fn bad_edge(manifold: &Manifold<'_>) -> Option<[u32; 2]> {
    let is_bad = |&h: &u32| matches!(manifold.dihedral(h), Dihedral::Reflex | Dihedral::Folded);
    (0..3 * manifold.faces().len() as u32)
        .find(is_bad)
        .map(|h| manifold.ends(h))
}

#[cfg(test)]
mod tests;
