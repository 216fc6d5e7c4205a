//! The input format of convex pieces.

use glam::DVec3;

/// A convex polytope, as input of [`Pieces::from_polytopes`](crate::Pieces::from_polytopes).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Polytope {
    /// The points whose hull is the polytope.
    pub points: Vec<DVec3>,
    /// The mesh's vertex number of each point. An empty list numbers them from 0.
    pub vertex_ids: Vec<u32>,
    /// The facets of the hull, if known; together they cover its boundary. A flat polygon has two facets.
    pub facets: Vec<Facet>,
    /// The mesh's triangles on the hull's boundary that are only a part of a facet.
    pub faces: Vec<MeshFace>,
    /// The radius of the ball by which the hull is grown, ≥ 0.
    pub radius: f64,
}

/// A planar face of the hull of a [`Polytope`]: its corners, and the faces of the mesh that it consists of.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Facet {
    /// The face or faces of the mesh that the facet consists of, if any.
    pub origin: FacetOrigin,
    /// The corners as indices into the polytope's points, counterclockwise seen from outside.
    pub corners: Vec<u32>,
}

/// The relation of a polytope's facet to the mesh: one face, several faces, or no face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FacetOrigin {
    /// The facet is the mesh's face with this number.
    Face(u32),
    /// The facet consists of several coplanar faces, listed in [`Polytope::faces`].
    Faces,
    /// The facet closes the polytope; none of it, or only a part of it, is on the mesh.
    Virtual,
}

/// A triangle of a mesh on the boundary of a [`Polytope`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MeshFace {
    /// The number of the face in the mesh.
    pub id: u32,
    /// The mesh's numbers of the triangle's vertices.
    pub vertices: [u32; 3],
    /// The corners, counterclockwise seen from outside; not necessarily points of the polytope.
    pub corners: [DVec3; 3],
}
