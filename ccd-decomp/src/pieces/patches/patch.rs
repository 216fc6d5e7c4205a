//! Finished patches: polytopes with the faces of the mesh that they are made of.

use super::growing_patch::GrowingPatch;
use crate::exact::predicates::{Projection, side};
use crate::hull::polygons::polygons;
use crate::solid::flats::{Flat, Flats};
use crate::solid::manifold::Manifold;
use ccd_core::glam::DVec3;
use ccd_core::{Face, Facet, Origin, Polytope};
use std::cmp::Ordering;

/// A convex part of a mesh's surface, and its hull.
#[derive(Clone, Debug)]
pub struct Patch {
    /// The triangles, as indices into [`TriangleMesh::faces`](crate::TriangleMesh::faces), in ascending
    /// order.
    pub faces: Vec<u32>,
    /// The hull. Its points are vertices of the mesh, with their numbers. Its facets name the faces of the mesh
    /// that they consist of; the other facets are virtual.
    pub polytope: Polytope,
}

impl Patch {
    pub(super) fn new(manifold: &Manifold<'_>, flats: &Flats, region: &GrowingPatch) -> Self {
        let points = manifold.mesh().vertices();
        let members: Vec<&Flat> = region.flats().iter().map(|&f| flats.get(f)).collect();
        let mut faces: Vec<u32> = members
            .iter()
            .flat_map(|f| f.faces.iter().copied())
            .collect();
        faces.sort_unstable();
        let mut polytope = Polytope::default();
        let loops = polygons(points, region.hull().facets());
        let loops: Vec<Vec<u32>> = loops.into_iter().map(|polygon| polygon.corners).collect();
        let mut corners: Vec<u32> = loops.iter().flatten().copied().collect();
        corners.sort_unstable();
        corners.dedup();
        for corners_of_facet in loops {
            let cover = Cover::of(manifold, &members, &corners_of_facet);
            if cover.origin == Origin::Faces || cover.origin == Origin::Virtual {
                polytope.faces.extend(cover.faces.iter().map(|&face| Face {
                    id: manifold.mesh().face_ids()[face as usize],
                    vertices: manifold.faces()[face as usize],
                    corners: manifold.triangle(face),
                }));
            }
            let local = |v: &u32| corners.binary_search(v).map_or(0, |k| k as u32);
            polytope.facets.push(Facet {
                origin: cover.origin,
                corners: corners_of_facet.iter().map(local).collect(),
            });
        }
        polytope.points = corners.iter().map(|&v| points[v as usize]).collect();
        polytope.vertex_ids = corners;
        Patch { faces, polytope }
    }

    /// The number of facets that are not wholly part of the mesh.
    pub fn virtual_facets(&self) -> usize {
        let facets = self.polytope.facets.iter();
        facets.filter(|f| f.origin == Origin::Virtual).count()
    }
}

/// The faces of a patch that lie in a facet of its hull, and whether they cover it.
struct Cover {
    faces: Vec<u32>,
    origin: Origin,
}

impl Cover {
    fn of(manifold: &Manifold<'_>, members: &[&Flat], facet: &[u32]) -> Self {
        let at = |v: u32| manifold.point(v);
        let corners: Vec<DVec3> = facet.iter().map(|&v| at(v)).collect();
        let triangle = [corners[0], corners[1], corners[2]];
        let Some(plane) = Projection::of(triangle) else {
            return Cover::none();
        };
        // In the facet's plane, with the same normal.
        let within = |flat: &&&Flat| {
            let own = manifold.triangle(flat.faces[0]);
            own.iter().all(|&p| side(triangle, p) == Ordering::Equal)
                && plane.turn(own[0], own[1], own[2]) == Ordering::Greater
        };
        let members: Vec<&Flat> = members.iter().filter(within).copied().collect();
        let faces: Vec<u32> = members
            .iter()
            .flat_map(|f| f.faces.iter().copied())
            .collect();
        // Faces that cover the facet end at its outline only.
        let ours = |face: u32| members.iter().any(|f| f.faces.binary_search(&face).is_ok());
        let mut rims = members.iter().flat_map(|f| f.rim.iter().copied());
        let on_outline = |edge: u32| {
            let [a, b] = manifold.ends(edge).map(at);
            corners
                .iter()
                .all(|&p| plane.turn(a, b, p) != Ordering::Less)
        };
        let whole = rims.all(|edge| ours(manifold.twin(edge) / 3) || on_outline(edge));
        let origin = match (&faces[..], whole) {
            ([], _) | (_, false) => Origin::Virtual,
            (&[face], true) => Origin::Face(manifold.mesh().face_ids()[face as usize]),
            (_, true) => Origin::Faces,
        };
        Cover { faces, origin }
    }

    fn none() -> Self {
        Cover {
            faces: Vec::new(),
            origin: Origin::Virtual,
        }
    }
}
