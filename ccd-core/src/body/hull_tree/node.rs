//! A node of a hull tree during assembly.

use super::hull::FacetClass;
use super::loops::Loops;
use crate::body::polytope::{Face, Origin};
use glam::DVec3;
use std::borrow::Cow;

/// A checked node.
#[derive(Debug, Default)]
pub(super) struct Node<'a> {
    pub(super) points: Cow<'a, [DVec3]>,
    /// The numbers of the node's points in the mesh.
    pub(super) vertex_ids: Vec<u32>,
    pub(super) loops: Cow<'a, Loops>,
    /// The data of the node's facets.
    pub(super) facet_data: Vec<FacetData>,
    /// The mesh's faces on a leaf; the faces of an inner node are those of its facets.
    pub(super) own_faces: Option<Vec<Face>>,
    pub(super) radius: f64,
    pub(super) evenly_rounded: bool,
    pub(super) size: f64,
}

/// The origin, class and mesh faces of one facet.
#[derive(Clone, Debug)]
pub(super) struct FacetData {
    pub(super) origin: Origin,
    pub(super) class: FacetClass,
    /// The mesh's triangles in the facet, unless it is one face by itself.
    pub(super) faces: Vec<Face>,
}

impl Node<'_> {
    /// Returns the mesh's faces on the node's surface.
    pub(super) fn faces(&self) -> impl Iterator<Item = &Face> {
        let of_skins = self.facet_data.iter().flat_map(|facet| &facet.faces);
        let (own, of_skins) = match &self.own_faces {
            Some(own) => (&own[..], None),
            None => (&[][..], Some(of_skins)),
        };
        own.iter().chain(of_skins.into_iter().flatten())
    }
}
