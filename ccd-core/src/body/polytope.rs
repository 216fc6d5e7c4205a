//! The input format of convex pieces.

use glam::DVec3;

/// A convex polytope, as input of [`Pieces::polytopes`](crate::Pieces::polytopes).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Polytope {
    /// The points whose hull is the polytope.
    pub points: Vec<DVec3>,
    /// The mesh's vertex number of each point. An empty list numbers them from 0.
    pub vertex_ids: Vec<u32>,
    /// The hull's facets, if known: they tile the boundary of the hull. A flat polygon has two.
    pub facets: Vec<Facet>,
    /// The mesh's faces that are on the hull's boundary and are not a facet by themselves.
    pub faces: Vec<Face>,
    /// The radius of the ball by which the hull is grown, ≥ 0.
    pub radius: f64,
}

/// One facet of a [`Polytope`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Facet {
    /// Which part of the mesh the facet came from.
    pub origin: FacetOrigin,
    /// The corners as indices into the polytope's points, counterclockwise seen from outside.
    pub corners: Vec<u32>,
}

/// Which part of the mesh a polytope's facet came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FacetOrigin {
    /// The facet is the mesh's face with this number.
    Face(u32),
    /// The facet consists of several coplanar faces, listed in [`Polytope::faces`].
    Faces,
    /// The facet closes the polytope, and is not part of the mesh, or only partly.
    Virtual,
}

/// A triangle of a mesh on the boundary of a [`Polytope`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Face {
    /// The number of the face in the mesh.
    pub id: u32,
    /// The mesh's numbers of the triangle's vertices.
    pub vertices: [u32; 3],
    /// The corners, counterclockwise seen from outside; not necessarily points of the polytope.
    pub corners: [DVec3; 3],
}
