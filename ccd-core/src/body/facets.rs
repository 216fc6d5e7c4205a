//! The facets of a piece.

use super::polytope::{Face, FacetOrigin};

/// The facets of a piece as convex polygons. Each is a loop of indices into the piece's points, counterclockwise seen
/// from outside. The mesh's faces on them are included.
#[derive(Clone, Copy, Debug)]
pub struct Facets<'a> {
    pub(crate) origins: &'a [FacetOrigin],
    /// The end of each facet's corners in `corners`, plus `first_corner`.
    pub(crate) ends: &'a [u32],
    pub(crate) corners: &'a [u32],
    pub(crate) first_corner: u32,
    pub(crate) faces: &'a [Face],
}

impl<'a> Facets<'a> {
    /// An empty list of facets.
    pub const NONE: Facets<'static> = Facets {
        origins: &[],
        ends: &[],
        corners: &[],
        first_corner: 0,
        faces: &[],
    };

    /// Returns the number of facets.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Returns whether no facet is known.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Returns the corner indices of each facet.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &'a [u32]> + Clone + use<'a> {
        let facets = *self;
        (0..facets.ends.len()).map(move |k| facets.get(k))
    }

    /// Returns the corner indices of facet `k`.
    pub(crate) fn get(&self, k: usize) -> &'a [u32] {
        let start = if k == 0 {
            self.first_corner
        } else {
            self.ends[k - 1]
        };
        &self.corners[start as usize..self.ends[k] as usize]
    }

    /// Returns for each facet which part of the mesh it came from.
    pub fn origins(&self) -> &'a [FacetOrigin] {
        self.origins
    }
}

/// Returns the directed edges of a loop of corners.
pub(crate) fn edges_of(corners: &[u32]) -> impl Iterator<Item = (u32, u32)> + Clone {
    let next = corners.iter().cycle().skip(1);
    corners.iter().copied().zip(next.copied())
}

/// Returns the triangles of a polygon, a fan about its first corner.
pub(crate) fn fan_of<T: Copy>(corners: &[T]) -> impl Iterator<Item = [T; 3]> + Clone {
    (2..corners.len()).map(|k| [corners[0], corners[k - 1], corners[k]])
}

/// Returns the `k`-th range of a list that is stored by the ends of its ranges.
#[inline]
pub(crate) fn range_from_ends(ends: &[u32], k: usize) -> std::ops::Range<usize> {
    let start = if k == 0 { 0 } else { ends[k - 1] };
    start as usize..ends[k] as usize
}
