//! Sets that are joined until nothing more belongs together.

/// Sets that are joined: every element names another one of its set, the root itself.
pub(crate) struct DisjointSets(Vec<u32>);

impl DisjointSets {
    /// Each of so many elements by itself.
    pub(crate) fn new(count: usize) -> Self {
        DisjointSets((0..count as u32).collect())
    }

    /// The element that its set goes by.
    pub(crate) fn root(&mut self, mut k: u32) -> u32 {
        // Every element names a smaller one.
        while self.0[k as usize] != k {
            // Halving the way keeps later ones short.
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
