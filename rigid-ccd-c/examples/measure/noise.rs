//! Does nothing until a deadline: how late the machine is by itself.

use crate::tally::{Tally, report};
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
    let wait = || {
        let mut tally = Tally::new(Some(seconds), args.count / args.threads.max(1));
        for _ in 0..args.count / args.threads.max(1) {
            tally.ask(|| {
                let end = Instant::now() + Duration::from_secs_f64(seconds);
                while Instant::now() < end {}
            });
        }
        tally
    };
    let tallies = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..args.threads.max(1))
            .map(|_| scope.spawn(wait))
            .collect();
        let tallies = threads.into_iter().map(|thread| thread.join());
        tallies.collect::<Result<Vec<_>, _>>()
    });
    let tallies = tallies.map_err(|_| anyhow::anyhow!("a thread has panicked"))?;
    report(&format!("waiting for {} µs", args.deadline), &tallies);
    Ok(())
}
