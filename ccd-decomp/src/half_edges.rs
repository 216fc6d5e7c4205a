//! Half-edges of triangles, and the edges that they form.

/// The number of a half-edge, less than 2³¹. The half-edge `3 f + k` runs along face `f` from its corner `k` to the
/// next corner.
pub(crate) type HalfEdge = u32;

/// The half-edges of a list of triangles, sorted so that the half-edges on one edge are adjacent. Edges are in
/// ascending order of their end vertices, the smaller end first.
pub(crate) struct SortedHalfEdges(Vec<EdgeUse>);

/// A half-edge, with the undirected edge on which it lies.
#[derive(Clone, Copy, Debug, Default)]
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
    /// Sorts the half-edges of some triangles by edge, without those from a vertex to itself. O(n) in the number of
    /// triangles if vertices have few edges, O(n log n) otherwise.
    pub(crate) fn new(triangles: &[[u32; 3]]) -> Self {
        let half_edges = (0..)
            .zip(triangles)
            .flat_map(|(t, &[a, b, c])| (3 * t..).zip([(a, b), (b, c), (c, a)]));
        let uses = half_edges
            .filter(|(_, (v, w))| v != w)
            .map(|(half_edge, (v, w))| EdgeUse {
                ends: [v.min(w), v.max(w)],
                half_edge,
                is_backward: v > w,
            });
        // A bin holds the uses of one smaller end, or of several if vertex numbers are sparse.
        let last = triangles.iter().flatten().max().map_or(0, |&v| v as usize);
        let bits = (last / (triangles.len() + 1)).checked_ilog2();
        let bin = |of: &EdgeUse| of.ends[0] as usize >> bits.map_or(0, |bits| bits + 1);
        let mut places = vec![0; 2 * triangles.len() + 3];
        for of in uses.clone() {
            places[bin(&of) + 1] += 1;
        }
        for k in 1..places.len() {
            places[k] += places[k - 1];
        }
        let mut sorted = vec![EdgeUse::default(); places[places.len() - 1]];
        for of in uses {
            let place = &mut places[bin(&of)];
            sorted[*place] = of;
            *place += 1;
        }
        for of_bin in sorted.chunk_by_mut(|one, next| bin(one) == bin(next)) {
            of_bin.sort_unstable_by_key(|of| (of.ends, of.half_edge));
        }
        SortedHalfEdges(sorted)
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
