//! The reusable lists of the search for the nearest pieces.

use crate::engine::capacity::clear_and_shrink;
use crate::engine::nodes::siblings::Siblings;
use crate::engine::queue::Queue;

/// The lists of a search for the nearest pieces, whose memory is reused.
#[derive(Debug, Default)]
pub(crate) struct SearchBuffers {
    /// Pairs of nodes, ordered by lower bounds of their distances.
    pub(crate) waiting_pairs: Queue<Siblings>,
    /// All measured pairs of pieces that are not proven apart; their lower bounds are not positive.
    pub(crate) unseparated_pairs: Vec<[u32; 2]>,
    /// Scratch memory for the test whether one body is inside the other.
    pub(crate) containment_scratch: Vec<u32>,
}

impl SearchBuffers {
    pub(crate) fn clear(&mut self) {
        self.waiting_pairs.clear();
        clear_and_shrink(&mut self.unseparated_pairs);
        clear_and_shrink(&mut self.containment_scratch);
    }
}
