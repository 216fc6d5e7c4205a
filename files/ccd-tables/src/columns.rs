//! The columns of tables of motions, of paths and of scenes.

use crate::error::TableError;
use crate::foreign;
use crate::remark_collector::RemarkCollector;
use rigid_ccd::Remark;
use std::ops::Range;

/// Body A or body B of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    A,
    B,
}

/// A vector or quaternion of a body, whose components are in consecutive columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
    Position,
    Orientation,
    EndPosition,
    EndOrientation,
    Velocity,
    AngularVelocity,
    Center,
}

/// The kind of a table, which decides its columns and what a row describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableKind {
    /// Each row has the motions of both bodies.
    Motions,
    /// Each row has the poses of both bodies at a time.
    Paths,
    /// Each row has a body of a scene, and its motion.
    Scene,
}

/// The columns of a body in a table of motions, without the body's prefix.
const BODY_COLUMNS: [&str; 23] = [
    "px", "py", "pz", "qw", "qx", "qy", "qz", "end_px", "end_py", "end_pz", "end_qw", "end_qx",
    "end_qy", "end_qz", "vx", "vy", "vz", "wx", "wy", "wz", "cx", "cy", "cz",
];

/// The columns of a body in a table of paths, without the body's prefix.
const PATH_BODY_COLUMNS: [&str; 13] = [
    "px", "py", "pz", "qw", "qx", "qy", "qz", "wx", "wy", "wz", "cx", "cy", "cz",
];

impl TableKind {
    /// Returns the names of all columns that a table of this kind may have, in order.
    pub(crate) fn names(self) -> Vec<String> {
        let bodies = self.prefixes().iter().flat_map(|prefix| {
            let body_columns = self.body_columns().iter();
            body_columns.map(move |name| format!("{prefix}{name}"))
        });
        let (before, after): (&[&str], &[&str]) = match self {
            TableKind::Motions => (&["id"], &["duration"]),
            TableKind::Paths => (&["id", TIME_COLUMN_NAME], &[]),
            TableKind::Scene => (&["id"], &[BODY_COLUMN_NAME]),
        };
        let owned = |names: &'static [&str]| names.iter().map(|&name| name.to_owned());
        owned(before).chain(bodies).chain(owned(after)).collect()
    }

    /// Returns the prefixes of column names, one for each body.
    fn prefixes(self) -> &'static [&'static str] {
        match self {
            TableKind::Motions | TableKind::Paths => &["a_", "b_"],
            TableKind::Scene => &[""],
        }
    }

    /// Returns the bodies that a row describes: A and B, or only A for a row of a scene.
    fn sides(self) -> impl Iterator<Item = Side> {
        [Side::A, Side::B].into_iter().take(self.prefixes().len())
    }

    /// Returns the known columns that hold a quantity's components, as indices into [`TableKind::names`]; empty if tables of
    /// this kind do not have it.
    pub(crate) fn known_column_range(self, side: Side, quantity: Quantity) -> Range<usize> {
        let range = match (self, quantity) {
            (_, Quantity::Position) => 0..3,
            (_, Quantity::Orientation) => 3..7,
            (TableKind::Paths, Quantity::AngularVelocity) => 7..10,
            (TableKind::Paths, Quantity::Center) => 10..13,
            (TableKind::Paths, _) => 0..0,
            (_, Quantity::EndPosition) => 7..10,
            (_, Quantity::EndOrientation) => 10..14,
            (_, Quantity::Velocity) => 14..17,
            (_, Quantity::AngularVelocity) => 17..20,
            (_, Quantity::Center) => 20..23,
        };
        // The columns of the bodies follow `id` and, in a table of paths, `t`.
        let before = 1 + usize::from(self == TableKind::Paths);
        let first = before + side as usize * self.body_columns().len();
        first + range.start..first + range.end
    }

    /// Returns the names of a body's columns, without its prefix.
    fn body_columns(self) -> &'static [&'static str] {
        match self {
            TableKind::Motions | TableKind::Scene => &BODY_COLUMNS,
            TableKind::Paths => &PATH_BODY_COLUMNS,
        }
    }

    /// Returns a text that lists the known columns, for messages.
    pub(crate) fn known_columns_text(self) -> &'static str {
        match self {
            TableKind::Motions => {
                "known columns are id, duration, and with the prefix a_ or b_: px py pz, qw qx qy qz, vx vy vz, \
                 wx wy wz, end_px end_py end_pz, end_qw end_qx end_qy end_qz, cx cy cz; or, for paths with \
                 several poses, id, t, px py pz, qw qx qy qz, wx wy wz, cx cy cz"
            }
            TableKind::Paths => {
                "a table with a column t holds the poses of paths: known columns are id, t, and with the prefix \
                 a_ or b_: px py pz, qw qx qy qz, wx wy wz (to the next row), cx cy cz"
            }
            TableKind::Scene => {
                "known columns of a scene are body, id, px py pz, qw qx qy qz, vx vy vz, wx wy wz, \
                 end_px end_py end_pz, end_qw end_qx end_qy end_qz, cx cy cz"
            }
        }
    }
}

/// The header of a table of motions, of paths or of a scene: which of the known columns it has, and at which index.
#[derive(Debug)]
pub struct Columns {
    table_kind: TableKind,
    names: Vec<String>,
    /// The names of the table's columns, in its order.
    header: Vec<String>,
    /// For each known column, the index of its cell in a row; `None` if the table does not have it.
    cell_indices: Vec<Option<usize>>,
    remark_collector: RemarkCollector,
}

impl Columns {
    /// Parses a header: a table with a column `t` is a table of paths.
    ///
    /// # Errors
    /// A column is unknown, appears twice or is missing, or the header is empty.
    pub fn of(header: &[String]) -> Result<Self, TableError> {
        let table_kind = if header.iter().any(|name| name == TIME_COLUMN_NAME) {
            TableKind::Paths
        } else {
            TableKind::Motions
        };
        Columns::from_header(header, table_kind)
    }

    /// Parses the header of a table of the given kind.
    ///
    /// # Errors
    /// A column is unknown, appears twice or is missing, or the header is empty.
    pub fn from_header(header: &[String], table_kind: TableKind) -> Result<Self, TableError> {
        if header.iter().all(String::is_empty) {
            return Err(TableError::Empty);
        }
        let names = table_kind.names();
        if let Some(number) = number_in_header(header, &names) {
            let known_columns = table_kind.known_columns_text();
            return Err(TableError::NoHeader {
                first_number_in_header: number,
                known_columns,
            });
        }
        let mut cell_indices = vec![None; names.len()];
        for (cell, column) in header.iter().enumerate() {
            let Some(slot) = names.iter().position(|name| name == column) else {
                return Err(unknown_column_error(header, column, table_kind));
            };
            if cell_indices[slot].replace(cell).is_some() {
                return Err(TableError::RepeatedColumn {
                    column: column.to_owned(),
                });
            }
        }
        let columns = Columns {
            table_kind,
            names,
            cell_indices,
            header: header.to_owned(),
            remark_collector: RemarkCollector::default(),
        };
        columns.check_complete_groups()?;
        Ok(columns)
    }

    /// Refuses a header with only some of the columns of an orientation or of an end position. In a table of paths,
    /// angular velocities also need the columns of an orientation.
    fn check_complete_groups(&self) -> Result<(), TableError> {
        let indivisible_quantities = [
            Quantity::Orientation,
            Quantity::EndPosition,
            Quantity::EndOrientation,
        ];
        let angular_velocity = self.is_path_table().then_some(Quantity::AngularVelocity);
        let needed_by_angular_velocity =
            angular_velocity.map(|quantity| (quantity, Quantity::Orientation));
        let needs = indivisible_quantities
            .map(|quantity| (quantity, quantity))
            .into_iter()
            .chain(needed_by_angular_velocity);
        let is_in_table = |&slot: &usize| self.cell_indices[slot].is_some();
        for side in self.table_kind.sides() {
            for (quantity, needed) in needs.clone() {
                let present = self.known_column_range(side, quantity).find(is_in_table);
                let mut needed = self.known_column_range(side, needed);
                let missing = needed.find(|slot| !is_in_table(slot));
                if let (Some(present), Some(missing)) = (present, missing) {
                    return Err(TableError::MissingColumn {
                        present_column: self.name(present).to_owned(),
                        missing_column: self.name(missing).to_owned(),
                    });
                }
            }
        }
        Ok(())
    }

    /// Returns whether the rows are the poses of paths.
    pub fn is_path_table(&self) -> bool {
        self.table_kind == TableKind::Paths
    }

    /// Returns the remarks about the rows read so far, one of each kind.
    pub fn remarks(&self) -> Vec<Remark> {
        self.remark_collector.remarks()
    }

    pub(crate) fn remark_collector(&self) -> &RemarkCollector {
        &self.remark_collector
    }

    /// Returns the known columns that hold a quantity's components, as [`TableKind::known_column_range`] does.
    pub(crate) fn known_column_range(&self, side: Side, quantity: Quantity) -> Range<usize> {
        self.table_kind.known_column_range(side, quantity)
    }

    /// Returns the names of the table's columns, in its order.
    pub(crate) fn header(&self) -> &[String] {
        &self.header
    }

    pub(crate) fn name(&self, slot: usize) -> &str {
        &self.names[slot]
    }

    /// Returns the index of a known column's cell in a row; `None` if the table does not have it.
    pub(crate) fn index(&self, slot: usize) -> Option<usize> {
        self.cell_indices[slot]
    }
}

/// Returns the first number in a header that has no known column, because such a header is probably a row; `None` for
/// any other header.
fn number_in_header(header: &[String], names: &[String]) -> Option<String> {
    if header.iter().any(|cell| names.contains(cell)) {
        return None;
    }
    // `inf` and `nan` read as numbers too, but may be meant as names.
    let is_number = |cell: &&String| {
        let digits = cell.contains(|c: char| c.is_ascii_digit());
        digits && cell.parse::<f64>().is_ok()
    };
    header.iter().find(is_number).cloned()
}

/// Returns the error of a header with an unknown column.
fn unknown_column_error(header: &[String], column: &str, table_kind: TableKind) -> TableError {
    if let ([only], Some(separator)) = (header, foreign::header_separator(column)) {
        return TableError::WrongSeparator {
            found: separator,
            header: only.clone(),
        };
    }
    if foreign::is_pandas_index(column) {
        let column = column.to_owned();
        return TableError::PandasIndex { column };
    }
    let lower = column.to_ascii_lowercase();
    if let Some(prefix) = body_prefix_of_angle_column(&lower, table_kind) {
        let column = column.to_owned();
        return TableError::AngleColumn { column, prefix };
    }
    let edit_distance = |name: &&String| strsim::damerau_levenshtein(name, &lower);
    let names = table_kind.names();
    // Names are short, so that a larger edit distance means another name.
    let nearest = (names.iter().min_by_key(edit_distance))
        .filter(|name| edit_distance(name) <= 2 && edit_distance(name) < lower.chars().count());
    // A velocity in a table of paths is not a misspelt position.
    let is_motion_column =
        table_kind == TableKind::Paths && TableKind::Motions.names().contains(&lower);
    TableError::UnknownColumn {
        column: column.to_owned(),
        known_columns: table_kind.known_columns_text(),
        most_similar_column: match lower.as_str() {
            "time" => Some(TIME_COLUMN_NAME.to_owned()),
            _ => (nearest.filter(|name| **name == lower || !is_motion_column)).cloned(),
        },
    }
}

/// Returns the body's prefix in a column name that is typical of an Euler angle or a rotation vector; `None` for other
/// names.
fn body_prefix_of_angle_column(lower: &str, table_kind: TableKind) -> Option<&'static str> {
    let (prefixes, default_prefix): (&[&str], _) = match table_kind {
        TableKind::Motions | TableKind::Paths => (&["a_end_", "b_end_", "a_", "b_"], "a_"),
        TableKind::Scene => (&["end_"], ""),
    };
    let prefix = prefixes.iter().find(|prefix| lower.starts_with(*prefix));
    let prefix = prefix.copied().unwrap_or(default_prefix);
    let name = lower.strip_prefix(prefix).unwrap_or(lower);
    ANGLE_COLUMN_NAMES.contains(&name).then_some(prefix)
}

/// Typical names of columns of angles, without the body's prefix.
const ANGLE_COLUMN_NAMES: [&str; 27] = [
    "rx", "ry", "rz", "roll", "pitch", "yaw", "heading", "rpy", "euler", "alpha", "beta", "gamma",
    "phi", "theta", "psi", "rot_x", "rot_y", "rot_z", "rotx", "roty", "rotz", "euler_x", "euler_y",
    "euler_z", "angle_x", "angle_y", "angle_z",
];

/// The index of the column `id` among the known columns.
pub(crate) const ID_COLUMN_INDEX: usize = 0;
/// The index of the column `duration` among the known columns of a table of motions.
pub(crate) const DURATION_COLUMN_INDEX: usize = 2 * BODY_COLUMNS.len() + 1;
/// The index of the column `t` among the known columns of a table of paths.
pub(crate) const TIME_COLUMN_INDEX: usize = 1;
const TIME_COLUMN_NAME: &str = "t";
/// The index of the column `body` among the known columns of a scene's table.
pub const BODY_COLUMN_INDEX: usize = BODY_COLUMNS.len() + 1;
/// The name of the column that describes a body in a scene's table.
pub const BODY_COLUMN_NAME: &str = "body";
