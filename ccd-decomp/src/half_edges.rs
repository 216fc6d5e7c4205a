//! Half-edges of triangles.

/// The number of a half-edge: `3 f + k` runs along face `f` from its corner `k` to the next.
pub(crate) type HalfEdge = u32;

/// Finds the twin of every half-edge, which runs along the same edge in the opposite direction; none unless
/// every half-edge has exactly one. O(n log n).
pub(crate) fn twins(triangles: &[[u32; 3]]) -> Option<Vec<HalfEdge>> {
    let mut edges: Vec<(u64, HalfEdge)> = Vec::with_capacity(3 * triangles.len());
    for (t, &[a, b, c]) in (0..).zip(triangles) {
        for (k, (v, w)) in (0..).zip([(a, b), (b, c), (c, a)]) {
            let (low, high) = (v.min(w), v.max(w));
            edges.push((u64::from(low) << 32 | u64::from(high), 3 * t + k));
        }
    }
    edges.sort_unstable();
    let start = |edge: HalfEdge| triangles[edge as usize / 3][edge as usize % 3];
    let mut twins = vec![0; edges.len()];
    let mut last = None;
    for pair in edges.chunks(2) {
        match *pair {
            [(key, one), (other_key, other)]
                if key == other_key && last != Some(key) && start(one) != start(other) =>
            {
                (twins[one as usize], twins[other as usize]) = (other, one);
                last = Some(key);
            }
            _ => return None,
        }
    }
    Some(twins)
}
