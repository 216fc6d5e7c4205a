//! The table of truths.

use super::Truth;
use serde::{Deserialize, Serialize};
use std::io;

/// The columns, in order; the last one has what is wrong with a row of motions that cannot be judged.
pub const TRUTH_COLUMNS: [&str; 5] = ["id", "status", "lo", "hi", "reason"];

/// One row of the table, without a reason.
///
/// Of a hit, `lo` and `hi` bracket the first contact. Free rows have the duration for both, rows that
/// touch at the start 0; of others nothing touches before `lo`, and `hi` is the duration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TruthRow {
    /// What the query is called.
    pub id: String,
    status: Status,
    lo: f64,
    hi: f64,
}

/// A [`Truth`] by its name alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Status {
    Hit,
    Free,
    Initial,
    Graze,
    Undecided,
}

impl TruthRow {
    /// What is true of a query of that name and duration.
    pub fn new(id: String, duration: f64, truth: Truth) -> Self {
        let (status, lo, hi) = match truth {
            Truth::Hit { lo, hi } => (Status::Hit, lo, hi),
            Truth::Free => (Status::Free, duration, duration),
            Truth::Start => (Status::Initial, 0.0, 0.0),
            Truth::Graze { lo } => (Status::Graze, lo, duration),
            Truth::Undecided { lo } => (Status::Undecided, lo, duration),
        };
        TruthRow { id, status, lo, hi }
    }

    /// What it says.
    pub fn truth(&self) -> Truth {
        let (lo, hi) = (self.lo, self.hi);
        match self.status {
            Status::Hit => Truth::Hit { lo, hi },
            Status::Free => Truth::Free,
            Status::Initial => Truth::Start,
            Status::Graze => Truth::Graze { lo },
            Status::Undecided => Truth::Undecided { lo },
        }
    }
}

/// Writes a table of truths; numbers read back to the same bits.
///
/// # Errors
/// When `output` cannot be written to.
pub fn write_truths(
    output: impl io::Write,
    rows: impl IntoIterator<Item = TruthRow>,
) -> Result<(), csv::Error> {
    let mut writer = csv::WriterBuilder::new()
        .has_headers(false)
        .from_writer(output);
    writer.write_record(&TRUTH_COLUMNS[..4])?;
    for row in rows {
        writer.serialize(row)?;
    }
    writer.flush()?;
    Ok(())
}

/// Reads a table of truths.
///
/// # Errors
/// When `input` cannot be read, or a row is none of such a table.
pub fn read_truths(input: impl io::Read) -> Result<Vec<TruthRow>, csv::Error> {
    csv::Reader::from_reader(input).deserialize().collect()
}
