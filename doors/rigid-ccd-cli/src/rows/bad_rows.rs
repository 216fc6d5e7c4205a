//! Reports rows of a table that cannot be read or answered.

use crate::console::print_error;
use crate::console::progress::Progress;
use ccd_tables::motions::RowPosition;
use std::fmt::Display;

/// A counter of rows that cannot be read or answered; it prints the first few as they occur.
pub struct BadRowCounter {
    input: String,
    count: usize,
}

/// The maximum number of bad rows that are printed one by one.
const MAX_PRINTED_ROWS: usize = 5;

impl BadRowCounter {
    /// Creates a counter for the table named `input`.
    pub fn new(input: String) -> Self {
        BadRowCounter { input, count: 0 }
    }

    /// Counts a bad row, and prints the row and its problem unless enough rows have been printed.
    pub fn report(&mut self, position: RowPosition, problem: &dyn Display, progress: &Progress) {
        self.count += 1;
        if self.count <= MAX_PRINTED_ROWS {
            let message = format!("{}, {position}: {problem}", self.input);
            progress.hide_bar_during(|| print_error(&message));
        }
    }

    /// Prints the total number of bad rows, if not all of them were printed.
    pub fn print_total(&self) {
        if self.count > MAX_PRINTED_ROWS {
            let BadRowCounter { input, count } = self;
            print_error(&format!(
                "{input}: {count} bad rows in all; see column `reason` of the results"
            ));
        }
    }

    /// Returns the number of bad rows so far, including those that were not printed.
    pub fn count(&self) -> usize {
        self.count
    }
}
