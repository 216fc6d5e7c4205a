//! Lists kept from query to query, so that queries take no memory from the heap.

use super::nearest::Lists;
use super::nodes::screw::Profiles;
use crate::distance::common_normals::CommonNormals;
use crate::distance::overlap::Inner;

/// The lists, made when they are first needed.
pub(crate) type Kept = Option<Box<Memory>>;

/// The lists that some queries need; what they hold is of no use to the next query.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    /// Of the search for the nearest pieces.
    pub(crate) nearest: Lists,
    /// Of the decision whether two pieces intersect.
    pub(crate) inner: Inner,
    /// Of the surfaces around two points.
    pub(crate) normals: CommonNormals,
    /// Of the look along a screw.
    pub(crate) profiles: Profiles,
}

/// The most memory that a list keeps for the next query, in bytes: 120,000 waiting pairs, more than almost any
/// query has. A query that needs more gives the rest back: a solver that once met its budget keeps no gigabyte.
/// Common allocators return blocks above this size to the system.
const MOST_KEPT: usize = 1 << 25;

/// Empties a list for the next query, and gives back the memory beyond [`MOST_KEPT`].
pub(crate) fn empty<T>(list: &mut Vec<T>) {
    list.clear();
    list.shrink_to(MOST_KEPT / size_of::<T>());
}

#[cfg(test)]
mod tests;
