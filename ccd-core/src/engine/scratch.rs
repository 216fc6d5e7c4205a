//! Scratch memory that is reused from query to query, so that queries allocate nothing.

use super::search_buffers::SearchBuffers;
use crate::distance::common_normals::CommonNormals;
use crate::distance::overlap::ExpandingPolytope;
use crate::engine::shortcuts::screw::ProfileCache;
use crate::motion::span::Span;

/// The scratch memory of a solver, created when first needed.
pub(crate) type Scratch = Option<Box<ScratchMemory>>;

/// The lists that some queries need besides the queue. They carry no information to the next query.
#[derive(Debug, Default)]
pub(crate) struct ScratchMemory {
    /// The lists of the search for the nearest pieces.
    pub(crate) nearest_search_buffers: SearchBuffers,
    /// The polytope of the test whether two pieces intersect.
    pub(crate) expanding_polytope: ExpandingPolytope,
    /// The common normals of the surfaces around two nearest points.
    pub(crate) normals: CommonNormals,
    /// The profiles of nodes, for bodies that move along a screw.
    pub(crate) screw_profile_cache: ProfileCache,
    /// Lists for searches along trajectories, of which one may run within another.
    pub(crate) spare_span_lists: Vec<SpanLists>,
}

/// The lists of a search along trajectories.
#[derive(Debug, Default)]
pub(crate) struct SpanLists {
    /// The stretches of time that wait to be searched.
    pub(crate) waiting_spans: Vec<Span>,
    /// The work spent on each part of the query.
    pub(crate) work_by_part: Vec<u64>,
}
