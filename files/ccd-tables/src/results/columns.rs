//! The columns of rows of results: of `ccd query`, of its contacts, of scenes and of Python's tables.

use super::ResultRow;
use CellGetter::{Count, Number, Text};
use serde::ser::{Serialize, SerializeTuple, Serializer};

/// A column of a table: its name in the header, and its cells.
#[derive(Clone, Copy, Debug)]
pub struct Column(pub &'static str, pub CellGetter);

/// The function that returns a column's cell for a row, with a variant for each type of cell; `None` is an empty cell.
#[derive(Clone, Copy, Debug)]
pub enum CellGetter {
    /// The cells are texts.
    Text(fn(&ResultRow) -> Option<&str>),
    /// The cells are numbers.
    Number(fn(&ResultRow) -> Option<f64>),
    /// The cells are whole numbers.
    Count(fn(&ResultRow) -> Option<u64>),
}

/// The columns of all tables of results, in order.
pub const COLUMNS: [Column; 20] = [
    Column("id", Text(|row| Some(&row.id))),
    Column("status", Text(|row| Some(row.status.name()))),
    Column("time", Number(|row| row.time)),
    Column("distance_lower", Number(|row| row.distance_lower)),
    Column("distance_upper", Number(|row| row.distance_upper)),
    Column("normal_x", Number(|row| row.normal[0])),
    Column("normal_y", Number(|row| row.normal[1])),
    Column("normal_z", Number(|row| row.normal[2])),
    Column("witness_a_x", Number(|row| row.witness_a[0])),
    Column("witness_a_y", Number(|row| row.witness_a[1])),
    Column("witness_a_z", Number(|row| row.witness_a[2])),
    Column("witness_b_x", Number(|row| row.witness_b[0])),
    Column("witness_b_y", Number(|row| row.witness_b[1])),
    Column("witness_b_z", Number(|row| row.witness_b[2])),
    Column("feature_a", Text(|row| row.feature_a.as_deref())),
    Column("feature_b", Text(|row| row.feature_b.as_deref())),
    Column("iterations", Count(|row| row.iterations)),
    Column("oracle_calls", Count(|row| row.oracle_calls)),
    Column("micros", Number(|row| row.micros)),
    Column("reason", Text(|row| row.reason.as_deref())),
];

/// The column of the time after which no contact happens, in the answers about contact intervals.
pub(super) const LAST_TIME_COLUMN: Column = Column("last_time", Number(|row| row.last_time));

/// The columns of the counters, in order; they follow all other columns.
pub const COUNTER_COLUMNS: [Column; 5] = [
    Column("advancements", Count(|row| Some(row.stats?.advancements))),
    Column(
        "oracle_steps",
        Count(|row| Some(row.stats?.oracle_effort.steps)),
    ),
    Column(
        "cycles",
        Count(|row| Some(row.stats?.oracle_effort.cycle_count)),
    ),
    Column(
        "fallbacks",
        Count(|row| Some(row.stats?.oracle_effort.fallbacks)),
    ),
    Column("front", Count(|row| Some(row.stats?.peak_front))),
];

/// The columns of the names of A and B, in the answers about cells.
pub const ITEM_COLUMNS: [Column; 2] = [
    Column("a", Text(|row| row.item_a.as_deref())),
    Column("b", Text(|row| row.item_b.as_deref())),
];

/// Returns the columns of results in another order: the columns `first`, then all others that are not `left_out`.
pub fn reordered_columns(first: &[&str], left_out: &[&str]) -> Vec<Column> {
    let column_named = |name: &&str| COLUMNS.into_iter().find(|column| column.0 == *name);
    let is_other = |Column(name, _): &Column| !first.contains(name) && !left_out.contains(name);
    let others = COLUMNS.into_iter().filter(is_other);
    first
        .iter()
        .filter_map(column_named)
        .chain(others)
        .collect()
}

/// Returns the header names of columns.
pub fn names(columns: &[Column]) -> Vec<&'static str> {
    columns.iter().map(|Column(name, _)| *name).collect()
}

/// Some columns of a row of results, serialised as one line of a table. Numbers read back to the same bits.
pub struct Line<'a>(pub &'a [Column], pub &'a ResultRow);

impl Serialize for Line<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Line(columns, row) = self;
        let mut line = serializer.serialize_tuple(columns.len())?;
        for Column(_, cells) in *columns {
            match cells {
                Text(cell_of) => line.serialize_element(&cell_of(row))?,
                Number(cell_of) => line.serialize_element(&cell_of(row))?,
                Count(cell_of) => line.serialize_element(&cell_of(row))?,
            }
        }
        line.end()
    }
}
