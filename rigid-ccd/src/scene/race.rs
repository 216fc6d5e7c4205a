//! A queue of a scene's pairs of bodies: the pair with the earliest proven time is advanced first.

use super::due::Due;
use super::event::Event;
use super::goal::Goal;
use ccd_core::order::{greater, lesser};
use ccd_core::schedule::{BestFirst, FirstContact, Progress};
use ccd_core::{InputError, Query};
use ccd_distance_gjk::Direct;
use std::collections::BinaryHeap;
use std::sync::{Mutex, PoisonError};

/// The part of the duration by which a pair is advanced before another pair takes its turn. Shares so large that pairs
/// are seldom put aside, and so small that little is proven beyond the answer.
const SLICE: f64 = 1.0 / 16.0;

/// The maximum number of finished searches whose memory a worker keeps for reuse.
const MOST_SPARE: usize = 1024;

/// The queue of pairs of bodies that threads advance together.
pub(super) struct Race<'r, 'a> {
    query: &'r (dyn Fn([usize; 2]) -> Result<Query<'a>, InputError> + Sync),
    duration: f64,
    goal: &'r Goal,
    waiting: Mutex<BinaryHeap<Runner<'a>>>,
}

/// A queued pair that is proven apart until a time; its search is `None` until it has begun.
type Runner<'a> = Due<Option<Search<'a>>>;

type Search<'a> = Box<FirstContact<'a, Direct>>;

impl<'r, 'a> Race<'r, 'a> {
    pub(super) fn new(
        pairs: &[[usize; 2]],
        query: &'r (dyn Fn([usize; 2]) -> Result<Query<'a>, InputError> + Sync),
        duration: f64,
        goal: &'r Goal,
    ) -> Self {
        let runner = |&pair| Due {
            time: 0.0,
            pair,
            what: None,
        };
        Race {
            query,
            duration,
            goal,
            waiting: Mutex::new(pairs.iter().map(runner).collect()),
        }
    }

    /// Removes the pair with the earliest proven time from the queue, and returns it with the next pair's proven time.
    fn next(&self) -> Option<(Runner<'a>, f64)> {
        let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        let runner = waiting.pop()?;
        let others = waiting.peek().map_or(f64::INFINITY, |other| other.time);
        Some((runner, others))
    }

    fn put_back(&self, runner: Runner<'a>) {
        let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        waiting.push(runner);
    }

    /// Returns the time to which a pair at `time` is advanced next, which is at most `limit`.
    fn until(&self, time: f64, others: f64, limit: f64) -> f64 {
        let slice = greater(others, time + SLICE * self.duration);
        let until = match self.goal {
            Goal::All => f64::INFINITY,
            Goal::First(_) | Goal::OfEach(_) => lesser(slice, limit.next_up()),
        };
        // Durations may be too short for slices.
        if until > time { until } else { f64::INFINITY }
    }
}

/// The memory that a thread reuses from pair to pair.
#[derive(Default)]
pub(super) struct Worker {
    oracle: Direct,
    spare: Vec<BestFirst<Direct>>,
}

impl Worker {
    /// Advances one pair after another until the queue is empty, and returns their contacts and errors.
    pub(super) fn run(&mut self, race: &Race<'_, '_>) -> Vec<Event> {
        let mut events = Vec::new();
        while let Some((runner, others)) = race.next() {
            let Due {
                time,
                pair,
                what: search,
            } = runner;
            let limit = race.goal.limit(pair);
            // A later event does not matter to the goal.
            if time > limit {
                self.keep(search);
                continue;
            }
            let mut search = match search {
                Some(search) => search,
                None => match (race.query)(pair) {
                    Ok(query) => Box::new(FirstContact::new(
                        query,
                        self.spare.pop().unwrap_or_default(),
                    )),
                    Err(error) => {
                        race.goal.record(pair, 0.0);
                        events.push(Event::refused(pair, error));
                        continue;
                    }
                },
            };
            match search.advance(&mut self.oracle, race.until(time, others, limit)) {
                Err(error) => {
                    self.keep(Some(search));
                    race.goal.record(pair, 0.0);
                    events.push(Event::refused(pair, error));
                }
                Ok(Progress::ApartUntil(time)) => race.put_back(Due {
                    time,
                    pair,
                    what: Some(search),
                }),
                Ok(Progress::Answered(answer)) => {
                    self.keep(Some(search));
                    if let Some(event) = Event::answered(pair, &answer) {
                        race.goal.record(pair, event.time);
                        events.push(event);
                    }
                }
            }
        }
        events
    }

    fn keep(&mut self, search: Option<Search<'_>>) {
        if let Some(search) = search
            && self.spare.len() < MOST_SPARE
        {
            self.spare.push(search.into_memory());
        }
    }
}
