//! The vertex, edge or face of a body that is in contact.

use rigid_ccd::answer::Feature;

/// The kind of a feature, which says what its indices mean.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RccdFeatureKind {
    /// There is no feature: both indices are 0.
    None = 0,
    /// The vertex `first` of the mesh.
    Vertex = 1,
    /// The edge between the vertices `first` and `second`.
    Edge = 2,
    /// The face `first` of the mesh.
    Face = 3,
    /// The piece `first`, whose facets are unknown or no faces of the mesh.
    Piece = 4,
}

/// A feature of a body, by the numbers of the mesh, from 0.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RccdFeature {
    /// What the indices mean.
    pub kind: RccdFeatureKind,
    /// The vertex, face or piece; the first vertex of an edge.
    pub first: u32,
    /// The second vertex of an edge; 0 for others.
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
