//! Converts rows of Arrow columns to the input of the library.

use super::input::{ID_COLUMN, Reader, TIME_COLUMN};
use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int64Type, UInt64Type};
use arrow_array::{Array, ArrayRef, ArrowPrimitiveType, Float64Array, Int64Array, RecordBatch};
use arrow_cast::cast;
use arrow_cast::display::{ArrayFormatter, FormatOptions};
use arrow_schema::{ArrowError, DataType, Field, Fields, Schema, SchemaRef};
use arrow_select::concat::concat_batches;
use ccd_tables::motions::{RowPosition, TableError};
use ccd_tables::records::{Record, Records};
use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A batch of consecutive rows of a table.
#[derive(Debug)]
pub(crate) struct Batch {
    /// The index of the batch's first row in the table.
    pub(crate) first: usize,
    pub(crate) row_count: usize,
    /// The column `id` with the caller's values.
    id_column: Option<ArrayRef>,
    id_reading: IdReading,
    /// All columns as numbers, with `None` for the column `id`.
    columns: Vec<Option<NumberColumn>>,
}

/// A column of numbers, converted to float64.
#[derive(Debug)]
struct NumberColumn {
    values: Float64Array,
    /// Whole numbers that float64 cannot represent exactly, by row index; `None` if there are none.
    inexact_integers: Option<HashMap<usize, String>>,
}

/// Whether the ids of rows are read as text. Results have the caller's values in either case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum IdReading {
    AsText,
    WithoutIds,
}

/// A row of a table, given by its batch and its index in the batch.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) batch: Arc<Batch>,
    /// The index of the row in its batch.
    pub(crate) row_index: usize,
}

/// Returns the names of a table's columns.
pub(crate) fn header(schema: &Schema) -> Vec<String> {
    schema
        .fields()
        .iter()
        .map(|field| field.name().clone())
        .collect()
}

/// Refuses columns that are not numbers, and column types in which different ids may have the same text.
pub(crate) fn check_column_types(schema: &Schema) -> Result<(), String> {
    let has_paths = schema.field_with_name(TIME_COLUMN).is_ok();
    for field in schema.fields() {
        let data_type = decoded_type(field.data_type());
        let (fits, needed) = if field.name() != ID_COLUMN {
            (is_numeric(data_type), "numbers")
        } else if has_paths {
            (is_id_type(data_type), "text, numbers or times")
        } else {
            (true, "")
        };
        if !fits {
            let (name, data_type) = (field.name(), field.data_type());
            return Err(format!(
                "column {name}: {needed} are needed, not {data_type}"
            ));
        }
    }
    Ok(())
}

/// Returns the field of the results' column of ids: the table's ids, or row indices if it has none.
pub(crate) fn id_field(schema: &Schema) -> Field {
    match schema.field_with_name(ID_COLUMN) {
        Ok(field) => field
            .clone()
            .with_data_type(decoded_type(field.data_type()).clone())
            .with_nullable(true),
        Err(_) => Field::new(ID_COLUMN, DataType::Int64, true),
    }
}

/// Returns the type of a column's values without dictionary or run encoding. NumPy cannot read encoded columns, and the
/// dictionaries of several batches may not fit into one.
fn decoded_type(data_type: &DataType) -> &DataType {
    match data_type {
        DataType::Dictionary(_, values) => decoded_type(values),
        DataType::RunEndEncoded(_, values) => decoded_type(values.data_type()),
        other => other,
    }
}

/// Converts a column to the type `data_type`, without dictionary or run encoding. The result may be much larger than the
/// column, because a column of nulls or runs takes a few bytes whatever its length.
fn decoded_column(column: &ArrayRef, data_type: &DataType) -> Result<ArrayRef, ArrowError> {
    if column.data_type() == data_type {
        return Ok(Arc::clone(column));
    }
    let is_short = matches!(
        column.data_type(),
        DataType::Null | DataType::RunEndEncoded(..)
    );
    // Text in run encoding may exceed this size, but not by much more than the number of rows.
    let rows = column.len();
    if is_short && Vec::<f64>::new().try_reserve_exact(rows).is_err() {
        return Err(ArrowError::MemoryError(format!(
            "{rows} rows do not fit into memory"
        )));
    }
    cast(column, data_type)
}

fn is_numeric(data_type: &DataType) -> bool {
    data_type.is_null() || data_type.is_numeric()
}

fn is_id_type(data_type: &DataType) -> bool {
    let is_bytes = data_type.is_binary() || matches!(data_type, DataType::FixedSizeBinary(_));
    let is_time = data_type.is_temporal() && !matches!(data_type, DataType::Interval(_));
    let is_simple =
        data_type.is_null() || data_type.is_numeric() || *data_type == DataType::Boolean;
    is_simple || data_type.is_string() || is_bytes || is_time
}

pub(crate) fn unreadable_error(error: ArrowError) -> TableError {
    TableError::Unreadable(error.to_string())
}

impl Batch {
    /// Creates a batch from checked columns. Columns of float64 are not copied.
    pub(crate) fn new(
        batch: &RecordBatch,
        first: usize,
        names: IdReading,
    ) -> Result<Self, TableError> {
        let schema = batch.schema();
        let (mut id, mut columns) = (None, Vec::new());
        for (field, column) in schema.fields().iter().zip(batch.columns()) {
            let column = decoded_column(column, decoded_type(field.data_type()))
                .map_err(unreadable_error)?;
            columns.push(if field.name() == ID_COLUMN {
                id = Some(column);
                None
            } else {
                Some(NumberColumn::from_column(&column)?)
            });
        }
        Ok(Batch {
            first,
            row_count: batch.num_rows(),
            id_column: id,
            id_reading: names,
            columns,
        })
    }

    /// Returns the ids of `count` rows from index `start` on. In a table without ids, they are the row indices.
    pub(crate) fn ids(&self, start: usize, count: usize) -> ArrayRef {
        match &self.id_column {
            Some(id) => id.slice(start, count),
            None => {
                let first = self.first + start;
                let numbers = (first..first + count).map(|row| row as i64);
                Arc::new(Int64Array::from_iter_values(numbers))
            }
        }
    }
}

impl NumberColumn {
    fn from_column(column: &ArrayRef) -> Result<Self, TableError> {
        let inexact_integers = match column.data_type() {
            DataType::Int64 => inexact_integers::<Int64Type>(column),
            DataType::UInt64 => inexact_integers::<UInt64Type>(column),
            _ => None,
        };
        let values = if column.data_type().is_decimal() {
            cast(
                &cast(column, &DataType::Utf8).map_err(unreadable_error)?,
                &DataType::Float64,
            )
        } else {
            decoded_column(column, &DataType::Float64)
        };
        let values = values.map_err(unreadable_error)?;
        Ok(NumberColumn {
            values: values.as_primitive::<Float64Type>().clone(),
            inexact_integers,
        })
    }
}

/// Returns the numbers of a column that float64 cannot represent exactly, by row index.
fn inexact_integers<T: ArrowPrimitiveType<Native: Into<i128>>>(
    column: &ArrayRef,
) -> Option<HashMap<usize, String>> {
    let numbers = column.as_primitive::<T>().iter().enumerate();
    let inexact: HashMap<usize, String> = numbers
        .filter_map(|(row, number)| {
            let number: i128 = number?.into();
            let text = || format!("{number}, which has more digits than a float64,");
            (number as f64 as i128 != number).then(|| (row, text()))
        })
        .collect();
    (!inexact.is_empty()).then_some(inexact)
}

impl Record for Row {
    fn text(&self, _: usize) -> Option<String> {
        let id = self.batch.id_column.as_ref()?;
        let is_null = id.is_null(self.row_index) || id.data_type().is_null();
        if self.batch.id_reading == IdReading::WithoutIds || is_null {
            return None;
        }
        let options = FormatOptions::default();
        let texts = ArrayFormatter::try_new(id.as_ref(), &options).ok()?;
        texts.value(self.row_index).try_to_string().ok()
    }

    fn has_value(&self, cell: usize) -> bool {
        matches!(self.batch.columns.get(cell), Some(Some(column)) if column.values.is_valid(self.row_index))
    }

    fn number(&self, cell: usize) -> Result<Option<f64>, String> {
        let Some(Some(column)) = self.batch.columns.get(cell) else {
            return Ok(None);
        };
        if column.values.is_null(self.row_index) {
            return Ok(None);
        }
        if let Some(inexact) = &column.inexact_integers
            && let Some(whole) = inexact.get(&self.row_index)
        {
            return Err(whole.clone());
        }
        match column.values.value(self.row_index) {
            value if value.is_finite() => Ok(Some(value)),
            value => Err(value.to_string()),
        }
    }
}

/// Reads a whole table as one batch. If the flag `stop` is set meanwhile, returns the first rows only.
pub(crate) fn read_whole_table(
    reader: Reader,
    stop: &AtomicBool,
) -> Result<RecordBatch, ArrowError> {
    let fields = reader.schema().fields().clone();
    let fields = fields.iter().map(|field| {
        let data_type = decoded_type(field.data_type()).clone();
        Arc::new(field.as_ref().clone().with_data_type(data_type))
    });
    let schema = Arc::new(Schema::new(fields.collect::<Fields>()));
    let mut batches = Vec::new();
    for batch in reader.take_while(|_| !stop.load(Ordering::Relaxed)) {
        batches.push(decoded_batch(&batch?, &schema)?);
    }
    concat_batches(&schema, &batches)
}

/// Replaces the dictionary-encoded columns of a batch by plain values. Batches with different dictionaries may need
/// more entries than one common dictionary can have.
fn decoded_batch(batch: &RecordBatch, schema: &SchemaRef) -> Result<RecordBatch, ArrowError> {
    let columns = schema.fields().iter().zip(batch.columns());
    let columns = columns.map(|(field, column)| decoded_column(column, field.data_type()));
    RecordBatch::try_new(Arc::clone(schema), columns.collect::<Result<_, _>>()?)
}

/// An iterator over the rows of a table of paths, held in one batch.
pub(crate) struct PathRowReader {
    header: Vec<String>,
    current_row: Row,
    /// The number of rows read so far.
    read_row_count: usize,
}

impl PathRowReader {
    /// Creates the iterator over all rows of a table. Ids are read as text.
    pub(crate) fn new(table: &RecordBatch) -> Result<Self, TableError> {
        let batch = Arc::new(Batch::new(table, 0, IdReading::AsText)?);
        Ok(PathRowReader {
            header: header(&table.schema()),
            current_row: Row {
                batch,
                row_index: 0,
            },
            read_row_count: 0,
        })
    }

    /// Returns the batch with all rows.
    pub(crate) fn row_batch(&self) -> Arc<Batch> {
        Arc::clone(&self.current_row.batch)
    }
}

impl Records for PathRowReader {
    type Record = Row;

    fn header(&self) -> Result<Vec<String>, TableError> {
        Ok(self.header.clone())
    }

    fn current(&self) -> &Row {
        &self.current_row
    }

    fn advance(&mut self) -> Result<Option<RowPosition>, TableError> {
        let row = self.read_row_count;
        if row == self.current_row.batch.row_count {
            return Ok(None);
        }
        self.read_row_count += 1;
        self.current_row.row_index = row;
        Ok(Some(RowPosition { row, line: None }))
    }
}
