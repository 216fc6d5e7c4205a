//! Scratch memory that is kept from query to query, so that queries take none from the heap.

use super::nearest::lists::Lists;
use super::nodes::screw::Profiles;
use crate::distance::common_normals::CommonNormals;
use crate::distance::overlap::Inner;

/// The scratch memory, made when it is first needed.
pub(crate) type Scratch = Option<Box<Memory>>;

/// The lists that some queries need. They hold nothing for the next query.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    /// For the search for the nearest pieces.
    pub(crate) nearest: Lists,
    /// For the decision whether two pieces intersect.
    pub(crate) inner: Inner,
    /// For the surfaces around two points.
    pub(crate) normals: CommonNormals,
    /// For bodies that move along a screw.
    pub(crate) profiles: Profiles,
}
