//! The counts of a run.

use super::checked::Made;
use super::table::FUNCTIONS;
use std::time::{Duration, Instant};

/// The number of calls of each function, and of those that succeeded.
pub(super) struct Counts {
    called: Vec<[u64; 2]>,
    times: Vec<Duration>,
    slowest: (Duration, String),
    begun: Instant,
}

impl Default for Counts {
    fn default() -> Self {
        Counts {
            called: vec![[0; 2]; FUNCTIONS.len()],
            times: vec![Duration::ZERO; FUNCTIONS.len()],
            slowest: (Duration::ZERO, String::new()),
            begun: Instant::now(),
        }
    }
}

impl Counts {
    pub(super) fn add(&mut self, index: usize, made: &Made, time: Duration, seed: u64) {
        self.called[index][0] += 1;
        self.called[index][1] += u64::from(made.has_worked);
        self.times[index] += time;
        if time > self.slowest.0 {
            let text: String = made.text.chars().take(3000).collect();
            self.slowest = (time, format!("seed {seed}, {text}"));
        }
    }

    fn total(&self) -> [u64; 2] {
        let count = |which: usize| self.called.iter().map(|own| own[which]).sum();
        [count(0), count(1)]
    }

    #[expect(clippy::print_stderr, reason = "what a run has come to")]
    pub(super) fn print(&self) {
        let [called, worked] = self.total();
        let (time, slowest) = &self.slowest;
        eprintln!(
            "{called} calls in {:.1} s, {:.1} % have worked; the slowest took {time:.1?}: {slowest}",
            self.begun.elapsed().as_secs_f64(),
            100.0 * worked as f64 / called as f64,
        );
        for ((function, [called, worked]), time) in
            FUNCTIONS.iter().zip(&self.called).zip(&self.times)
        {
            let each = 1e6 * time.as_secs_f64() / (*called).max(1) as f64;
            eprintln!(
                "{:34} {called:>8} calls, {worked:>8} have worked, {each:>7.1} µs each",
                function.name
            );
        }
    }

    /// Checks that functions succeed and fail often enough for a meaningful run.
    pub(super) fn check(&self) {
        let [called, worked] = self.total();
        assert!(
            2 * worked > called,
            "{worked} of {called} calls have worked"
        );
        assert!(
            10 * (called - worked) > called,
            "{worked} of {called} calls have worked"
        );
        for (function, &[called, worked]) in FUNCTIONS.iter().zip(&self.called) {
            assert!(
                worked * 10 > called,
                "{}: {worked} of {called}",
                function.name
            );
        }
    }
}
