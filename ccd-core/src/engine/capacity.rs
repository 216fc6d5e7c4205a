//! Empties lists, and limits the memory that they keep from query to query.

/// The most memory that a list keeps for the next query, in bytes. It holds 120,000 waiting pairs, more than almost any
/// query has. A query that needs more gives the rest back, so that a solver does not keep a gigabyte after one large
/// query. Common allocators return blocks above this size to the system.
const MOST_KEPT: usize = 1 << 25;

/// Empties a list for the next query, and gives back the memory beyond [`MOST_KEPT`].
pub(crate) fn empty<T>(list: &mut Vec<T>) {
    list.clear();
    list.shrink_to(MOST_KEPT / size_of::<T>());
}

#[cfg(test)]
mod tests;
