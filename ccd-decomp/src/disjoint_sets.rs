//! Disjoint sets of elements, which are joined (union and find).

/// Disjoint sets: every element points to another one of its set, and the root to itself.
pub(crate) struct DisjointSets(Vec<u32>);

impl DisjointSets {
    /// Makes one set of each element.
    pub(crate) fn new(count: usize) -> Self {
        DisjointSets((0..count as u32).collect())
    }

    /// The representative of an element's set.
    pub(crate) fn root(&mut self, mut k: u32) -> u32 {
        // Every element but the root points to a smaller one.
        while self.0[k as usize] != k {
            // Halving the path keeps later ones short.
            self.0[k as usize] = self.0[self.0[k as usize] as usize];
            k = self.0[k as usize];
        }
        k
    }

    /// Makes one set of two.
    pub(crate) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}
