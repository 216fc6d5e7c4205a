//! A union-find structure for disjoint sets of integers.

/// A partition of the elements `0..n` into disjoint sets. Every element points to another element of its set, and the
/// root to itself.
pub(crate) struct DisjointSets(Vec<u32>);

impl DisjointSets {
    /// Creates one set for each of the elements `0..count`.
    pub(crate) fn new(count: usize) -> Self {
        DisjointSets((0..count as u32).collect())
    }

    /// Returns the smallest element of the set that contains `k`.
    pub(crate) fn root(&mut self, mut k: u32) -> u32 {
        // Every element but the root points to a smaller one.
        while self.0[k as usize] != k {
            // Path halving keeps later searches short.
            self.0[k as usize] = self.0[self.0[k as usize] as usize];
            k = self.0[k as usize];
        }
        k
    }

    /// Returns, for each element, the number of its set. Sets are numbered in the order of their smallest elements.
    pub(crate) fn set_index_by_element(&mut self) -> Vec<u32> {
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

    /// Merges the sets that contain two elements into one set.
    pub(crate) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

/// Returns the elements of each set in ascending order, given the [number](DisjointSets::set_index_by_element) of each element's
/// set.
pub(crate) fn members_by_set(numbers: &[u32]) -> Vec<Vec<u32>> {
    let count = numbers.iter().max().map_or(0, |&last| last as usize + 1);
    let mut members = vec![Vec::new(); count];
    for (element, &number) in (0..).zip(numbers) {
        members[number as usize].push(element);
    }
    members
}
