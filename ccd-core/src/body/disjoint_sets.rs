//! A union-find structure for disjoint sets of integers.

/// A partition of the elements `0..n` into disjoint sets. Every element points to another element of its set, and the
/// root to itself.
#[derive(Debug)]
pub struct DisjointSets(Vec<u32>);

impl DisjointSets {
    /// Creates one set for each of the elements `0..count`.
    #[inline]
    pub fn new(count: usize) -> Self {
        DisjointSets((0..count as u32).collect())
    }

    /// Creates the sets in which each element is in the set of the one that is listed for it: a root of a set, or the
    /// element itself.
    pub(super) fn from_roots(roots: Vec<u32>) -> Self {
        DisjointSets(roots)
    }

    /// Returns the smallest element of the set that contains `k`.
    #[inline]
    pub fn root(&mut self, mut k: u32) -> u32 {
        // Every element but the root points to a smaller one.
        while self.0[k as usize] != k {
            // Path halving keeps later searches short.
            self.0[k as usize] = self.0[self.0[k as usize] as usize];
            k = self.0[k as usize];
        }
        k
    }

    /// Returns, for each element, the number of its set. Sets are numbered in the order of their smallest elements.
    pub fn set_index_by_element(&mut self) -> Vec<u32> {
        let mut numbers = Vec::with_capacity(self.0.len());
        let mut count = 0;
        for k in 0..self.0.len() as u32 {
            let root = self.root(k);
            // A root comes before all others of its set.
            let number = if root == k {
                count += 1;
                count - 1
            } else {
                numbers[root as usize]
            };
            numbers.push(number);
        }
        numbers
    }

    /// Joins the sets of two elements, and returns whether the sets were different before.
    #[inline]
    pub fn join(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
        a != b
    }
}
