//! The batch size: the number of rows answered between two checkpoints.

use std::time::Duration;

/// The number of rows in the next batch, adapted to the time that earlier batches took.
///
/// A batch takes about half a second, so that results can be saved that often. It has at most 4,096
/// items, so that memory is bounded.
pub struct BatchSize {
    row_count: usize,
    /// The smallest allowed number of rows in a batch: one for each thread.
    min_row_count: usize,
}

/// The target duration of a batch; an interruption loses at most about this much work.
const TARGET_DURATION: Duration = Duration::from_millis(500);

/// The maximum number of rows in a batch.
const MAX_ROWS: usize = 4096;

impl BatchSize {
    /// Starts with a batch of one row for each thread.
    pub fn new(threads: usize) -> Self {
        BatchSize {
            row_count: threads,
            min_row_count: threads,
        }
    }

    /// Returns the number of rows for the next batch.
    pub fn row_count(&self) -> usize {
        self.row_count
    }

    /// Adapts the number of rows to `taken`, the duration of the last batch.
    ///
    /// Threads wait for the slowest one at the end of a batch, so that sizes grow in few steps.
    pub fn adapt(&mut self, taken: Duration) {
        if taken < TARGET_DURATION / 2 {
            let growth = if taken < TARGET_DURATION / 16 { 8 } else { 2 };
            self.row_count = MAX_ROWS.min(growth * self.row_count);
        } else if taken > 2 * TARGET_DURATION {
            self.row_count = self.min_row_count.max(self.row_count / 2);
        }
    }
}

#[cfg(test)]
mod tests;
