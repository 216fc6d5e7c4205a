//! Finished patches, whose hulls have facets with the numbers of the mesh's faces.

use super::growing_patch::GrowingPatch;
use crate::exact::predicates::{Projection, side_of_plane};
use crate::pieces::polytope::{FacetWithFaces, polytope};
use crate::solid::flats::{ConvexPolygon, ConvexPolygons};
use crate::solid::manifold::Manifold;
use ccd_core::glam::DVec3;
use ccd_core::{FacetOrigin, Polytope};
use std::cmp::Ordering;

/// A convex part of a mesh's surface, and its convex hull.
#[derive(Clone, Debug)]
pub struct Patch {
    /// The triangles of the patch, as indices into [`TriangleMesh::faces`](crate::TriangleMesh::faces), in ascending
    /// order.
    pub faces: Vec<u32>,
    /// The convex hull of the triangles. Its points are vertices of the mesh, with their numbers. Facets name their
    /// faces of the mesh; other facets are virtual.
    pub polytope: Polytope,
}

impl Patch {
    pub(super) fn new(
        manifold: &Manifold<'_>,
        flats: &ConvexPolygons,
        region: &GrowingPatch,
    ) -> Self {
        let members: Vec<&ConvexPolygon> = region.polygons.iter().map(|&f| flats.get(f)).collect();
        let mut faces: Vec<u32> = members.iter().flat_map(|f| &f.faces).copied().collect();
        faces.sort_unstable();
        let facets = region.facets(manifold.mesh().vertices());
        let facets = facets
            .iter()
            .map(|corners| facet_with_faces(manifold, &members, corners));
        let polytope = polytope(manifold, &facets.collect::<Vec<_>>());
        Patch { faces, polytope }
    }

    /// Returns the number of the hull's facets that are not entirely covered by faces of the mesh.
    pub fn virtual_facet_count(&self) -> usize {
        let facets = self.polytope.facets.iter();
        facets.filter(|f| f.origin == FacetOrigin::Virtual).count()
    }
}

/// Returns a facet of a patch's hull, with the numbers of the patch's mesh faces that lie in the facet.
fn facet_with_faces(
    manifold: &Manifold<'_>,
    members: &[&ConvexPolygon],
    facet: &[u32],
) -> FacetWithFaces {
    let at = |v: u32| manifold.point(v);
    let corners: Vec<DVec3> = facet.iter().map(|&v| at(v)).collect();
    let triangle = [corners[0], corners[1], corners[2]];
    let Some(plane) = Projection::new(triangle) else {
        return FacetWithFaces {
            corners: facet.to_vec(),
            mesh_faces: Vec::new(),
            is_facet_covered_by_mesh: false,
        };
    };
    // Coplanar with the facet, with the same normal.
    let within = |flat: &&&ConvexPolygon| {
        let own = manifold.triangle(flat.faces[0]);
        own.iter()
            .all(|&p| side_of_plane(triangle, p) == Ordering::Equal)
            && plane.turn(own[0], own[1], own[2]) == Ordering::Greater
    };
    let members: Vec<&ConvexPolygon> = members.iter().filter(within).copied().collect();
    // Faces cover the facet if they end only at its outline.
    let ours = |face: u32| members.iter().any(|f| f.faces.binary_search(&face).is_ok());
    let mut rims = members.iter().flat_map(|f| f.rim.iter().copied());
    let on_outline = |edge: u32| {
        let [a, b] = manifold.ends(edge).map(at);
        corners
            .iter()
            .all(|&p| plane.turn(a, b, p) != Ordering::Less)
    };
    FacetWithFaces {
        is_facet_covered_by_mesh: rims
            .all(|edge| ours(manifold.twin(edge) / 3) || on_outline(edge)),
        mesh_faces: members.iter().flat_map(|f| &f.faces).copied().collect(),
        corners: facet.to_vec(),
    }
}
