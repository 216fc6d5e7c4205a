//! Rows of Arrow columns, as the library reads them.

use super::input::Reader;
use arrow_array::cast::AsArray;
use arrow_array::types::Float64Type;
use arrow_array::{Array, ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow_cast::cast;
use arrow_schema::{ArrowError, DataType, Schema};
use arrow_select::concat::concat_batches;
use rigid_ccd::table::motions::{Columns, RowPosition, RowProblem, TableError};
use rigid_ccd::table::records::{Cells, Record, Records};
use std::sync::Arc;

/// Consecutive rows of a table.
#[derive(Debug)]
pub(crate) struct Batch {
    /// The number of the first row.
    pub(crate) first: usize,
    pub(crate) rows: usize,
    /// The column `id` as it came.
    pub(crate) id: Option<ArrayRef>,
    /// The column `id` as text, if it is read.
    names: Option<StringArray>,
    /// The other columns, none in the place of `id`.
    numbers: Vec<Option<Float64Array>>,
}

/// A row of a batch.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) batch: Arc<Batch>,
    /// The number of the row in the batch.
    pub(crate) at: usize,
}

/// The names of a table's columns.
pub(crate) fn header(schema: &Schema) -> Vec<String> {
    schema
        .fields()
        .iter()
        .map(|field| field.name().clone())
        .collect()
}

/// Refuses columns that have no numbers.
pub(crate) fn check_types(schema: &Schema) -> Result<(), String> {
    for field in schema.fields().iter().filter(|field| field.name() != ID) {
        if !is_numeric(field.data_type()) {
            return Err(format!(
                "column {}: numbers are needed, not {}",
                field.name(),
                field.data_type()
            ));
        }
    }
    Ok(())
}

const ID: &str = "id";

fn unreadable(error: ArrowError) -> TableError {
    TableError::Unreadable(error.to_string())
}

fn is_numeric(kind: &DataType) -> bool {
    match kind {
        DataType::Null => true,
        DataType::Dictionary(_, values) => is_numeric(values),
        other => other.is_numeric(),
    }
}

impl Batch {
    /// Takes a batch whose columns have been checked. Columns of float64 are not copied.
    fn new(batch: &RecordBatch, first: usize) -> Result<Self, TableError> {
        let schema = batch.schema();
        let (mut id, mut numbers) = (None, Vec::new());
        for (field, column) in schema.fields().iter().zip(batch.columns()) {
            numbers.push(match (field.name().as_str(), column.data_type()) {
                (ID, _) => {
                    id = Some(Arc::clone(column));
                    None
                }
                (_, DataType::Float64) => Some(column.as_primitive::<Float64Type>().clone()),
                _ => {
                    let column = cast(column, &DataType::Float64).map_err(unreadable)?;
                    Some(column.as_primitive::<Float64Type>().clone())
                }
            });
        }
        Ok(Batch {
            first,
            rows: batch.num_rows(),
            id,
            names: None,
            numbers,
        })
    }

    /// Reads the column `id` as text.
    fn with_names(self) -> Result<Self, TableError> {
        let names = self
            .id
            .as_ref()
            .map(|id| cast(id, &DataType::Utf8))
            .transpose();
        let names = names.map_err(|error| TableError::Unreadable(format!("column id: {error}")))?;
        Ok(Batch {
            names: names.map(|names| names.as_string().clone()),
            ..self
        })
    }

    /// Returns the ids of rows; their numbers where there is no column.
    pub(crate) fn ids(&self, at: usize, rows: usize) -> ArrayRef {
        match &self.id {
            Some(id) => id.slice(at, rows),
            None => {
                let first = self.first + at;
                Arc::new(arrow_array::Int64Array::from_iter_values(
                    (first..first + rows).map(|row| row as i64),
                ))
            }
        }
    }
}

impl Record for Row {
    type Cells<'r> = &'r Row;

    fn cells(&self, _: &Columns) -> Result<&Row, RowProblem> {
        Ok(self)
    }

    fn text(&self, _: usize) -> Option<String> {
        let names = self.batch.names.as_ref()?;
        names
            .is_valid(self.at)
            .then(|| names.value(self.at).to_owned())
    }
}

impl Cells for &Row {
    fn is_given(&self, cell: usize) -> bool {
        matches!(self.batch.numbers.get(cell), Some(Some(column)) if column.is_valid(self.at))
    }

    fn number(&self, cell: usize) -> Result<Option<f64>, String> {
        match self.batch.numbers.get(cell) {
            Some(Some(column)) if column.is_valid(self.at) => match column.value(self.at) {
                value if value.is_finite() => Ok(Some(value)),
                value => Err(value.to_string()),
            },
            _ => Ok(None),
        }
    }
}

/// The batches of a table.
pub(crate) struct Batches {
    reader: Reader,
    rows: usize,
    names: Names,
}

/// Whether ids are read as text: results have them as they came.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Names {
    Read,
    LeftOut,
}

impl Batches {
    pub(crate) fn new(reader: Reader, names: Names) -> Self {
        Batches {
            reader,
            rows: 0,
            names,
        }
    }

    pub(crate) fn next(&mut self) -> Result<Option<Batch>, TableError> {
        let Some(batch) = self.reader.next() else {
            return Ok(None);
        };
        let batch = Batch::new(&batch.map_err(unreadable)?, self.rows)?;
        self.rows += batch.rows;
        Ok(Some(match self.names {
            Names::Read => batch.with_names()?,
            Names::LeftOut => batch,
        }))
    }
}

/// The rows of a batch one by one, as paths are read.
pub(crate) struct Rows {
    header: Vec<String>,
    current: Row,
    /// The number of rows read.
    read: usize,
}

impl Rows {
    /// Reads a whole table, as one batch.
    pub(crate) fn of(reader: Reader) -> Result<Self, TableError> {
        let schema = reader.schema();
        let whole = reader
            .collect::<Result<Vec<_>, _>>()
            .and_then(|batches| concat_batches(&schema, &batches))
            .map_err(unreadable)?;
        Ok(Rows {
            header: header(&schema),
            current: Row {
                batch: Arc::new(Batch::new(&whole, 0)?.with_names()?),
                at: 0,
            },
            read: 0,
        })
    }

    /// All of the rows.
    pub(crate) fn batch(&self) -> Arc<Batch> {
        Arc::clone(&self.current.batch)
    }
}

impl Records for Rows {
    type Record = Row;

    fn header(&self) -> Result<Vec<String>, TableError> {
        Ok(self.header.clone())
    }

    fn current(&self) -> &Row {
        &self.current
    }

    fn advance(&mut self) -> Result<Option<RowPosition>, TableError> {
        let row = self.read;
        if row == self.current.batch.rows {
            return Ok(None);
        }
        self.read += 1;
        self.current.at = row;
        let line = row as u64;
        Ok(Some(RowPosition { row, line }))
    }
}
