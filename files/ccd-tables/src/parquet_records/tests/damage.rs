//! Tests that damaged files are refused, and that no damage ends the process.

use super::written::{Column, written};
use super::*;
use parquet::basic::{Compression, Encoding};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterVersion;

/// Returns small files that are stored in different ways.
fn files() -> Vec<Bytes> {
    let schema = "message table { optional binary id (UTF8); required double a_px; optional int32 a_py; required boolean b; }";
    let group = |first: i32| {
        let rows = first..first + 20;
        vec![
            Column::texts(
                rows.clone()
                    .map(|k| (k % 3 > 0).then(|| format!("p{}", k / 5))),
            ),
            Column::Double(rows.clone().map(|k| Some(f64::from(k))).collect()),
            Column::Int32(rows.clone().map(|k| (k % 4 > 0).then_some(k)).collect()),
            Column::Bool(rows.map(|k| Some(k % 2 > 0)).collect()),
        ]
    };
    let groups = [group(0), group(20)];
    let write = |properties| written(schema, properties, &groups);
    let builder = WriterProperties::builder;
    let delta = builder()
        .set_dictionary_enabled(false)
        .set_writer_version(WriterVersion::PARQUET_2_0)
        .set_column_encoding("id".into(), Encoding::DELTA_LENGTH_BYTE_ARRAY)
        .set_column_encoding("a_py".into(), Encoding::DELTA_BINARY_PACKED);
    let plain = builder().set_dictionary_enabled(false);
    vec![
        write(builder().build()),
        write(
            plain
                .set_column_encoding("id".into(), Encoding::DELTA_LENGTH_BYTE_ARRAY)
                .build(),
        ),
        write(delta.build()),
        write(builder().set_compression(Compression::SNAPPY).build()),
    ]
}

/// Reads all rows, and returns their number.
fn row_count(bytes: Vec<u8>) -> Result<usize, TableError> {
    let mut records = ParquetRecords::new(Bytes::from(bytes))?;
    let mut rows = 0;
    loop {
        match records.advance() {
            Ok(Some(_)) => rows += 1,
            Ok(None) => return Ok(rows),
            Err(error) => {
                assert!(
                    records.advance().unwrap().is_none(),
                    "nothing follows an error"
                );
                return Err(error);
            }
        }
    }
}

#[test]
fn cut_files_are_refused() {
    for file in files() {
        assert_eq!(row_count(file.to_vec()).unwrap(), 40);
        for length in 0..file.len() {
            let error = row_count(file[..length].to_vec()).unwrap_err();
            assert!(matches!(error, TableError::Parquet(_)), "{length}: {error}");
        }
    }
}

#[test]
fn garbage_after_the_signature_is_refused() {
    let mut rng = Pcg64::seed_from_u64(5);
    for length in 0..300 {
        let garbage: Vec<u8> = (0..length).map(|_| rng.random()).collect();
        let one_end = [b"PAR1", &garbage[..]].concat();
        let both_ends = [&one_end[..], b"PAR1"].concat();
        for bytes in [one_end, both_ends] {
            let error = row_count(bytes).unwrap_err();
            assert!(
                error.to_string().starts_with("cannot be read as Parquet: "),
                "{error}"
            );
        }
    }
}

/// Tests that each changed bit or byte gives rows or an error, and mostly an error.
#[test]
fn changed_bytes_give_rows_or_errors() {
    let (mut whole, mut refused) = (0, 0);
    for file in files() {
        for at in 0..file.len() {
            for change in [1, 2, 4, 8, 16, 32, 64, 128, 255, 127] {
                let mut bytes = file.to_vec();
                bytes[at] ^= change;
                match row_count(bytes) {
                    Ok(_) => whole += 1,
                    Err(TableError::Parquet(_) | TableError::ColumnType { .. }) => refused += 1,
                    Err(other) => panic!("byte {at}: {other}"),
                }
            }
        }
    }
    assert!(
        whole > 1000 && refused > 10_000,
        "{whole} read, {refused} refused"
    );
}

#[test]
fn several_changes_at_random_give_rows_or_errors() {
    let mut rng = Pcg64::seed_from_u64(7);
    for file in files() {
        for _ in 0..5000 {
            let mut bytes = file.to_vec();
            for _ in 0..rng.random_range(2..6) {
                let at = rng.random_range(0..bytes.len());
                bytes[at] = rng.random();
            }
            // Either is right: that nothing panics is tested.
            let _ = row_count(bytes);
        }
    }
}

#[test]
fn a_panic_becomes_an_error() {
    let call = || -> Result<(), ParquetError> { panic!("in the library") };
    let error = guarded(call).unwrap_err();
    assert_eq!(error.to_string(), "Parquet error: damaged data");
    assert_eq!(guarded(|| Ok(3)).unwrap(), 3);
}

/// Tests that a dictionary of one long text is refused, and does not become a text for each row.
#[test]
fn long_texts_are_refused() {
    let table = |length: usize| {
        let text = "x".repeat(length);
        written(
            "message table { required binary id (UTF8); }",
            WriterProperties::default(),
            &[vec![Column::texts(vec![Some(text); 1_000])]],
        )
    };
    let read = |length: usize| {
        let mut records = ParquetRecords::new(table(length)).unwrap();
        records.advance().map(|row| row.is_some())
    };
    assert!(read(1 << 16).unwrap());
    let error = read((1 << 16) + 1).unwrap_err().to_string();
    assert!(error.contains("a text of 65537 bytes"), "{error}");
}
