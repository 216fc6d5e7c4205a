//! Lists the members of disjoint sets of integers.

pub(crate) use ccd_core::DisjointSets;

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
