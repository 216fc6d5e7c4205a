//! A node of a hull tree during assembly.

use super::hull::FacetClass;
use super::loops::PolygonList;
use crate::body::polytope::{FacetOrigin, MeshFace};
use glam::DVec3;
use std::borrow::Cow;

/// A node of a hull tree under construction, whose hull has been checked against its children.
#[derive(Debug, Default)]
pub(super) struct Node<'a> {
    pub(super) points: Cow<'a, [DVec3]>,
    /// The mesh's vertex number of each point of the hull.
    pub(super) vertex_ids: Vec<u32>,
    pub(super) facets: Cow<'a, PolygonList>,
    /// The origin, class and mesh faces of each facet.
    pub(super) facet_data: Vec<FacetData>,
    /// The mesh's faces on a leaf's piece; `None` for an inner node, whose faces are listed by facet.
    pub(super) leaf_faces: Option<Vec<MeshFace>>,
    pub(super) rounding_radius: f64,
    pub(super) has_uniform_radius: bool,
    pub(super) half_diagonal: f64,
}

/// What one facet of a hull is made of: its origin in the mesh, its class and the mesh's triangles in it.
#[derive(Clone, Debug)]
pub(super) struct FacetData {
    pub(super) provenance: FacetOrigin,
    pub(super) class: FacetClass,
    /// The mesh's triangles in the facet; empty if the facet is itself a face of the mesh.
    pub(super) faces: Vec<MeshFace>,
}

impl Node<'_> {
    /// Returns the mesh's faces on the surface of the node's hull.
    pub(super) fn faces(&self) -> impl Iterator<Item = &MeshFace> {
        let of_skins = self.facet_data.iter().flat_map(|facet| &facet.faces);
        let (own, of_skins) = match &self.leaf_faces {
            Some(own) => (&own[..], None),
            None => (&[][..], Some(of_skins)),
        };
        own.iter().chain(of_skins.into_iter().flatten())
    }
}
