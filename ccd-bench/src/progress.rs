//! Progress on the terminal, for work that takes a while.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::Once;
use std::time::Duration;

/// Counts steps; shows a bar on stderr once that has taken a second, if stderr is a terminal.
#[derive(Debug)]
pub struct Progress {
    bar: ProgressBar,
    /// Done when the bar is shown, or when it never shall be.
    decided: Once,
}

/// Work that is done within this shows no bar.
const PATIENCE: Duration = Duration::from_secs(1);

impl Progress {
    /// Counts to `total`, starting now.
    pub fn new(total: usize) -> Self {
        let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {wide_msg}")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        let hidden = ProgressDrawTarget::hidden();
        Progress {
            bar: ProgressBar::with_draw_target(Some(total as u64), hidden).with_style(style),
            decided: Once::new(),
        }
    }

    /// Counts without ever showing anything.
    pub fn hidden() -> Self {
        let progress = Progress::new(0);
        progress.decided.call_once(|| ());
        progress
    }

    /// One more step is done.
    pub fn step(&self) {
        if !self.decided.is_completed() && self.bar.elapsed() > PATIENCE {
            // Draws nothing where stderr is no terminal.
            self.decided
                .call_once(|| self.bar.set_draw_target(ProgressDrawTarget::stderr()));
        }
        self.bar.inc(1);
    }

    /// Says what is being done.
    pub fn say(&self, message: &str) {
        self.bar.set_message(message.to_owned());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
