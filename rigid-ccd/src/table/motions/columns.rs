//! The columns of the table of motions.

use super::error::TableError;
use super::foreign;
use std::ops::Range;

/// One of the two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    A,
    B,
}

/// A quantity of a body, held by consecutive columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    Position,
    Orientation,
    EndPosition,
    EndOrientation,
    Velocity,
    Spin,
    Centre,
}

/// The columns of a body, without its prefix.
const OF_BODY: [&str; 23] = [
    "px", "py", "pz", "qw", "qx", "qy", "qz", "end_px", "end_py", "end_pz", "end_qw", "end_qx",
    "end_qy", "end_qz", "vx", "vy", "vz", "wx", "wy", "wz", "cx", "cy", "cz",
];

/// Returns all columns in order: the id, A's, B's, the duration.
pub(super) fn known() -> Vec<String> {
    let of = |letter| OF_BODY.iter().map(move |name| format!("{letter}_{name}"));
    std::iter::once("id".to_owned())
        .chain(of('a'))
        .chain(of('b'))
        .chain(std::iter::once("duration".to_owned()))
        .collect()
}

/// The columns of a table.
#[derive(Debug)]
pub(super) struct Columns {
    names: Vec<String>,
    /// The cell of each known column.
    cells: Vec<Option<usize>>,
    len: usize,
}

impl Columns {
    pub(super) fn from_header(header: &csv::ByteRecord) -> Result<Self, TableError> {
        if let Some(format) = foreign::format(header) {
            return Err(TableError::NotCsv { format });
        }
        if foreign::is_lfs_pointer(header) {
            return Err(TableError::LfsPointer);
        }
        let Ok(header) = csv::StringRecord::from_byte_record(header.clone()) else {
            return Err(TableError::NotText);
        };
        let header: Vec<&str> = header.iter().map(str::trim).collect();
        if header.iter().all(|column| column.is_empty()) {
            return Err(TableError::Empty);
        }
        let names = known();
        if let Some(number) = number_without_names(&header, &names) {
            return Err(TableError::NoHeader { number });
        }
        let mut cells = vec![None; names.len()];
        for (cell, &column) in header.iter().enumerate() {
            let Some(slot) = names.iter().position(|name| name == column) else {
                return Err(unknown(&header, column, &names));
            };
            if cells[slot].replace(cell).is_some() {
                return Err(TableError::RepeatedColumn {
                    column: column.to_owned(),
                });
            }
        }
        Ok(Columns {
            names,
            cells,
            len: header.len(),
        })
    }

    /// Returns the number of columns of the table.
    pub(super) fn len(&self) -> usize {
        self.len
    }

    pub(super) fn name(&self, slot: usize) -> &str {
        &self.names[slot]
    }

    /// Returns the index of the cell of a column.
    pub(super) fn index(&self, slot: usize) -> Option<usize> {
        self.cells[slot]
    }

    /// Returns the name of the column of a cell.
    pub(super) fn name_at(&self, index: usize) -> &str {
        let slot = self.cells.iter().position(|&cell| cell == Some(index));
        slot.map_or("", |slot| self.name(slot))
    }

    /// Returns the cell of a column; none where it is empty or missing.
    pub(super) fn cell<'r>(&self, row: &[&'r str], slot: usize) -> Option<&'r str> {
        let cell = row.get(self.cells[slot]?).copied();
        cell.filter(|cell| !cell.is_empty())
    }
}

/// Returns a number in a header without any known column: such a line is a row of numbers.
fn number_without_names(header: &[&str], names: &[String]) -> Option<String> {
    if header
        .iter()
        .any(|cell| names.iter().any(|name| name == cell))
    {
        return None;
    }
    // `inf` and `nan` read as numbers too, but may be meant as names.
    let is_number = |cell: &&&str| {
        let digits = cell.contains(|c: char| c.is_ascii_digit());
        digits && cell.parse::<f64>().is_ok()
    };
    header.iter().find(is_number).map(|&cell| cell.to_owned())
}

/// Returns the error of a header with an unknown column.
fn unknown(header: &[&str], column: &str, names: &[String]) -> TableError {
    if let ([only], Some(separator)) = (header, foreign::separator(column)) {
        return TableError::Separator {
            found: separator,
            header: (*only).to_owned(),
        };
    }
    let lower = column.to_ascii_lowercase();
    let edit_distance = |name: &&String| strsim::damerau_levenshtein(name, &lower);
    let nearest = names.iter().min_by_key(edit_distance);
    TableError::UnknownColumn {
        column: column.to_owned(),
        // Names are short: a larger distance means another name.
        nearest: nearest
            .filter(|name| edit_distance(name) <= 2 && edit_distance(name) < lower.chars().count())
            .cloned(),
    }
}

/// The slot of the id.
pub(super) const ID: usize = 0;
/// The slot of the duration.
pub(super) const DURATION: usize = 2 * OF_BODY.len() + 1;

/// The slots of a quantity.
pub(super) fn slots(side: Side, quantity: Quantity) -> Range<usize> {
    let within = match quantity {
        Quantity::Position => 0..3,
        Quantity::Orientation => 3..7,
        Quantity::EndPosition => 7..10,
        Quantity::EndOrientation => 10..14,
        Quantity::Velocity => 14..17,
        Quantity::Spin => 17..20,
        Quantity::Centre => 20..23,
    };
    let first = match side {
        Side::A => 1,
        Side::B => 1 + OF_BODY.len(),
    };
    first + within.start..first + within.end
}
