//! The vertex, edge or face of a body that is in contact.

use rigid_ccd::answer::Feature;

/// The kind of a feature. It determines the meaning of the indices.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RccdFeatureKind {
    /// No feature. Both indices are 0.
    None = 0,
    /// The vertex `first` of the mesh.
    Vertex = 1,
    /// The edge between the vertices `first` and `second`.
    Edge = 2,
    /// The face `first` of the mesh.
    Face = 3,
    /// The convex piece `first`, for a piece without known facets, or with facets that are not faces of the mesh.
    Piece = 4,
}

/// A feature of a body. Indices are those of the mesh and start at 0.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RccdFeature {
    /// The kind of the feature.
    pub kind: RccdFeatureKind,
    /// The index of the vertex, face or piece, or of the first vertex of an edge.
    pub first: u32,
    /// The index of the second vertex of an edge; 0 for other kinds.
    pub second: u32,
}

impl RccdFeature {
    pub(crate) const NONE: RccdFeature = RccdFeature {
        kind: RccdFeatureKind::None,
        first: 0,
        second: 0,
    };
}

impl From<Feature> for RccdFeature {
    fn from(feature: Feature) -> Self {
        let (kind, first, second) = match feature {
            Feature::Vertex(vertex) => (RccdFeatureKind::Vertex, vertex, 0),
            Feature::Edge(first, second) => (RccdFeatureKind::Edge, first, second),
            Feature::Face(face) => (RccdFeatureKind::Face, face, 0),
            Feature::Piece(piece) => (RccdFeatureKind::Piece, piece, 0),
        };
        RccdFeature {
            kind,
            first,
            second,
        }
    }
}
