//! Many lists of values in one contiguous array, addressed by a number.

use super::facets::range_from_ends;

/// One list of values for each number from 0, such as the facets that meet in each corner of a polytope.
#[derive(Clone, Debug)]
pub(crate) struct AdjacencyLists<V> {
    values: Vec<V>,
    /// The end of each list in `values`; each list starts where the previous one ends.
    list_ends: Vec<u32>,
}

impl<V: Copy + Default> AdjacencyLists<V> {
    /// Creates `count` lists from pairs of a list's number and a value for that list. Each list keeps the order of the
    /// pairs.
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
        AdjacencyLists {
            values,
            list_ends: next,
        }
    }

    /// Returns the list with number `k`; empty if there is no such list.
    #[inline]
    pub(crate) fn list(&self, k: usize) -> &[V] {
        if k < self.list_ends.len() {
            &self.values[range_from_ends(&self.list_ends, k)]
        } else {
            &[]
        }
    }
}

#[cfg(feature = "hull-tree")]
impl<V> AdjacencyLists<V> {
    /// Calls a function with each list, which it may change in place.
    pub(super) fn for_each_list(&mut self, mut change: impl FnMut(&mut [V])) {
        (0..self.list_ends.len())
            .for_each(|k| change(&mut self.values[range_from_ends(&self.list_ends, k)]));
    }

    /// Returns the approximate memory use in bytes.
    pub(super) fn memory_usage(&self) -> usize {
        size_of_val(self.values.as_slice()) + size_of_val(self.list_ends.as_slice())
    }
}
