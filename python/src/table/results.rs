//! Rows of results as Arrow columns.

use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray, new_empty_array};
use arrow_buffer::NullBuffer;
use arrow_cast::cast;
use arrow_schema::{ArrowError, DataType, Field, Schema};
use arrow_select::concat::concat_batches;
use rigid_ccd::batch::Question;
use rigid_ccd::table::results::{COLUMNS, LAST_TIME, ResultRow};
use std::sync::Arc;

/// Returns the columns of the results of a question, as in the command, for a given column of ids.
pub(crate) fn schema(question: Question, id: Field) -> Result<Schema, ArrowError> {
    let batch = batch(question, new_empty_array(id.data_type()), &[])?;
    let mut fields = batch.schema().fields().to_vec();
    fields[0] = Arc::new(id);
    Ok(Schema::new(fields))
}

/// Concatenates results. Ids too long for one column of their type become those of the type for long ones.
pub(crate) fn joined(
    schema: &Arc<Schema>,
    batches: &[RecordBatch],
) -> Result<RecordBatch, ArrowError> {
    let joined = concat_batches(schema, batches);
    let long = match schema.field(0).data_type() {
        DataType::Utf8 => DataType::LargeUtf8,
        DataType::Binary => DataType::LargeBinary,
        _ => return joined,
    };
    joined.or_else(|_| {
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

/// Converts rows to columns.
///
/// The values of empty cells are NaN, so that the buffers can be read without their validity.
pub(crate) fn batch(
    question: Question,
    ids: ArrayRef,
    rows: &[ResultRow],
) -> Result<RecordBatch, ArrowError> {
    let number = |of: fn(&ResultRow) -> Option<f64>| numbers(rows.iter().map(of).collect());
    let part = |of: fn(&ResultRow) -> &[Option<f64>; 3], k: usize| {
        numbers(rows.iter().map(|row| of(row)[k]).collect())
    };
    let count = |of: fn(&ResultRow) -> Option<u64>| -> ArrayRef {
        // Counts stay below the budget of 2^63.
        let counts = rows.iter().map(|row| of(row).map(|count| count as i64));
        Arc::new(Int64Array::from_iter(counts))
    };
    let text = |of: fn(&ResultRow) -> Option<&str>| -> ArrayRef {
        Arc::new(StringArray::from_iter(rows.iter().map(of)))
    };
    let mut columns = vec![
        ids,
        text(|row| Some(row.status.name())),
        number(|row| row.time),
        number(|row| row.distance_lower),
        number(|row| row.distance_upper),
    ];
    for of in [
        (|row| &row.normal) as fn(&ResultRow) -> &[Option<f64>; 3],
        |row| &row.witness_a,
        |row| &row.witness_b,
    ] {
        columns.extend((0..3).map(|k| part(of, k)));
    }
    columns.extend([
        text(|row| row.feature_a.as_deref()),
        text(|row| row.feature_b.as_deref()),
        count(|row| row.iterations),
        count(|row| row.oracle_calls),
        number(|row| row.micros),
        text(|row| row.reason.as_deref()),
    ]);
    let mut names = COLUMNS.to_vec();
    if question == Question::ContactInterval {
        names.push(LAST_TIME);
        columns.push(number(|row| row.last_time));
    }
    let fields = names.iter().zip(&columns);
    let fields = fields.map(|(&name, column)| Field::new(name, column.data_type().clone(), true));
    let schema = Schema::new(fields.collect::<Vec<_>>());
    RecordBatch::try_new(Arc::new(schema), columns)
}

fn numbers(cells: Vec<Option<f64>>) -> ArrayRef {
    let nulls: NullBuffer = cells.iter().map(Option::is_some).collect();
    let values: Vec<f64> = cells
        .into_iter()
        .map(|cell| cell.unwrap_or(f64::NAN))
        .collect();
    Arc::new(Float64Array::new(values.into(), Some(nulls)))
}
