//! Parallel loops over all cores, whose results do not depend on the number of threads.

use std::num::NonZero;
use std::sync::{Mutex, PoisonError};
use std::thread::{Builder, available_parallelism, scope};

/// The smallest number of list elements or subtree nodes for which a second thread is started.
pub(super) const MIN_PARALLEL_WORK: usize = 1024;

/// The number of consecutive list elements that one thread takes at a time.
const CHUNK_LENGTH: usize = 64;

/// Calls a function with every element of a list and its index, on several threads if the list is long. Each thread has
/// its own workspace.
pub(super) fn parallel_for_each<T: Send, W: Clone + Send>(
    list: &mut [T],
    workspace: &W,
    work: impl Fn(&mut W, usize, &mut T) + Sync,
) {
    let threads = if list.len() < MIN_PARALLEL_WORK {
        1
    } else {
        available_parallelism()
            .map_or(1, NonZero::get)
            .min(list.len() / MIN_PARALLEL_WORK + 1)
    };
    parallel_for_each_on(threads, list, workspace, work);
}

fn parallel_for_each_on<T: Send, W: Clone + Send>(
    threads: usize,
    list: &mut [T],
    workspace: &W,
    work: impl Fn(&mut W, usize, &mut T) + Sync,
) {
    let shares = Mutex::new(list.chunks_mut(CHUNK_LENGTH).enumerate());
    let next = || {
        let mut shares = shares.lock().unwrap_or_else(PoisonError::into_inner);
        shares.next()
    };
    let take_shares = |mut workspace: W| {
        while let Some((share, elements)) = next() {
            for (k, element) in elements.iter_mut().enumerate() {
                work(&mut workspace, share * CHUNK_LENGTH + k, element);
            }
        }
    };
    scope(|threads_of| {
        for _ in 1..threads {
            let own = workspace.clone();
            // If no thread can be started, the others take its shares.
            let thread = Builder::new().spawn_scoped(threads_of, || take_shares(own));
            if thread.is_err() {
                break;
            }
        }
        take_shares(workspace.clone());
    });
}

/// Calls two functions and returns both results; they run in parallel if `size` is large enough and a thread can be
/// started.
pub(super) fn join<A: Send, B>(
    size: usize,
    in_other_thread: impl FnOnce() -> A + Send,
    in_this_thread: impl FnOnce() -> B,
) -> (A, B) {
    if size < MIN_PARALLEL_WORK || available_parallelism().is_ok_and(|cores| cores.get() == 1) {
        return (in_other_thread(), in_this_thread());
    }
    let in_other_thread = Mutex::new(Some(in_other_thread));
    let take = || {
        let taken = in_other_thread
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .take();
        taken.map(|work| work())
    };
    scope(|threads| {
        let thread = Builder::new().spawn_scoped(threads, take);
        let in_this_thread = in_this_thread();
        let in_other_thread = match thread {
            Ok(thread) => thread
                .join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
            Err(_) => take(),
        };
        match in_other_thread {
            Some(in_other_thread) => (in_other_thread, in_this_thread),
            None => unreachable!("taken once"),
        }
    })
}

#[cfg(test)]
mod tests;
