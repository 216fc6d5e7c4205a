//! The columns and the rows of the table of exact answers.

use super::Truth;
use serde::Serialize;

/// The columns of the table of exact answers, in order. The last one holds the reason why a row of motions cannot be
/// judged.
pub const TRUTH_COLUMNS: [&str; 5] = ["id", "status", "lo", "hi", "reason"];

/// One row of the table of exact answers, for a query that can be judged.
///
/// For a hit, `lo` and `hi` bracket the first contact. Free rows have the duration for both, rows that
/// touch at the start 0. In the other rows nothing touches before `lo`, and `hi` is the duration.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TruthRow {
    /// The name of the query in the table of motions.
    pub id: String,
    /// The kind of the exact answer, one of [`TRUTH_STATUSES`].
    pub status: &'static str,
    lo: f64,
    hi: f64,
}

/// The values of the status column, one for each kind of exact answer.
pub const TRUTH_STATUSES: [&str; 5] = ["hit", "free", "initial", "graze", "undecided"];

impl TruthRow {
    /// Returns the row for the exact answer of a query with this name and duration.
    pub fn new(id: String, duration: f64, truth: Truth) -> Self {
        let (status, lo, hi) = match truth {
            Truth::Hit { lo, hi } => ("hit", lo, hi),
            Truth::Free => ("free", duration, duration),
            Truth::ContactAtStart => ("initial", 0.0, 0.0),
            Truth::Graze { lo } => ("graze", lo, duration),
            Truth::Undecided { lo } => ("undecided", lo, duration),
        };
        TruthRow { id, status, lo, hi }
    }

    /// Returns the width of the bracket of a hit; 0 for other rows.
    pub fn bracket_width(&self) -> f64 {
        if self.status == "hit" {
            self.hi - self.lo
        } else {
            0.0
        }
    }
}
