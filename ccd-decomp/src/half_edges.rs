//! Half-edges and edges of triangles.

/// The number of a half-edge: `3 f + k` runs along face `f` from its corner `k` to the next. Less than 2³¹.
pub(crate) type HalfEdge = u32;

/// The edges of triangles, in ascending order of their ends, the smaller end first.
pub(crate) struct Edges {
    /// The lower end vertices in use; empty if slots are vertex numbers.
    lower: Vec<u32>,
    /// The end of the uses of each lower end.
    ends: Vec<u32>,
    uses: Vec<Use>,
}

/// A use of an edge by a half-edge, packed: the upper end, the half-edge, and in the lowest bit whether it starts at
/// the upper end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Use(u64);

impl Use {
    fn new(upper: u32, half_edge: HalfEdge, backward: bool) -> Self {
        Use(u64::from(upper) << 32 | u64::from(half_edge) << 1 | u64::from(backward))
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
    /// Finds all edges, except from a vertex to itself. Linear in the number of triangles, if few edges meet at each
    /// vertex.
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
        let mut uses = vec![Use(0); end as usize];
        for (t, &[a, b, c]) in (0..).zip(triangles) {
            for (k, (v, w)) in (0..).zip([(a, b), (b, c), (c, a)]) {
                if v != w {
                    let end = &mut ends[slot(v.min(w))];
                    uses[*end as usize] = Use::new(v.max(w), 3 * t + k, v > w);
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

    /// Iterates over the edges: lower and upper end, and the uses in ascending order of half-edges.
    pub(crate) fn iter(&self) -> EdgesIter<'_> {
        EdgesIter {
            edges: self,
            slot: 0,
            at: 0,
        }
    }

    /// Returns the twin of every half-edge, which is opposite on the same edge; `None` unless each has exactly one.
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

/// The iterator over edges.
pub(crate) struct EdgesIter<'e> {
    edges: &'e Edges,
    /// The slot of the last edge's lower end, and the first use after it.
    slot: usize,
    at: usize,
}

impl<'e> Iterator for EdgesIter<'e> {
    type Item = ([u32; 2], &'e [Use]);

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        let Edges { lower, ends, uses } = self.edges;
        let start = self.at;
        let upper = uses.get(start)?.upper();
        while ends[self.slot] as usize <= start {
            self.slot += 1;
        }
        let end = ends[self.slot] as usize;
        while self.at < end && uses[self.at].upper() == upper {
            self.at += 1;
        }
        let lower = lower.get(self.slot).copied();
        let lower = lower.unwrap_or(self.slot as u32);
        Some(([lower, upper], &uses[start..self.at]))
    }
}

/// Returns the [twin](Edges::twins) of every half-edge.
pub(crate) fn twins(triangles: &[[u32; 3]]) -> Option<Vec<HalfEdge>> {
    Edges::new(triangles).twins(triangles.len())
}

#[cfg(test)]
mod tests;
