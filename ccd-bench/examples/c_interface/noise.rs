//! Does nothing until a deadline: how late the machine is by itself.

use crate::tally::{Tally, on_threads, report};
use std::time::{Duration, Instant};

#[derive(clap::Args)]
pub(crate) struct Args {
    /// The deadline in microseconds
    #[arg(long)]
    deadline: f64,
    /// How often, of all threads together
    #[arg(long, default_value_t = 100_000)]
    count: usize,
    #[arg(long, default_value_t = 1)]
    threads: usize,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let seconds = args.deadline * 1e-6;
    let threads = args.threads.max(1);
    let count = args.count / threads;
    let wait = || {
        let mut tally = Tally::new(Some(seconds), count);
        for _ in 0..count {
            tally.ask(|| {
                let end = Instant::now() + Duration::from_secs_f64(seconds);
                while Instant::now() < end {}
            });
        }
        Ok(tally)
    };
    let tallies = on_threads(std::iter::repeat_n(wait, threads))?;
    report(&format!("waiting for {} µs", args.deadline), &tallies);
    Ok(())
}
