//! Convex polytopes prepared for marching: corners, edges, faces, and the Voronoi planes between them `[VCLIP98 §3.1]`.

mod assemble;
mod build;
mod convex;
mod facets;
mod merge;
mod support;
#[cfg(test)]
mod tests;

use crate::feature::Feature;
pub(crate) use facets::unit_or_zero;
use support::StartVertexTable;

use ccd_core::glam::DVec3;

/// A convex piece with the planes that bound the Voronoi regions of its features.
///
/// Coordinates are relative to [`Polytope::origin_in_piece`], so that their rounding depends on the piece's
/// size, not its position. Every list is flat, and features are numbers.
///
/// # Guarantee
/// - Coplanar facets are one face; points within an edge, or within a face, are no corners.
/// - A piece of one point is one corner without edges, one of two points an edge without faces, a
///   flat one has two faces, front and back.
/// - Otherwise the faces close a surface that is convex up to rounding, once around.
///
/// # Memory
/// About 700 bytes for each corner of a polytope of triangles.
#[derive(Clone, Debug)]
pub(crate) struct Polytope {
    /// The position of the polytope's origin in the piece's coordinates.
    pub(crate) origin_in_piece: DVec3,
    /// The distance of the farthest corner from the origin.
    pub(crate) reach: f64,
    pub(crate) vertices: Vec<Vertex>,
    pub(crate) outgoing_edges: Vec<OutgoingEdge>,
    pub(crate) edges: Vec<Edge>,
    pub(crate) faces: Vec<Face>,
    pub(crate) sides: Vec<FaceEdge>,
    /// A table of corners from which hill climbing starts; `None` for polytopes of few corners, which are scanned.
    start_vertex_table: Option<Box<StartVertexTable>>,
}

/// A corner of the polytope, and the range of its outgoing edges.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertex {
    pub(crate) point: DVec3,
    /// The index of the corner in the piece's points.
    pub(crate) point_index: u32,
    first_outgoing_edge: u32,
    outgoing_edges_end: u32,
}

/// An edge as seen from one of its end vertices. Its direction is the normal of a vertex-edge plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OutgoingEdge {
    /// The unit vector away from the vertex along the edge.
    pub(crate) edge_direction: DVec3,
    pub(crate) edge: u32,
    /// The vertex at the other end.
    pub(crate) end_vertex: u32,
}

/// An edge between two faces, or the only edge of a polytope without faces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    pub(crate) start: DVec3,
    /// The unit vector from the start to the end.
    pub(crate) direction: DVec3,
    pub(crate) length: f64,
    /// The unit vectors from the edge into the two faces that meet here, which are the normals of the face-edge planes.
    /// Zero for a missing face.
    pub(crate) inward_directions: [DVec3; 2],
    pub(crate) ends: [u32; 2],
    /// The indices of the two faces that meet here; [`NO_FACE`] for a missing one.
    pub(crate) faces: [u32; 2],
}

/// The index that stands for a missing face.
pub(crate) const NO_FACE: u32 = u32::MAX;

/// A face of the polytope: a convex polygon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face {
    /// The outward unit normal.
    pub(crate) normal: DVec3,
    first_side: u32,
    sides_end: u32,
}

/// A side of a face; the sides of a face are ordered counterclockwise as seen from outside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FaceEdge {
    /// The unit vector into the face, the same as in [`Edge::inward_directions`].
    pub(crate) inward_direction: DVec3,
    /// The start of the edge, the same as [`Edge::start`], so that tests against the edge and against the face give the
    /// same bits.
    pub(crate) start: DVec3,
    pub(crate) edge: u32,
    /// The corner at which the side starts in the face's order.
    pub(crate) vertex: u32,
}

impl Edge {
    /// Returns whether a point is outside of both face-edge planes by more than `slack`, given its components along
    /// `inward`.
    #[inline(always)]
    pub(crate) fn is_outside_voronoi_planes(&self, inward: [f64; 2], slack: f64) -> bool {
        let alone = self.faces == [NO_FACE; 2];
        alone || inward.iter().all(|&into| into < -slack)
    }
}

impl Polytope {
    #[inline]
    pub(crate) fn vertex(&self, v: u32) -> &Vertex {
        &self.vertices[v as usize]
    }

    #[inline]
    pub(crate) fn edge(&self, e: u32) -> &Edge {
        &self.edges[e as usize]
    }

    #[inline]
    pub(crate) fn face(&self, f: u32) -> &Face {
        &self.faces[f as usize]
    }

    /// Returns the edges at a vertex, each directed away from it.
    #[inline]
    pub(crate) fn outgoing_edges_of(&self, v: u32) -> &[OutgoingEdge] {
        let vertex = self.vertex(v);
        &self.outgoing_edges
            [vertex.first_outgoing_edge as usize..vertex.outgoing_edges_end as usize]
    }

    /// Returns the sides of a face, counterclockwise as seen from outside.
    #[inline]
    pub(crate) fn sides_of(&self, f: u32) -> &[FaceEdge] {
        let face = self.face(f);
        &self.sides[face.first_side as usize..face.sides_end as usize]
    }

    /// Returns the edges that contain a feature: those at a vertex, or the edge itself; an empty list for a face.
    pub(crate) fn edges_containing(&self, feature: Feature) -> Vec<u32> {
        match feature {
            Feature::Vertex(v) => self
                .outgoing_edges_of(v)
                .iter()
                .map(|spoke| spoke.edge)
                .collect(),
            Feature::Edge(e) => vec![e],
            Feature::Face(_) => Vec::new(),
        }
    }

    /// Returns the faces that contain a feature, in ascending order; `edges` are the edges that contain the feature.
    pub(crate) fn faces_containing(&self, feature: Feature, edges: &[u32]) -> Vec<u32> {
        let mut faces: Vec<u32> = match feature {
            Feature::Face(f) => vec![f],
            _ => edges.iter().flat_map(|&e| self.edge(e).faces).collect(),
        };
        faces.sort_unstable();
        faces.dedup();
        faces.retain(|&f| f != NO_FACE);
        faces
    }

    /// Returns whether the polytope has a feature with this number.
    #[inline]
    pub(crate) fn has_feature(&self, feature: Feature) -> bool {
        let (number, count) = match feature {
            Feature::Vertex(v) => (v, self.vertices.len()),
            Feature::Edge(e) => (e, self.edges.len()),
            Feature::Face(f) => (f, self.faces.len()),
        };
        (number as usize) < count
    }

    /// Returns the number of vertices, edges and faces together.
    pub(crate) fn feature_count(&self) -> usize {
        self.vertices.len() + self.edges.len() + self.faces.len()
    }
}
