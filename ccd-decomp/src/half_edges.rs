//! Half-edges of triangles, and the edges that they form.

/// The number of a half-edge: `3 f + k` runs along face `f` from its corner `k` to the next. Less than 2³¹.
pub(crate) type HalfEdge = u32;

/// The edges of a list of triangles, in ascending order of their end vertices, the smaller end first.
pub(crate) struct Edges {
    /// The vertices that are the smaller end of some edge, ascending; empty if slots are vertex numbers.
    lower: Vec<u32>,
    /// For each smaller end, the end of its range in the list of uses.
    ends: Vec<u32>,
    uses: Vec<EdgeUse>,
}

/// A half-edge on an edge, packed in one number: the upper end, the half-edge, and in the lowest bit whether it
/// starts at the upper end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct EdgeUse(u64);

impl EdgeUse {
    fn new(upper: u32, half_edge: HalfEdge, backward: bool) -> Self {
        EdgeUse(u64::from(upper) << 32 | u64::from(half_edge) << 1 | u64::from(backward))
    }

    fn upper(self) -> u32 {
        (self.0 >> 32) as u32
    }

    pub(crate) fn half_edge(self) -> HalfEdge {
        self.0 as u32 >> 1
    }

    pub(crate) fn face(self) -> u32 {
        self.half_edge() / 3
    }

    /// Returns 1 if the half-edge runs from the lower end to the upper, else −1.
    pub(crate) fn direction(self) -> i32 {
        if self.is_backward() { -1 } else { 1 }
    }

    /// Returns whether the half-edge runs from the upper end to the lower.
    pub(crate) fn is_backward(self) -> bool {
        self.0 & 1 == 1
    }
}

impl Edges {
    /// Finds all edges, except from a vertex to itself. Takes linear time in the number of triangles, if few edges
    /// meet at each vertex.
    pub(crate) fn new(triangles: &[[u32; 3]]) -> Self {
        let last = triangles.iter().flatten().max();
        let range = last.map_or(0, |&last| last as usize + 1);
        // A table of all vertices must not dwarf the triangles.
        if range <= 8 * triangles.len() {
            Edges::by_slot(triangles, Vec::new(), range, |_, vertex| vertex as usize)
        } else {
            let mut lower: Vec<u32> = triangles.iter().flatten().copied().collect();
            lower.sort_unstable();
            lower.dedup();
            let slots = lower.len();
            Edges::by_slot(triangles, lower, slots, |lower, vertex| {
                lower.partition_point(|&v| v < vertex)
            })
        }
    }

    fn by_slot(
        triangles: &[[u32; 3]],
        lower: Vec<u32>,
        slots: usize,
        slot: impl Fn(&[u32], u32) -> usize,
    ) -> Self {
        let slot = |vertex: u32| slot(&lower, vertex);
        let mut ends = vec![0u32; slots];
        for &[a, b, c] in triangles {
            for (v, w) in [(a, b), (b, c), (c, a)] {
                ends[slot(v.min(w))] += u32::from(v != w);
            }
        }
        let mut end = 0;
        for next in &mut ends {
            end += std::mem::replace(next, end);
        }
        let mut uses = vec![EdgeUse(0); end as usize];
        for (t, &[a, b, c]) in (0..).zip(triangles) {
            for (k, (v, w)) in (0..).zip([(a, b), (b, c), (c, a)]) {
                if v != w {
                    let end = &mut ends[slot(v.min(w))];
                    uses[*end as usize] = EdgeUse::new(v.max(w), 3 * t + k, v > w);
                    *end += 1;
                }
            }
        }
        let mut start = 0;
        for &end in &ends {
            uses[start..end as usize].sort_unstable();
            start = end as usize;
        }
        Edges { lower, ends, uses }
    }

    /// Iterates over the edges: the two end vertices, and the half-edges on the edge in ascending order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = ([u32; 2], &[EdgeUse])> {
        let starts = std::iter::once(&0).chain(&self.ends);
        let slots = (0..).zip(starts.zip(&self.ends));
        slots.flat_map(|(slot, (&start, &end))| {
            let lower = self.lower.get(slot as usize).copied().unwrap_or(slot);
            let uses = &self.uses[start as usize..end as usize];
            let edges = uses.chunk_by(|one, next| one.upper() == next.upper());
            edges.map(move |uses| ([lower, uses[0].upper()], uses))
        })
    }

    /// Returns the twin of every half-edge: the half-edge on the same edge in the opposite direction. Returns `None`
    /// unless each half-edge has exactly one twin.
    pub(crate) fn twins(&self, triangles: usize) -> Option<Vec<HalfEdge>> {
        // Every half-edge is the use of one edge.
        if self.uses.len() != 3 * triangles {
            return None;
        }
        let mut twins = vec![0; 3 * triangles];
        for (_, uses) in self.iter() {
            match *uses {
                [one, other] if one.is_backward() != other.is_backward() => {
                    twins[one.half_edge() as usize] = other.half_edge();
                    twins[other.half_edge() as usize] = one.half_edge();
                }
                _ => return None,
            }
        }
        Some(twins)
    }
}

/// Returns the [twin](Edges::twins) of every half-edge.
pub(crate) fn twins(triangles: &[[u32; 3]]) -> Option<Vec<HalfEdge>> {
    Edges::new(triangles).twins(triangles.len())
}

#[cfg(test)]
mod tests;
