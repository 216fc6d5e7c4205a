//! Half-edges of triangles, and the edges that they form.

use rayon::prelude::*;

/// The number of a half-edge, less than 2³¹. The half-edge `3 f + k` runs along face `f` from its corner `k` to the
/// next corner.
pub(crate) type HalfEdge = u32;

/// The half-edges of a list of triangles, sorted so that the half-edges on one edge are adjacent. Edges are in
/// ascending order of their end vertices, the smaller end first.
pub(crate) struct SortedHalfEdges(Vec<EdgeUse>);

/// A half-edge, with the undirected edge on which it lies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeUse {
    /// The end vertices of the edge, the smaller number first.
    ends: [u32; 2],
    half_edge: HalfEdge,
    /// Whether the half-edge runs from the larger end vertex to the smaller.
    pub(crate) is_backward: bool,
}

impl EdgeUse {
    pub(crate) fn face(self) -> u32 {
        self.half_edge / 3
    }

    /// Returns 1 if the half-edge runs from the smaller end vertex to the larger, and −1 otherwise.
    pub(crate) fn direction_sign(self) -> i32 {
        if self.is_backward { -1 } else { 1 }
    }
}

impl SortedHalfEdges {
    /// Sorts the half-edges of some triangles by edge, without those from a vertex to itself. O(n log n) in the number
    /// of triangles.
    pub(crate) fn new(triangles: &[[u32; 3]]) -> Self {
        let half_edges = (0..)
            .zip(triangles)
            .flat_map(|(t, &[a, b, c])| (3 * t..).zip([(a, b), (b, c), (c, a)]));
        let mut uses: Vec<EdgeUse> = half_edges
            .filter(|(_, (v, w))| v != w)
            .map(|(half_edge, (v, w))| EdgeUse {
                ends: [v.min(w), v.max(w)],
                half_edge,
                is_backward: v > w,
            })
            .collect();
        uses.par_sort_unstable_by_key(|of| {
            let [lower, upper] = of.ends.map(u64::from);
            (lower << 32 | upper, of.half_edge)
        });
        SortedHalfEdges(uses)
    }

    /// Iterates over the edges: for each, its two end vertices, and the half-edges on it in ascending order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = ([u32; 2], &[EdgeUse])> {
        let edges = self.0.chunk_by(|one, next| one.ends == next.ends);
        edges.map(|uses| (uses[0].ends, uses))
    }
}

/// Returns the twin of every half-edge of some triangles: the half-edge along the same edge in the opposite direction.
/// Returns `None` unless each half-edge has exactly one twin.
pub(crate) fn twins(triangles: &[[u32; 3]]) -> Option<Vec<HalfEdge>> {
    let edges = SortedHalfEdges::new(triangles);
    // Every half-edge is the use of one edge.
    if edges.0.len() != 3 * triangles.len() {
        return None;
    }
    let mut twins = vec![0; 3 * triangles.len()];
    for (_, uses) in edges.iter() {
        match *uses {
            [one, other] if one.is_backward != other.is_backward => {
                twins[one.half_edge as usize] = other.half_edge;
                twins[other.half_edge as usize] = one.half_edge;
            }
            _ => return None,
        }
    }
    Some(twins)
}

#[cfg(test)]
mod tests;
