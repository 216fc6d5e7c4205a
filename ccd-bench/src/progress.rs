//! Progress on the terminal, for work that takes a while.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Counts steps; shows a bar on stderr once that has taken a second, if stderr is a terminal.
#[derive(Debug)]
pub struct Progress {
    total: u64,
    done: AtomicU64,
    started: Instant,
    shown: bool,
    bar: OnceLock<ProgressBar>,
}

/// Work that is done within this shows no bar.
const PATIENCE: Duration = Duration::from_secs(1);

impl Progress {
    /// Counts to `total`, starting now.
    pub fn new(total: usize) -> Self {
        Progress {
            total: total as u64,
            done: AtomicU64::new(0),
            started: Instant::now(),
            shown: std::io::stderr().is_terminal(),
            bar: OnceLock::new(),
        }
    }

    /// Counts without showing anything.
    pub fn hidden() -> Self {
        let mut progress = Progress::new(0);
        progress.shown = false;
        progress
    }

    /// One more step is done.
    pub fn step(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        if self.shown && self.started.elapsed() > PATIENCE {
            self.bar.get_or_init(|| bar(self.total)).set_position(done);
        }
    }

    /// Says what is being done.
    pub fn say(&self, message: &str) {
        if self.shown && self.started.elapsed() > PATIENCE {
            self.bar
                .get_or_init(|| bar(self.total))
                .set_message(message.to_owned());
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = self.bar.get() {
            bar.finish_and_clear();
        }
    }
}

fn bar(total: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} {msg} (about {eta} left)")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(total).with_style(style)
}
