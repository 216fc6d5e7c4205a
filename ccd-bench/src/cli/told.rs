//! What is said of bad rows while there are more to come.

use super::complain;
use crate::motions::Place;
use crate::progress::Progress;
use std::fmt::Display;

/// Tells of the first few rows at once, and counts the others.
pub(super) struct Told {
    input: String,
    count: usize,
}

/// How many rows are told of.
const AT_ONCE: usize = 5;

impl Told {
    /// Of the rows of that table.
    pub(super) fn new(input: String) -> Self {
        Told { input, count: 0 }
    }

    /// One more.
    pub(super) fn tell(&mut self, place: Place, problem: &dyn Display, progress: &Progress) {
        self.count += 1;
        if self.count <= AT_ONCE {
            let (Place { row, line }, input) = (place, &self.input);
            let message = format!("{input}, row {row} (line {line}): {problem}");
            progress.aside(|| complain(&message));
        }
    }

    /// Says how many there were, unless each has been told.
    pub(super) fn close(&self) {
        if self.count > AT_ONCE {
            let Told { input, count } = self;
            complain(&format!(
                "{input}: {count} rows in all are like these; column `reason` of the results has every \
                 bad one's"
            ));
        }
    }

    /// How many there were.
    pub(super) fn count(&self) -> usize {
        self.count
    }
}
