//! Lists that some queries need, kept from query to query so that they take no memory from the heap.

use super::nodes::screw::Profiles;
use super::start::Lists;
use crate::distance::overlap::Inner;

/// The lists, made when they are first needed.
pub(crate) type Kept = Option<Box<Memory>>;

/// The lists; what they hold is of no use to the next query.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    /// Of the search among bodies in contact at the start.
    pub(crate) start: Lists,
    /// Of the decision whether two pieces intersect.
    pub(crate) inner: Inner,
    /// Of the look along a screw.
    pub(crate) profiles: Profiles,
}
