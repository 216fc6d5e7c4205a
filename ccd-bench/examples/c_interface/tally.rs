//! What questions under a deadline take, and whether their answers hold.

use anyhow::Result;
use ccd_core::order::{greater, lesser};
use rigid_ccd_c::RccdOutcome;
use rustix::time::{ClockId, clock_gettime};
use std::time::Instant;

/// The processor's time, in seconds, by which a deadline may be overstepped.
const OVERSTEP: f64 = 20e-6;

/// How often a question that is late is asked again. Work that takes long does so each time; an interrupt makes one of some hundred
/// questions late, hardly ever the same one each time.
const REPETITIONS: usize = 16;

/// What the questions of a thread have taken, and how they have ended.
#[derive(Default)]
pub(crate) struct Tally {
    /// Seconds of the clock, and of the processor, for each question.
    times: Vec<[f32; 2]>,
    deadline: Option<f64>,
    /// The questions whose answer was late by the processor's time.
    late: usize,
    /// The least time after the deadline of those that were asked again: the largest one of all.
    overstep: f64,
    pub(crate) allocations: u64,
    free: usize,
    contacts: usize,
    unresolved: usize,
    prefixes: usize,
    /// Prefixes that go beyond the first contact, and other wrong answers.
    wrong: usize,
}

/// An answer to a question over a duration.
#[derive(Clone, Copy)]
pub(crate) struct Answered {
    pub(crate) outcome: RccdOutcome,
    /// Nothing touches before, by the answer.
    pub(crate) free_until: f64,
    pub(crate) end: f64,
}

impl Tally {
    /// Creates a tally with place for a number of questions. The deadline is in seconds.
    pub(crate) fn new(deadline: Option<f64>, count: usize) -> Self {
        Tally {
            times: Vec::with_capacity(count),
            deadline,
            ..Tally::default()
        }
    }

    /// Asks a question and keeps the times it takes. If it is late it is asked again.
    pub(crate) fn ask<T>(&mut self, mut question: impl FnMut() -> T) -> T {
        let (answer, times) = timed(&mut question);
        self.times.push(times.map(|seconds| seconds as f32));
        if let Some(deadline) = self.deadline
            && times[1] > deadline + OVERSTEP
        {
            self.late += 1;
            let again = (0..REPETITIONS).map(|_| timed(&mut question).1[1] - deadline);
            let least = again.fold(times[1] - deadline, lesser);
            self.overstep = greater(self.overstep, least);
        }
        answer
    }

    /// Holds an answer against a time that nothing touches before, and at which something has come within the tolerance; infinite
    /// if nothing does.
    pub(crate) fn judge(&mut self, answer: Answered, touches_at: f64) {
        let right = match answer.outcome {
            RccdOutcome::Free => {
                self.free += 1;
                touches_at >= answer.end
            }
            RccdOutcome::Unresolved => {
                self.unresolved += 1;
                self.prefixes += usize::from(answer.free_until > 0.0);
                answer.free_until <= touches_at
            }
            _ => {
                self.contacts += 1;
                answer.free_until <= touches_at
            }
        };
        self.wrong += usize::from(!right);
    }
}

/// Returns the answer to a question, and the seconds of the clock and of the processor that it has taken.
fn timed<T>(question: &mut impl FnMut() -> T) -> (T, [f64; 2]) {
    let (start, worked) = (Instant::now(), processor_seconds());
    let answer = question();
    let worked = processor_seconds() - worked;
    (answer, [start.elapsed().as_secs_f64(), worked])
}

/// Returns the time that this thread has been running.
fn processor_seconds() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// Does pieces of work at once, each on a thread of its own.
pub(crate) fn on_threads<W>(work: impl IntoIterator<Item = W>) -> Result<Vec<Tally>>
where
    W: FnOnce() -> Result<Tally> + Send,
{
    let joined = std::thread::scope(|scope| {
        let threads: Vec<_> = work.into_iter().map(|work| scope.spawn(work)).collect();
        let tallies = threads.into_iter().map(|thread| thread.join());
        tallies.collect::<Result<Vec<_>, _>>()
    });
    let tallies = joined.map_err(|_| anyhow::anyhow!("a thread has panicked"))?;
    tallies.into_iter().collect()
}

/// Prints what all threads have seen.
pub(crate) fn report(name: &str, tallies: &[Tally]) {
    let sum = |count: fn(&Tally) -> usize| tallies.iter().map(count).sum::<usize>();
    println!(
        "{name}, {} threads: {} questions, {} free, {} in contact, {} unresolved ({} with a free prefix), {} wrong; {} allocations",
        tallies.len(),
        sum(|tally| tally.times.len()),
        sum(|tally| tally.free),
        sum(|tally| tally.contacts),
        sum(|tally| tally.unresolved),
        sum(|tally| tally.prefixes),
        sum(|tally| tally.wrong),
        tallies.iter().map(|tally| tally.allocations).sum::<u64>(),
    );
    if tallies.iter().any(|tally| tally.deadline.is_some()) {
        println!(
            "  later than {:.0} µs of the processor after the deadline: {}; the least of {} times of each of these: at most {:.1} µs",
            1e6 * OVERSTEP,
            sum(|tally| tally.late),
            1 + REPETITIONS,
            1e6 * tallies
                .iter()
                .map(|tally| tally.overstep)
                .fold(0.0, greater),
        );
    }
    for (which, name) in ["of the clock", "of the processor"].into_iter().enumerate() {
        let times = tallies.iter().flat_map(|tally| &tally.times);
        let mut micros: Vec<f32> = times.map(|times| 1e6 * times[which]).collect();
        micros.sort_by(f32::total_cmp);
        let Some(last) = micros.len().checked_sub(1) else {
            return;
        };
        let at = |fraction: f64| micros[(fraction * last as f64) as usize];
        println!(
            "  microseconds {name}: p50 {:.1}, p99 {:.1}, p99.9 {:.1}, p99.99 {:.1}, max {:.1}",
            at(0.5),
            at(0.99),
            at(0.999),
            at(0.9999),
            micros[last],
        );
    }
}
