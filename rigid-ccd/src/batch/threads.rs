//! Threads that process many items batch by batch, in order.

use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::num::NonZeroUsize;
use std::thread::available_parallelism;
use std::time::{Duration, Instant};

/// Threads, and the size of the next batch for them.
///
/// A batch takes about half a second, so that results can be saved that often. It has at most 4,096
/// items, so that memory is bounded.
pub struct Threads {
    /// None for one thread.
    pool: Option<ThreadPool>,
    batch: usize,
}

/// The time that a batch should take: an interruption loses about as much work.
const BATCH: Duration = Duration::from_millis(500);

/// The most items in a batch.
const MAX_ITEMS: usize = 4096;

impl Threads {
    /// Starts threads, by default one for each core.
    ///
    /// # Errors
    /// The threads cannot be started.
    pub fn new(threads: Option<NonZeroUsize>) -> Result<Self, ThreadPoolBuildError> {
        let all = || available_parallelism().unwrap_or(NonZeroUsize::MIN);
        let threads = threads.unwrap_or_else(all).get();
        let pool = || ThreadPoolBuilder::new().num_threads(threads).build();
        Ok(Threads {
            pool: (threads > 1).then(pool).transpose()?,
            batch: threads,
        })
    }

    /// Returns the number of threads.
    pub fn threads(&self) -> NonZeroUsize {
        let threads = self
            .pool
            .as_ref()
            .map_or(1, ThreadPool::current_num_threads);
        NonZeroUsize::new(threads).unwrap_or(NonZeroUsize::MIN)
    }

    /// Returns the number of items that the next batch should have.
    pub fn batch(&self) -> usize {
        self.batch
    }

    /// Calls `work` with the number of the thread and each item, and adapts the size of the next batch;
    /// results are in the order of the items.
    pub fn work<T: Sync, R: Send>(
        &mut self,
        items: &[T],
        work: impl Fn(usize, &T) -> R + Sync,
    ) -> Vec<R> {
        let start = Instant::now();
        let results = self.map(items, work);
        let taken = start.elapsed();
        if taken < BATCH / 2 {
            self.batch = MAX_ITEMS.min(2 * self.batch);
        } else if taken > 2 * BATCH {
            self.batch = self.threads().get().max(self.batch / 2);
        }
        results
    }

    /// Calls `work` as [`Threads::work`] does, and keeps the size of the next batch.
    pub fn map<T: Sync, R: Send>(
        &self,
        items: &[T],
        work: impl Fn(usize, &T) -> R + Sync,
    ) -> Vec<R> {
        let Some(pool) = &self.pool else {
            return items.iter().map(|item| work(0, item)).collect();
        };
        let here = |item| work(rayon::current_thread_index().unwrap_or(0), item);
        pool.install(|| items.par_iter().map(here).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_in_order_on_any_number_of_threads() {
        let items: Vec<usize> = (0..10_000).collect();
        for threads in [1, 2, 5] {
            let mut quick = Threads::new(NonZeroUsize::new(threads)).unwrap();
            assert_eq!(quick.threads().get(), threads);
            let done = quick.work(&items, |thread, item| (thread, 3 * item));
            assert!(done.iter().all(|&(thread, _)| thread < threads));
            assert!(
                done.iter()
                    .zip(&items)
                    .all(|(done, item)| done.1 == 3 * item)
            );
        }
    }

    #[test]
    fn batches_grow_only_for_quick_work() {
        let mut quick = Threads::new(NonZeroUsize::new(2)).unwrap();
        for _ in 0..20 {
            quick.work(&[0], |_, _| ());
        }
        assert_eq!(quick.batch(), MAX_ITEMS);
        let mut slow = Threads::new(NonZeroUsize::new(1)).unwrap();
        slow.work(&[0], |_, _| std::thread::sleep(3 * BATCH));
        assert_eq!(slow.batch(), 1);
    }
}
