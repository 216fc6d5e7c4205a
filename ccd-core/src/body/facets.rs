//! A view of a piece's facets: their corners, the part of the mesh that each comes from, and the mesh's faces on them.

use super::polytope::{FacetOrigin, MeshFace};

/// The facets of a piece as convex polygons. Each is a loop of indices into the piece's points, counterclockwise seen
/// from outside. The mesh's faces on them are included.
#[derive(Clone, Copy, Debug)]
pub struct Facets<'a> {
    pub(crate) facet_sources: &'a [FacetOrigin],
    /// The end of each facet's corners in `corners`; the first facet starts at `corners_start_index`.
    pub(crate) ends: &'a [u32],
    pub(crate) corners: &'a [u32],
    pub(crate) corners_start_index: u32,
    pub(crate) mesh_faces: &'a [MeshFace],
}

impl<'a> Facets<'a> {
    /// An empty list of facets, for a piece whose facets are unknown.
    pub const EMPTY: Facets<'static> = Facets {
        facet_sources: &[],
        ends: &[],
        corners: &[],
        corners_start_index: 0,
        mesh_faces: &[],
    };

    /// Returns the number of facets.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Returns whether no facet is known.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Returns, for each facet, the indices of its corners among the piece's points.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &'a [u32]> + Clone + use<'a> {
        let facets = *self;
        (0..facets.ends.len()).map(move |k| facets.get(k))
    }

    /// Returns the indices of the corners of facet `k` among the piece's points.
    pub(crate) fn get(&self, k: usize) -> &'a [u32] {
        let start = if k == 0 {
            self.corners_start_index
        } else {
            self.ends[k - 1]
        };
        &self.corners[start as usize..self.ends[k] as usize]
    }

    /// Returns, for each facet, its origin in the mesh: a face, several faces, or none.
    pub fn origins_in_mesh(&self) -> &'a [FacetOrigin] {
        self.facet_sources
    }
}

/// Returns the directed edges of a closed loop of corners, as pairs of the start and the end.
pub(crate) fn edges_of(corners: &[u32]) -> impl Iterator<Item = (u32, u32)> + Clone {
    let next = corners.iter().cycle().skip(1);
    corners.iter().copied().zip(next.copied())
}

/// Returns the triangles of a fan about the first corner of a polygon.
pub fn fan_triangles<T: Copy>(corners: &[T]) -> impl Iterator<Item = [T; 3]> + Clone {
    (2..corners.len()).map(|k| [corners[0], corners[k - 1], corners[k]])
}

/// Returns the `k`-th of consecutive index ranges, given the end of each range; the first range starts at 0.
#[inline]
pub(crate) fn range_from_ends(ends: &[u32], k: usize) -> std::ops::Range<usize> {
    let start = if k == 0 { 0 } else { ends[k - 1] };
    start as usize..ends[k] as usize
}
