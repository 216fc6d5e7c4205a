//! Threads that work through a long row of things, batch by batch, in order.

use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::num::NonZeroUsize;
use std::thread::available_parallelism;
use std::time::{Duration, Instant};

/// Some threads, and how many things to give them at once.
///
/// Batches are as many things as take about half a second, so that what is done can be kept that often, and
/// no more than 4,096, so that memory is bounded whatever there is to do.
pub struct Threads {
    /// None where one thread does it all.
    pool: Option<ThreadPool>,
    batch: usize,
}

/// How long a batch should take, about: work that is lost when it is interrupted.
const BATCH: Duration = Duration::from_millis(500);

/// The most things in a batch.
const MOST: usize = 4096;

impl Threads {
    /// So many threads; as many as there are cores by default.
    ///
    /// # Errors
    /// When they cannot be had.
    pub fn new(threads: Option<NonZeroUsize>) -> Result<Self, ThreadPoolBuildError> {
        let all = || available_parallelism().unwrap_or(NonZeroUsize::MIN);
        let threads = threads.unwrap_or_else(all).get();
        let pool = || ThreadPoolBuilder::new().num_threads(threads).build();
        Ok(Threads {
            pool: (threads > 1).then(pool).transpose()?,
            batch: threads,
        })
    }

    /// How many there are.
    pub fn threads(&self) -> NonZeroUsize {
        let threads = self
            .pool
            .as_ref()
            .map_or(1, ThreadPool::current_num_threads);
        NonZeroUsize::new(threads).unwrap_or(NonZeroUsize::MIN)
    }

    /// How many things the next batch should have.
    pub fn batch(&self) -> usize {
        self.batch
    }

    /// Does the work on every thing, told the number of the thread it runs on; results are in the order
    /// of the things.
    pub fn work<T: Sync, R: Send>(
        &mut self,
        things: &[T],
        work: impl Fn(usize, &T) -> R + Sync,
    ) -> Vec<R> {
        let start = Instant::now();
        let results = self.map(things, work);
        let taken = start.elapsed();
        if taken < BATCH / 2 {
            self.batch = MOST.min(2 * self.batch);
        } else if taken > 2 * BATCH {
            self.batch = self.threads().get().max(self.batch / 2);
        }
        results
    }

    /// As [`Threads::work`], but the batch is no guide to how many things the next one should have.
    pub fn map<T: Sync, R: Send>(
        &self,
        things: &[T],
        work: impl Fn(usize, &T) -> R + Sync,
    ) -> Vec<R> {
        let Some(pool) = &self.pool else {
            return things.iter().map(|thing| work(0, thing)).collect();
        };
        let here = |thing| work(rayon::current_thread_index().unwrap_or(0), thing);
        pool.install(|| things.par_iter().map(here).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_in_order_on_any_number_of_threads() {
        let things: Vec<usize> = (0..10_000).collect();
        for threads in [1, 2, 5] {
            let mut crew = Threads::new(NonZeroUsize::new(threads)).unwrap();
            assert_eq!(crew.threads().get(), threads);
            let done = crew.work(&things, |thread, thing| (thread, 3 * thing));
            assert!(done.iter().all(|&(thread, _)| thread < threads));
            assert!(
                done.iter()
                    .zip(&things)
                    .all(|(done, thing)| done.1 == 3 * thing)
            );
        }
    }

    #[test]
    fn batches_grow_for_quick_work_alone() {
        let mut crew = Threads::new(NonZeroUsize::new(2)).unwrap();
        for _ in 0..20 {
            crew.work(&[0], |_, _| ());
        }
        assert_eq!(crew.batch(), MOST);
        let mut slow = Threads::new(NonZeroUsize::new(1)).unwrap();
        slow.work(&[0], |_, _| std::thread::sleep(3 * BATCH));
        assert_eq!(slow.batch(), 1);
    }
}
