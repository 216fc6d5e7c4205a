//! Empties lists, and limits the memory that they keep from query to query.

/// The most memory that a list keeps for the next query, in bytes. It holds 120,000 waiting pairs, more than almost any
/// query has. A query that needs more gives the rest back, so that a solver does not keep a gigabyte after one large
/// query. Common allocators return blocks above this size to the system.
const MAX_KEPT_BYTES: usize = 1 << 25;

/// Empties a list for the next query, and gives back the memory beyond [`MAX_KEPT_BYTES`].
pub(crate) fn clear_and_shrink<T>(list: &mut Vec<T>) {
    list.clear();
    list.shrink_to(MAX_KEPT_BYTES / size_of::<T>());
}

#[cfg(test)]
mod tests;
