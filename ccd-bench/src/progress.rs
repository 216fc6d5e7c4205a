//! Progress on the terminal, for work that takes a while.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::Once;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
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

    /// Lets a bar be drawn anew though no step is done.
    pub fn tick(&self) {
        self.bar.tick();
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

/// Says that work of unknown length goes on, once that has taken a second, if stderr is a terminal.
#[derive(Debug)]
pub struct Spinner {
    bar: ProgressBar,
    /// Closed when the work is done.
    working: Option<Sender<()>>,
    waiting: Option<JoinHandle<()>>,
}

/// How often a spinner turns.
const TURN: Duration = Duration::from_millis(120);

impl Spinner {
    /// Starts now, and goes on until it is dropped.
    pub fn new(what: &str) -> Self {
        let mut spinner = Spinner::hidden();
        let (working, done) = mpsc::channel();
        let bar = spinner.bar.clone();
        bar.set_message(what.to_owned());
        let show = move || {
            if done.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                // Draws nothing where stderr is no terminal.
                bar.set_draw_target(ProgressDrawTarget::stderr());
                bar.enable_steady_tick(TURN);
            }
        };
        // Without a thread there is no spinner, and the work goes on.
        spinner.waiting = thread::Builder::new().spawn(show).ok();
        spinner.working = Some(working);
        spinner
    }

    /// Never shows anything.
    pub fn hidden() -> Self {
        let style = ProgressStyle::with_template("{spinner} {wide_msg} {elapsed}")
            .unwrap_or_else(|_| ProgressStyle::default_spinner());
        let target = ProgressDrawTarget::hidden();
        Spinner {
            bar: ProgressBar::with_draw_target(None, target).with_style(style),
            working: None,
            waiting: None,
        }
    }
}

impl Drop for Spinner {
    fn drop(&mut self) {
        drop(self.working.take());
        if let Some(waiting) = self.waiting.take() {
            // It holds no result, and panics nowhere.
            let _ = waiting.join();
        }
        self.bar.finish_and_clear();
    }
}
