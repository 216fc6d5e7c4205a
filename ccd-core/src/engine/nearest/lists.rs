//! The lists of the search for the nearest pieces.

use crate::engine::capacity::empty;
use crate::engine::nodes::siblings::Siblings;
use crate::engine::queue::Queue;

/// The lists of a search; their memory is kept between searches.
#[derive(Debug, Default)]
pub(crate) struct Lists {
    /// Pairs of nodes, ordered by lower bounds of their distances.
    pub(crate) waiting: Queue<Siblings>,
    /// All pairs of pieces without a separating axis, which have no distance.
    pub(crate) touching: Vec<[u32; 2]>,
    /// A list of pieces for the search for one body inside the other.
    pub(crate) pieces: Vec<u32>,
}

impl Lists {
    pub(crate) fn clear(&mut self) {
        self.waiting.clear();
        empty(&mut self.touching);
        empty(&mut self.pieces);
    }

    /// Returns all pairs of pieces that no axis separates, and a list of pieces as scratch memory.
    pub(crate) fn touching(&mut self) -> (&[[u32; 2]], &mut Vec<u32>) {
        (&self.touching, &mut self.pieces)
    }
}
