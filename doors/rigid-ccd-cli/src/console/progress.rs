//! Shows the progress of long work on standard error.

use crate::console::print_error;
use crate::console::printable::PrintableText;
use indicatif::{HumanCount, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt;
use std::io::{self, IsTerminal};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// Shows the progress of work that takes longer than a second: a bar on a terminal, otherwise a line every few seconds.
#[derive(Debug)]
pub struct Progress {
    bar: ProgressBar,
    steps: Arc<AtomicU64>,
    total_work: TotalWork,
    /// The number of input bytes that each step of the current batch counts for, if the total is in bytes.
    bytes_per_step: AtomicU64,
    /// The end of the current batch's rows, in bytes of the input, if the total is in bytes.
    batch_end_byte: AtomicU64,
    /// The sender whose drop tells the displaying thread that the work is done.
    done_sender: Option<Sender<()>>,
    display_thread: Option<JoinHandle<()>>,
}

/// The total amount of work, as far as it is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TotalWork {
    /// A known number of steps.
    Steps(usize),
    /// The length in bytes of an input whose rows the steps answer.
    Bytes(u64),
    /// An unknown number of steps.
    Unknown,
    /// One long step of unknown duration.
    SingleStep,
}

/// The time from the start of the work until progress is first shown.
const SHOW_DELAY: Duration = Duration::from_secs(1);

/// The time between two redraws of the bar on a terminal.
const REDRAW_INTERVAL: Duration = Duration::from_millis(120);

/// The time between two printed lines of progress, without a terminal.
const PRINT_INTERVAL: Duration = Duration::from_secs(5);

impl Progress {
    /// Starts to show progress; dropping the returned value ends the display.
    pub fn new(total: TotalWork) -> Self {
        let mut progress = Progress::new_hidden();
        progress.total_work = total;
        match total {
            TotalWork::Steps(steps) => progress.bar.set_length(steps as u64),
            TotalWork::Bytes(bytes) => progress.bar.set_length(bytes),
            TotalWork::Unknown | TotalWork::SingleStep => {}
        }
        let (bar, steps) = (progress.bar.clone(), Arc::clone(&progress.steps));
        bar.set_style(progress_style(total, Arc::clone(&steps)));
        let (done_sender, done_receiver) = mpsc::channel();
        let show = move || {
            let still_working =
                |time| done_receiver.recv_timeout(time) == Err(RecvTimeoutError::Timeout);
            if !still_working(SHOW_DELAY) {
                return;
            }
            if io::stderr().is_terminal() {
                bar.set_draw_target(ProgressDrawTarget::stderr());
                bar.enable_steady_tick(REDRAW_INTERVAL);
                return;
            }
            while still_working(PRINT_INTERVAL) {
                print_error(&line(&bar, total, &steps));
            }
        };
        // Without a thread nothing is shown, but the work is done.
        progress.display_thread = thread::Builder::new().spawn(show).ok();
        progress.done_sender = Some(done_sender);
        progress
    }

    /// Starts to show progress through an input of rows, `length` bytes long if known; shows nothing if `quiet`.
    pub fn for_rows(length: Option<u64>, quiet: bool) -> Self {
        if quiet {
            Progress::new_hidden()
        } else {
            Progress::new(length.map_or(TotalWork::Unknown, TotalWork::Bytes))
        }
    }

    /// Starts to show `message` during one long step; shows nothing if `quiet`.
    pub fn start_single_step(message: &str, quiet: bool) -> Self {
        if quiet {
            return Progress::new_hidden();
        }
        let progress = Progress::new(TotalWork::SingleStep);
        progress.set_message(message);
        progress
    }

    /// Creates a progress that shows nothing.
    pub fn new_hidden() -> Self {
        Progress {
            bar: ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden()),
            steps: Arc::default(),
            total_work: TotalWork::Unknown,
            bytes_per_step: AtomicU64::new(0),
            batch_end_byte: AtomicU64::new(0),
            done_sender: None,
            display_thread: None,
        }
    }

    /// Counts one finished step.
    pub fn step(&self) {
        self.steps.fetch_add(1, Ordering::Relaxed);
        match self.total_work {
            TotalWork::Steps(_) => self.bar.inc(1),
            TotalWork::Bytes(_) => self.bar.inc(self.bytes_per_step.load(Ordering::Relaxed)),
            TotalWork::Unknown | TotalWork::SingleStep => {}
        }
    }

    /// Begins a batch of `steps` steps, which answer the input's rows up to byte `end`; rows before the batch count as
    /// answered.
    pub fn begin_batch(&self, steps: usize, end: u64) {
        if let TotalWork::Bytes(_) = self.total_work {
            let begin = self.batch_end_byte.swap(end, Ordering::Relaxed);
            self.bar.set_position(begin);
            let bytes = end.saturating_sub(begin) / (steps as u64).max(1);
            self.bytes_per_step.store(bytes, Ordering::Relaxed);
        }
    }

    /// Replaces the message beside the bar.
    pub fn set_message(&self, message: &str) {
        self.bar.set_message(PrintableText(message).to_string());
    }

    /// Hides the bar while something else is written to standard error.
    pub fn hide_bar_during(&self, write: impl FnOnce()) {
        self.bar.suspend(write);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        drop(self.done_sender.take());
        if let Some(thread) = self.display_thread.take() {
            // The thread has no result and does not panic.
            let _ = thread.join();
        }
        self.bar.finish_and_clear();
    }
}

fn progress_style(total: TotalWork, steps: Arc<AtomicU64>) -> ProgressStyle {
    let template = match total {
        TotalWork::Steps(_) => "{bar:30} {pos}/{len} {wide_msg}",
        TotalWork::Bytes(_) => "{bar:30} {percent} % {rows}",
        TotalWork::Unknown => "{spinner} {rows}",
        TotalWork::SingleStep => "{spinner} {wide_msg} {elapsed}",
    };
    ProgressStyle::with_template(template)
        .unwrap_or_else(|_| ProgressStyle::default_bar())
        .with_key(
            "rows",
            move |state: &ProgressState, out: &mut dyn fmt::Write| {
                let _ = out.write_str(&count_and_rate_text(&steps, state.elapsed()));
            },
        )
}

/// Returns the progress as one line of text.
fn line(bar: &ProgressBar, total: TotalWork, steps: &AtomicU64) -> String {
    let percent = 100 * bar.position() / bar.length().unwrap_or(1).max(1);
    match total {
        TotalWork::Steps(steps) => format!("{} of {steps} {}", bar.position(), bar.message()),
        TotalWork::Bytes(_) => {
            format!("{}, {percent} %", count_and_rate_text(steps, bar.elapsed()))
        }
        TotalWork::Unknown => count_and_rate_text(steps, bar.elapsed()),
        TotalWork::SingleStep => format!("{}, {} s", bar.message(), bar.elapsed().as_secs()),
    }
}

/// Returns as text the number of rows answered, and the rows per second or the seconds per row.
fn count_and_rate_text(steps: &AtomicU64, elapsed: Duration) -> String {
    let steps = steps.load(Ordering::Relaxed);
    let seconds = elapsed.as_secs_f64();
    let rate = steps as f64 / seconds;
    match steps {
        0 => "0 rows answered".to_owned(),
        1 => "1 row answered".to_owned(),
        _ if rate < 1.0 => format!("{steps} rows answered, {:.0} s/row", 1.0 / rate),
        _ => format!(
            "{} rows answered, {} rows/s",
            HumanCount(steps),
            HumanCount(rate as u64)
        ),
    }
}

#[cfg(test)]
mod tests;
