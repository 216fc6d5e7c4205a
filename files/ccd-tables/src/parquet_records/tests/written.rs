//! Writes Parquet files for tests.

use bytes::Bytes;
use parquet::column::writer::ColumnWriter;
use parquet::data_type::{ByteArray, FixedLenByteArray};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;
use std::sync::Arc;

/// The values of a column, some of which may be absent.
#[derive(Clone)]
pub(super) enum Column {
    Bool(Vec<Option<bool>>),
    Int32(Vec<Option<i32>>),
    Int64(Vec<Option<i64>>),
    Float(Vec<Option<f32>>),
    Double(Vec<Option<f64>>),
    Bytes(Vec<Option<Vec<u8>>>),
    FixedBytes(Vec<Option<Vec<u8>>>),
}

impl Column {
    pub(super) fn texts<T: AsRef<str>>(texts: impl IntoIterator<Item = Option<T>>) -> Self {
        let bytes = texts
            .into_iter()
            .map(|text| text.map(|text| text.as_ref().as_bytes().to_owned()));
        Column::Bytes(bytes.collect())
    }

    fn write(&self, writer: &mut ColumnWriter<'_>) {
        macro_rules! write {
            ($writer:expr, $values:expr, $convert:expr) => {{
                let levels: Vec<i16> = $values.iter().map(|v| i16::from(v.is_some())).collect();
                let present: Vec<_> = $values.iter().flatten().cloned().map($convert).collect();
                $writer.write_batch(&present, Some(&levels), None).unwrap()
            }};
        }
        match (self, writer) {
            (Column::Bool(values), ColumnWriter::BoolColumnWriter(writer)) => {
                write!(writer, values, |value| value)
            }
            (Column::Int32(values), ColumnWriter::Int32ColumnWriter(writer)) => {
                write!(writer, values, |value| value)
            }
            (Column::Int64(values), ColumnWriter::Int64ColumnWriter(writer)) => {
                write!(writer, values, |value| value)
            }
            (Column::Float(values), ColumnWriter::FloatColumnWriter(writer)) => {
                write!(writer, values, |value| value)
            }
            (Column::Double(values), ColumnWriter::DoubleColumnWriter(writer)) => {
                write!(writer, values, |value| value)
            }
            (Column::Bytes(values), ColumnWriter::ByteArrayColumnWriter(writer)) => {
                write!(writer, values, ByteArray::from)
            }
            (Column::FixedBytes(values), ColumnWriter::FixedLenByteArrayColumnWriter(writer)) => {
                write!(writer, values, |value| FixedLenByteArray::from(
                    ByteArray::from(value)
                ))
            }
            _ => panic!("the schema has another type"),
        };
    }
}

/// Returns a file with the given row groups, each of one list of values for each column of the schema.
pub(super) fn written(schema: &str, properties: WriterProperties, groups: &[Vec<Column>]) -> Bytes {
    let schema = Arc::new(parse_message_type(schema).unwrap());
    let mut file = SerializedFileWriter::new(Vec::new(), schema, Arc::new(properties)).unwrap();
    for group in groups {
        let mut writer = file.next_row_group().unwrap();
        let mut columns = group.iter();
        while let Some(mut column) = writer.next_column().unwrap() {
            columns.next().unwrap().write(column.untyped());
            column.close().unwrap();
        }
        writer.close().unwrap();
    }
    Bytes::from(file.into_inner().unwrap())
}
