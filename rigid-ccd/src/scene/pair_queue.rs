//! A queue of a scene's pairs of bodies: the pair with the earliest proven time is advanced first.

use super::event::Event;
use super::goal::Goal;
use super::queue_entry::QueueEntry;
use ccd_core::order::{greater, lesser};
use ccd_core::schedule::{BestFirst, FirstContactSearch, Progress};
use ccd_core::{InputError, Query};
use ccd_distance_gjk::Direct;
use std::collections::BinaryHeap;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The share of the duration by which a pair is advanced before another pair takes its turn. It is so large that pairs
/// are seldom put back, and so small that little is proven beyond the answer.
const TURN_DURATION_SHARE: f64 = 1.0 / 16.0;

/// The maximum number of finished searches whose memory a worker keeps for reuse.
const MAX_SPARE_SEARCHES: usize = 1024;

/// The queue of pairs of bodies that threads advance together.
pub(super) struct PairQueue<'r, 'a> {
    query: &'r (dyn Fn([usize; 2]) -> Result<Query<'a>, InputError> + Sync),
    duration: f64,
    goal: &'r Goal,
    waiting_pairs: Mutex<BinaryHeap<QueuedPair<'a>>>,
}

/// A queued pair that is proven apart until a time; its search is `None` until it has begun.
type QueuedPair<'a> = QueueEntry<Option<Search<'a>>>;

type Search<'a> = Box<FirstContactSearch<'a, Direct>>;

impl<'r, 'a> PairQueue<'r, 'a> {
    pub(super) fn new(
        pairs: &[[usize; 2]],
        query: &'r (dyn Fn([usize; 2]) -> Result<Query<'a>, InputError> + Sync),
        duration: f64,
        goal: &'r Goal,
    ) -> Self {
        let entry = |&pair| QueueEntry {
            time: 0.0,
            pair,
            item: None,
        };
        PairQueue {
            query,
            duration,
            goal,
            waiting_pairs: Mutex::new(pairs.iter().map(entry).collect()),
        }
    }

    /// Removes the pair with the earliest proven time from the queue, and returns it with the next pair's proven time.
    fn next(&self) -> Option<(QueuedPair<'a>, f64)> {
        let mut waiting = self.waiting_pairs();
        let entry = waiting.pop()?;
        let others = waiting.peek().map_or(f64::INFINITY, |other| other.time);
        Some((entry, others))
    }

    fn waiting_pairs(&self) -> MutexGuard<'_, BinaryHeap<QueuedPair<'a>>> {
        let waiting = self.waiting_pairs.lock();
        waiting.unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns the time up to which a pair at `time` is advanced next; infinite for [`Goal::AllPairs`], which needs the
    /// pair's whole answer.
    fn next_target_time(&self, time: f64, others: f64, limit: f64) -> f64 {
        let slice = greater(others, time + TURN_DURATION_SHARE * self.duration);
        let until = match self.goal {
            Goal::AllPairs => f64::INFINITY,
            Goal::First(_) | Goal::FirstOfEachBody(_) => lesser(slice, limit.next_up()),
        };
        // Durations may be too short for slices.
        if until > time { until } else { f64::INFINITY }
    }
}

/// The memory that a thread reuses from pair to pair.
#[derive(Default)]
pub(super) struct WorkerMemory {
    oracle: Direct,
    spare_searches: Vec<BestFirst<Direct>>,
}

impl WorkerMemory {
    /// Advances one pair after another until the queue is empty, and returns their contacts and errors.
    pub(super) fn run(&mut self, pair_queue: &PairQueue<'_, '_>) -> Vec<Event> {
        let mut events = Vec::new();
        while let Some((entry, others)) = pair_queue.next() {
            let QueueEntry {
                time,
                pair,
                item: search,
            } = entry;
            let limit = pair_queue.goal.last_useful_time(pair);
            // A later event does not matter to the goal.
            if time > limit {
                self.keep_search_for_reuse(search);
                continue;
            }
            let search = search.map_or_else(|| self.begin_search(pair_queue, pair), Ok);
            let advanced = search.and_then(|mut search| {
                let until = pair_queue.next_target_time(time, others, limit);
                Ok((search.advance(&mut self.oracle, until)?, search))
            });
            let event = match advanced {
                Err(error) => Some(Event::from_error(pair, error)),
                Ok((Progress::ApartUntil(time), search)) => {
                    pair_queue.waiting_pairs().push(QueueEntry {
                        time,
                        pair,
                        item: Some(search),
                    });
                    continue;
                }
                Ok((Progress::Answered(answer), search)) => {
                    self.keep_search_for_reuse(Some(search));
                    Event::from_answer(pair, &answer)
                }
            };
            if let Some(event) = event {
                pair_queue.goal.record(pair, event.time);
                events.push(event);
            }
        }
        events
    }

    fn begin_search<'a>(
        &mut self,
        pair_queue: &PairQueue<'_, 'a>,
        pair: [usize; 2],
    ) -> Result<Search<'a>, InputError> {
        let query = (pair_queue.query)(pair)?;
        let memory = self.spare_searches.pop().unwrap_or_default();
        Ok(Box::new(FirstContactSearch::new(query, memory)))
    }

    fn keep_search_for_reuse(&mut self, search: Option<Search<'_>>) {
        if let Some(search) = search
            && self.spare_searches.len() < MAX_SPARE_SEARCHES
        {
            self.spare_searches.push(search.into_schedule());
        }
    }
}
