//! The batch size: the number of rows answered between two checkpoints.

use std::time::Duration;

/// The size of the next batch.
///
/// A batch takes about half a second, so that results can be saved that often. It has at most 4,096
/// items, so that memory is bounded.
pub struct BatchSize {
    items: usize,
    /// The minimum size: one item for each thread.
    least: usize,
}

/// The target time of a batch, which is about the work lost by an interruption.
const BATCH: Duration = Duration::from_millis(500);

/// The maximum number of items in a batch.
const MAX_ITEMS: usize = 4096;

impl BatchSize {
    /// Starts with one item for each thread.
    pub fn new(threads: usize) -> Self {
        BatchSize {
            items: threads,
            least: threads,
        }
    }

    /// Returns the number of items for the next batch.
    pub fn items(&self) -> usize {
        self.items
    }

    /// Adapts the size to the time that a batch has taken.
    ///
    /// Threads wait for the slowest one at the end of a batch, so that sizes grow in few steps.
    pub fn adapt(&mut self, taken: Duration) {
        if taken < BATCH / 2 {
            let growth = if taken < BATCH / 16 { 8 } else { 2 };
            self.items = MAX_ITEMS.min(growth * self.items);
        } else if taken > 2 * BATCH {
            self.items = self.least.max(self.items / 2);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn batches_grow_only_for_quick_work() {
        let mut size = BatchSize::new(2);
        size.adapt(BATCH / 4);
        assert_eq!(size.items(), 4);
        size.adapt(BATCH / 32);
        assert_eq!(size.items(), 32);
        for _ in 0..20 {
            size.adapt(Duration::ZERO);
        }
        assert_eq!(size.items(), MAX_ITEMS);
        size.adapt(BATCH);
        assert_eq!(size.items(), MAX_ITEMS);
        for _ in 0..20 {
            size.adapt(3 * BATCH);
        }
        assert_eq!(size.items(), 2);
    }
}
