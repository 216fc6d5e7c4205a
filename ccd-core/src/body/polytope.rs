//! The input format of a piece.

use glam::DVec3;

/// A convex polytope, as input of [`Pieces::polytopes`](crate::Pieces::polytopes).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Polytope {
    /// The points; the polytope is their hull.
    pub points: Vec<DVec3>,
    /// The number of each point in its mesh. An empty list numbers them from 0.
    pub vertex_ids: Vec<u32>,
    /// The hull's facets, if known: they tile the boundary of the hull. A flat polygon has two.
    pub facets: Vec<Facet>,
    /// The mesh's faces that are on the hull's boundary and are not a facet by themselves.
    pub faces: Vec<Face>,
    /// The rounding radius, ≥ 0.
    pub radius: f64,
}

/// One facet of a [`Polytope`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Facet {
    /// The origin of the facet in the mesh.
    pub origin: Origin,
    /// The corners as indices into the polytope's points, counterclockwise seen from outside.
    pub corners: Vec<u32>,
}

/// The origin of a polytope's facet in the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Origin {
    /// The face with this number.
    Face(u32),
    /// Several coplanar faces, listed in [`Polytope::faces`].
    Faces,
    /// The facet is no part of the mesh, or only partly: it closes the polytope.
    Virtual,
}

/// A triangle of a mesh on the boundary of a [`Polytope`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Face {
    /// The number of the face in the mesh.
    pub id: u32,
    /// The numbers of the face's corners in the mesh.
    pub vertices: [u32; 3],
    /// The corners, counterclockwise seen from outside; not necessarily points of the polytope.
    pub corners: [DVec3; 3],
}
