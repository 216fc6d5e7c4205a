//! What is said of bad rows while there are more to come.

use super::complain;
use crate::command::progress::Progress;
use crate::table::motions::RowPosition;
use std::fmt::Display;

/// Tells of the first few rows at once, and counts the others.
pub struct BadRows {
    input: String,
    count: usize,
}

/// How many rows are told of.
const AT_ONCE: usize = 5;

impl BadRows {
    /// Of the rows of that table.
    pub fn new(input: String) -> Self {
        BadRows { input, count: 0 }
    }

    /// One more.
    pub fn report(&mut self, place: RowPosition, problem: &dyn Display, progress: &Progress) {
        self.count += 1;
        if self.count <= AT_ONCE {
            let (RowPosition { row, line }, input) = (place, &self.input);
            let message = format!("{input}, row {row} (line {line}): {problem}");
            progress.aside(|| complain(&message));
        }
    }

    /// Says how many there were, unless each has been told.
    pub fn close(&self) {
        if self.count > AT_ONCE {
            let BadRows { input, count } = self;
            complain(&format!(
                "{input}: {count} rows in all are like these; column `reason` of the results has every \
                 bad one's"
            ));
        }
    }

    /// How many there were.
    pub fn count(&self) -> usize {
        self.count
    }
}
