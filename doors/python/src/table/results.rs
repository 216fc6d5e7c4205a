//! Converts rows of results to Arrow columns.

use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray, new_empty_array};
use arrow_buffer::NullBuffer;
use arrow_cast::cast;
use arrow_schema::{ArrowError, DataType, Field, Schema};
use arrow_select::concat::concat_batches;
use ccd_tables::path_rows;
use ccd_tables::results::{self, CellGetter, Column, ResultRow};
use rigid_ccd::Question;
use std::sync::Arc;

/// Returns the columns of the results of a question, as in the command, for a given column of ids.
pub(crate) fn schema(question: Question, id: Field) -> Result<Schema, ArrowError> {
    let batch = batch(question, new_empty_array(id.data_type()), &[])?;
    let mut fields = batch.schema().fields().to_vec();
    fields[0] = Arc::new(id);
    Ok(Schema::new(fields))
}

/// Concatenates batches of results into one batch of the given schema. If the ids together are too long for a column of
/// their type, casts them to the type for long columns.
pub(crate) fn concatenate(
    schema: &Arc<Schema>,
    batches: &[RecordBatch],
) -> Result<RecordBatch, ArrowError> {
    let concatenate = concat_batches(schema, batches);
    let long = match schema.field(0).data_type() {
        DataType::Utf8 => DataType::LargeUtf8,
        DataType::Binary => DataType::LargeBinary,
        _ => return concatenate,
    };
    concatenate.or_else(|_| {
        let mut fields = schema.fields().to_vec();
        fields[0] = Arc::new(schema.field(0).clone().with_data_type(long.clone()));
        let schema = Arc::new(Schema::new(fields));
        let with_long = |batch: &RecordBatch| {
            let mut columns = batch.columns().to_vec();
            columns[0] = cast(&columns[0], &long)?;
            RecordBatch::try_new(Arc::clone(&schema), columns)
        };
        let batches: Vec<RecordBatch> = batches.iter().map(with_long).collect::<Result<_, _>>()?;
        concat_batches(&schema, &batches)
    })
}

/// Converts rows of results to a batch of columns.
pub(crate) fn batch(
    question: Question,
    ids: ArrayRef,
    rows: &[ResultRow],
) -> Result<RecordBatch, ArrowError> {
    let columns = results::columns(question);
    let ids = std::iter::once((columns[0].0, ids));
    record_batch(ids.chain(columns_of_rows(&columns[1..], rows)))
}

/// Converts answers about paths to a batch of columns. The columns `id` and `micros` are left out.
pub(crate) fn path_result_batch(
    question: Question,
    rows: &[ResultRow],
) -> Result<RecordBatch, ArrowError> {
    let mut columns = path_rows::columns(question);
    columns.retain(|Column(name, _)| !matches!(*name, "id" | "micros"));
    record_batch(columns_of_rows(&columns, rows))
}

fn columns_of_rows(
    columns: &[Column],
    rows: &[ResultRow],
) -> impl Iterator<Item = (&'static str, ArrayRef)> {
    columns
        .iter()
        .map(|Column(name, cells)| (*name, column_array(*cells, rows)))
}

fn record_batch(
    columns: impl Iterator<Item = (&'static str, ArrayRef)>,
) -> Result<RecordBatch, ArrowError> {
    RecordBatch::try_from_iter_with_nullable(columns.map(|(name, array)| (name, array, true)))
}

/// Returns the cells of all rows in one column as an array.
fn column_array(cells: CellGetter, rows: &[ResultRow]) -> ArrayRef {
    match cells {
        CellGetter::Text(cell) => Arc::new(StringArray::from_iter(rows.iter().map(cell))),
        CellGetter::Number(cell) => {
            let nulls: NullBuffer = rows.iter().map(|row| cell(row).is_some()).collect();
            // Writes NaN to empty cells, so that values can be read without their validity mask.
            let values = rows.iter().map(|row| cell(row).unwrap_or(f64::NAN));
            let values = values.collect::<Vec<f64>>();
            Arc::new(Float64Array::new(values.into(), Some(nulls)))
        }
        CellGetter::Count(cell) => {
            // Counts stay below the budget of 2^63.
            let counts = rows.iter().map(|row| cell(row).map(|count| count as i64));
            Arc::new(Int64Array::from_iter(counts))
        }
    }
}
