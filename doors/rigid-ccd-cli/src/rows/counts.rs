//! Counts of rows by status.

use ccd_tables::results::Status;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The number of rows of each status, in the order of [`Status::ALL`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct StatusCounts([usize; Status::ALL.len()]);

impl StatusCounts {
    /// Adds one row with the given status.
    pub(crate) fn add(&mut self, status: Status) {
        self.0[status as usize] += 1;
    }

    /// Returns the number of rows of all statuses together.
    pub(crate) fn row_count(&self) -> usize {
        self.0.iter().sum()
    }

    /// Returns the statuses with at least one row, each with its number of rows.
    pub(crate) fn nonzero_counts(&self) -> impl Iterator<Item = (Status, usize)> {
        let counts = Status::ALL.into_iter().zip(self.0);
        counts.filter(|&(_, count)| count > 0)
    }
}

/// Displays the number of rows, and how many of them have each status.
impl fmt::Display for StatusCounts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rows = self.row_count();
        let plural = if rows == 1 { "" } else { "s" };
        write!(f, "{rows} row{plural}")?;
        for (k, (status, count)) in self.nonzero_counts().enumerate() {
            let separator = if k == 0 { ": " } else { ", " };
            write!(f, "{separator}{count} {}", status.name())?;
        }
        Ok(())
    }
}
