//! The goal of a query on a scene, and the time up to which a pair of bodies can contribute to it.

use std::sync::atomic::{AtomicU64, Ordering};

/// Which contacts a query on a scene asks for, with the times of the earliest events so far.
pub(super) enum Goal {
    /// The first contact of any two bodies.
    First(EarliestTime),
    /// The first contact of each body with any other one.
    FirstOfEachBody(Vec<EarliestTime>),
    /// The first contact of each pair of bodies.
    AllPairs,
}

impl Goal {
    pub(super) fn first() -> Self {
        Goal::First(EarliestTime::default())
    }

    pub(super) fn first_of_each_body(bodies: usize) -> Self {
        Goal::FirstOfEachBody((0..bodies).map(|_| EarliestTime::default()).collect())
    }

    /// Returns the time after which an event of the pair cannot change the answer.
    pub(super) fn last_useful_time(&self, [a, b]: [usize; 2]) -> f64 {
        match self {
            Goal::First(earliest) => earliest.time(),
            Goal::FirstOfEachBody(earliest) => {
                let [a, b] = [earliest[a].time(), earliest[b].time()];
                if a > b { a } else { b }
            }
            Goal::AllPairs => f64::INFINITY,
        }
    }

    pub(super) fn record(&self, [a, b]: [usize; 2], time: f64) {
        match self {
            Goal::First(earliest) => earliest.record(time),
            Goal::FirstOfEachBody(earliest) => {
                [a, b].iter().for_each(|&k| earliest[k].record(time));
            }
            Goal::AllPairs => {}
        }
    }
}

/// The earliest time that any thread has recorded; infinite before the first record.
///
/// It only saves work: what a thread does not see yet is proven further than needed.
pub(super) struct EarliestTime(AtomicU64);

impl EarliestTime {
    fn time(&self) -> f64 {
        f64::from_bits(self.0.load(Ordering::Relaxed))
    }

    /// Records a time if it is the earliest; bits of floats that are not negative sort as the floats do.
    fn record(&self, time: f64) {
        self.0.fetch_min(time.to_bits(), Ordering::Relaxed);
    }
}

impl Default for EarliestTime {
    fn default() -> Self {
        EarliestTime(AtomicU64::new(f64::INFINITY.to_bits()))
    }
}
