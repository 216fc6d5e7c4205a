//! The goal of a query on a scene, and the time up to which a pair of bodies can contribute to it.

use ccd_core::order::greater;
use std::sync::atomic::{AtomicU64, Ordering};

/// Which contacts a query on a scene asks for, with the times of the earliest events so far.
pub(super) enum Goal {
    /// The first contact of any two bodies.
    First(SharedEarliestTime),
    /// The first contact of each body with any other one.
    FirstOfEachBody(Vec<SharedEarliestTime>),
    /// The first contact of each pair of bodies.
    AllPairs,
}

impl Goal {
    pub(super) fn first() -> Self {
        Goal::First(SharedEarliestTime::default())
    }

    pub(super) fn first_of_each_body(bodies: usize) -> Self {
        Goal::FirstOfEachBody((0..bodies).map(|_| SharedEarliestTime::default()).collect())
    }

    /// Returns the time after which an event of the pair cannot change the answer.
    pub(super) fn last_useful_time(&self, pair: [usize; 2]) -> f64 {
        let times = self.earliest_times(pair).map(SharedEarliestTime::time);
        times.reduce(greater).unwrap_or(f64::INFINITY)
    }

    pub(super) fn record(&self, pair: [usize; 2], time: f64) {
        self.earliest_times(pair)
            .for_each(|earliest| earliest.record(time));
    }

    /// Returns the times that an event of the pair may change.
    fn earliest_times(&self, [a, b]: [usize; 2]) -> impl Iterator<Item = &SharedEarliestTime> {
        let times = match self {
            Goal::First(earliest) => [Some(earliest), None],
            Goal::FirstOfEachBody(earliest) => [a, b].map(|k| Some(&earliest[k])),
            Goal::AllPairs => [None, None],
        };
        times.into_iter().flatten()
    }
}

/// The earliest time that any thread has recorded; infinite before the first record.
///
/// It only saves work: what a thread does not see yet is proven further than needed.
pub(super) struct SharedEarliestTime(AtomicU64);

impl SharedEarliestTime {
    fn time(&self) -> f64 {
        f64::from_bits(self.0.load(Ordering::Relaxed))
    }

    /// Records a time if it is the earliest; bits of floats that are not negative sort as the floats do.
    fn record(&self, time: f64) {
        self.0.fetch_min(time.to_bits(), Ordering::Relaxed);
    }
}

impl Default for SharedEarliestTime {
    fn default() -> Self {
        SharedEarliestTime(AtomicU64::new(f64::INFINITY.to_bits()))
    }
}
