//! Tests the types, encodings and compressions of columns that are read, and that others are refused.

use super::written::{Column, written};
use super::*;
use parquet::basic::{Compression, Encoding};
use parquet::file::properties::WriterVersion;

/// Returns the texts of a column named `x`, with the given type.
fn texts(schema_type: &str, column: &Column) -> Vec<String> {
    let schema = format!("message table {{ optional {schema_type}; }}");
    let bytes = written(
        &schema,
        WriterProperties::default(),
        &[vec![column.clone()]],
    );
    texts_of_first_column(ParquetRecords::new(bytes).unwrap())
}

fn texts_of_first_column(mut records: ParquetRecords<Bytes>) -> Vec<String> {
    let mut texts = Vec::new();
    while records.advance().unwrap().is_some() {
        texts.push(records.current().text(0).unwrap_or_default());
    }
    texts
}

#[test]
fn booleans_and_numbers_have_their_texts() {
    for (schema_type, column, expected) in [
        (
            "boolean x",
            Column::Bool(vec![Some(true), None, Some(false)]),
            vec!["true", "", "false"],
        ),
        (
            "int32 x",
            Column::Int32(vec![Some(i32::MIN), None]),
            vec!["-2147483648", ""],
        ),
        (
            "int32 x (UINT_32)",
            Column::Int32(vec![Some(-1)]),
            vec!["4294967295"],
        ),
        (
            "int32 x (INTEGER(8,true))",
            Column::Int32(vec![Some(-7)]),
            vec!["-7"],
        ),
        (
            "int64 x",
            Column::Int64(vec![Some(i64::MIN)]),
            vec!["-9223372036854775808"],
        ),
        (
            "int64 x (INTEGER(64,false))",
            Column::Int64(vec![Some(-1)]),
            vec!["18446744073709551615"],
        ),
        (
            "float x",
            Column::Float(vec![Some(0.1)]),
            vec!["0.10000000149011612"],
        ),
        (
            "double x",
            Column::Double(vec![Some(0.1), Some(-0.0), Some(5e-324), Some(1e300)]),
            vec!["0.1", "-0.0", "5e-324", "1e300"],
        ),
        (
            "double x",
            Column::Double(vec![Some(f64::NAN), Some(f64::INFINITY)]),
            vec!["NaN", "inf"],
        ),
    ] {
        assert_eq!(texts(schema_type, &column), expected, "{schema_type}");
    }
}

#[test]
fn texts_and_decimals_have_their_texts() {
    let wide = |number: i128| Some(number.to_be_bytes().to_vec());
    for (schema_type, column, expected) in [
        (
            "binary x (UTF8)",
            Column::texts([Some("é"), Some(""), None]),
            vec!["é", "", ""],
        ),
        ("binary x (ENUM)", Column::texts([Some("a")]), vec!["a"]),
        ("binary x", Column::texts([Some("a")]), vec!["a"]),
        (
            "int32 x (DECIMAL(9,2))",
            Column::Int32(vec![Some(-12345)]),
            vec!["-123.45"],
        ),
        (
            "int64 x (DECIMAL(18,0))",
            Column::Int64(vec![Some(12)]),
            vec!["12"],
        ),
        (
            "binary x (DECIMAL(20,3))",
            Column::Bytes(vec![Some(vec![0xff, 0x38])]),
            vec!["-0.200"],
        ),
        (
            "fixed_len_byte_array(16) x (DECIMAL(38,38))",
            Column::FixedBytes(vec![wide(i128::MIN)]),
            vec!["-1.70141183460469231731687303715884105728"],
        ),
    ] {
        assert_eq!(texts(schema_type, &column), expected, "{schema_type}");
    }
}

#[test]
fn decimals_are_the_nearest_numbers() {
    let column = Column::Int64(vec![Some(123_456_789_012_345_678)]);
    let bytes = written(
        "message table { required int64 a_px (DECIMAL(18,9)); }",
        WriterProperties::default(),
        &[vec![column]],
    );
    let mut records = ParquetRecords::new(bytes).unwrap();
    records.advance().unwrap();
    assert_eq!(
        records.current().number(0),
        "123456789.012345678"
            .parse()
            .map(Some)
            .map_err(|_| String::new())
    );
}

#[test]
fn columns_of_other_types_are_refused() {
    for (schema_type, expected) in [
        ("required int96 x", "timestamps"),
        ("required int64 x (TIMESTAMP(NANOS,true))", "timestamps"),
        ("required int64 x (TIMESTAMP_MILLIS)", "timestamps"),
        ("required int64 x (TIME(NANOS,true))", "times of day"),
        ("required int32 x (DATE)", "dates"),
        (
            "required fixed_len_byte_array(2) x (FLOAT16)",
            "floats of 16 bits",
        ),
        ("required fixed_len_byte_array(16) x (UUID)", "bytes"),
        ("required fixed_len_byte_array(3) x", "bytes"),
        ("required binary x (BSON)", "bytes"),
        ("repeated double x", "lists or structs"),
        (
            "optional group x { required double y; required double z; }",
            "lists or structs",
        ),
        (
            "optional group x (LIST) { repeated group list { optional double element; } }",
            "lists or structs",
        ),
    ] {
        let schema =
            format!("message table {{ required double a; {schema_type}; }}").replace("};", "}");
        let bytes = written(&schema, WriterProperties::default(), &[]);
        let error = ParquetRecords::new(bytes).err().unwrap();
        assert_eq!(
            error.to_string(),
            format!("header: column `x` holds {expected}; convert them to numbers or to text")
        );
    }
}

#[test]
fn cells_that_are_not_text_are_errors_of_their_rows() {
    let bytes = written(
        "message table { required binary id; }",
        WriterProperties::default(),
        &[vec![Column::Bytes(vec![
            Some(vec![0xff]),
            Some(b"a".to_vec()),
        ])]],
    );
    let rows = MotionRows::of(ParquetRecords::new(bytes).unwrap()).unwrap();
    let rows: Vec<_> = rows.map(Result::unwrap).collect();
    assert_eq!(
        rows[0].as_ref().unwrap_err().to_string(),
        "row 0: column id: is not text in UTF-8"
    );
    assert!(rows[1].is_ok());
}

#[test]
fn an_index_of_pandas_is_refused_by_name() {
    let bytes = written(
        "message table { required double a_px; optional int64 __index_level_0__; }",
        WriterProperties::default(),
        &[],
    );
    let error = MotionRows::of(ParquetRecords::new(bytes).unwrap())
        .err()
        .unwrap();
    assert!(matches!(error, TableError::PandasIndex { .. }), "{error}");
}

#[test]
fn compressions_and_encodings_change_no_cell() {
    let texts: Vec<_> = (0..300)
        .map(|k| (k % 3 > 0).then(|| format!("path {}", k / 9)))
        .collect();
    let numbers: Vec<_> = (0..300).map(|k| Some(f64::from(k).sqrt())).collect();
    let wholes: Vec<_> = (0..300).map(|k| (k % 7 > 0).then_some(k * k)).collect();
    let columns = vec![
        Column::texts(texts),
        Column::Double(numbers),
        Column::Int64(wholes),
    ];
    let schema =
        "message table { optional binary id (UTF8); required double a_px; optional int64 a_py; }";
    let checksum = |properties| {
        let mut records =
            ParquetRecords::new(written(schema, properties, std::slice::from_ref(&columns)))
                .unwrap();
        while records.advance().unwrap().is_some() {}
        assert_eq!(records.row_count, 300);
        records.checksum()
    };
    let expected = checksum(WriterProperties::default());
    let mut all = vec![
        Compression::SNAPPY,
        Compression::LZ4_RAW,
        Compression::GZIP(Default::default()),
    ];
    if cfg!(feature = "zstd") {
        all.push(Compression::ZSTD(Default::default()));
    }
    for version in [WriterVersion::PARQUET_1_0, WriterVersion::PARQUET_2_0] {
        for &compression in &all {
            let builder = || {
                let builder = WriterProperties::builder().set_compression(compression);
                builder
                    .set_writer_version(version)
                    .set_column_encoding("id".into(), Encoding::DELTA_LENGTH_BYTE_ARRAY)
            };
            assert_eq!(checksum(builder().build()), expected);
            let plain = builder().set_dictionary_enabled(false);
            assert_eq!(checksum(plain.clone().build()), expected);
            let split = plain.set_column_encoding("a_px".into(), Encoding::BYTE_STREAM_SPLIT);
            let packed = split.set_column_encoding("a_py".into(), Encoding::DELTA_BINARY_PACKED);
            assert_eq!(checksum(packed.build()), expected);
        }
    }
}

#[test]
fn an_encoding_that_cannot_be_checked_is_refused() {
    let properties = WriterProperties::builder().set_dictionary_enabled(false);
    let properties = properties.set_column_encoding("id".into(), Encoding::DELTA_BYTE_ARRAY);
    let bytes = written(
        "message table { required binary id (UTF8); }",
        properties.build(),
        &[vec![Column::texts([Some("a")])]],
    );
    let error = ParquetRecords::new(bytes).unwrap().advance().unwrap_err();
    let message = error.to_string();
    assert!(
        message.contains("row group 0: column `id`: ") && message.contains("DELTA_BYTE_ARRAY"),
        "{message}"
    );
}
