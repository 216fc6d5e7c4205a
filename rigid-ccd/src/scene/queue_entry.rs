//! Entries of a queue of pairs of bodies, ordered by time.

use std::cmp::Ordering;

/// An entry of a queue: a pair of bodies, a time, and the data for what is to be done with the pair at that time. The
/// earliest entry counts as the greatest, which a heap has first.
pub(super) struct QueueEntry<T> {
    pub(super) time: f64,
    pub(super) pair: [usize; 2],
    pub(super) item: T,
}

impl<T> Ord for QueueEntry<T> {
    fn cmp(&self, other: &Self) -> Ordering {
        (other.time.total_cmp(&self.time)).then(other.pair.cmp(&self.pair))
    }
}

impl<T> PartialOrd for QueueEntry<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T> Eq for QueueEntry<T> {}

impl<T> PartialEq for QueueEntry<T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
