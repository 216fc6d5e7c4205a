//! Lists of values by number, stored contiguously.

use super::facets::range_from_ends;

/// A list of values for each number from 0, such as the facets that meet in each corner.
#[derive(Clone, Debug)]
pub(crate) struct AdjacencyLists<V> {
    values: Vec<V>,
    /// The end of each number's values in `values`.
    ends: Vec<u32>,
}

impl<V: Copy + Default> AdjacencyLists<V> {
    /// Creates the lists from pairs of a number below `count` and a value. Each list keeps the order of the pairs.
    pub(crate) fn new(count: usize, pairs: impl Iterator<Item = (u32, V)> + Clone) -> Self {
        // The entries are first counts, then the next free positions, and finally the ends.
        let mut next = vec![0; count];
        pairs.clone().for_each(|(k, _)| next[k as usize] += 1);
        let mut end = 0;
        for next in &mut next {
            end += std::mem::replace(next, end);
        }
        let mut values = vec![V::default(); end as usize];
        for (k, value) in pairs {
            let at = &mut next[k as usize];
            values[*at as usize] = value;
            *at += 1;
        }
        AdjacencyLists { values, ends: next }
    }

    /// Returns the values of a number; empty for numbers without a list.
    #[inline]
    pub(crate) fn of(&self, k: usize) -> &[V] {
        if k < self.ends.len() {
            &self.values[range_from_ends(&self.ends, k)]
        } else {
            &[]
        }
    }
}

#[cfg(feature = "hull-tree")]
impl<V> AdjacencyLists<V> {
    /// Calls a function with each list.
    pub(super) fn for_each_list(&mut self, mut change: impl FnMut(&mut [V])) {
        (0..self.ends.len()).for_each(|k| change(&mut self.values[range_from_ends(&self.ends, k)]));
    }

    /// Returns the approximate memory use in bytes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.values.as_slice()) + size_of_val(self.ends.as_slice())
    }
}
