//! Compares the reader with that of CSV on the same data, and reads damaged files.

mod damage;
mod types;
mod written;

use super::*;
use crate::csv_records::CsvRecords;
use crate::motions::{MotionRows, RowError};
use crate::records::Record;
use bytes::Bytes;
use parquet::file::properties::WriterProperties;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use written::{Column, written};

const SCHEMA: &str = "message table { optional binary id (UTF8); required double a_px; optional double a_py; \
                      required float a_vz; optional int32 a_vx; required int64 duration; }";

/// A table of several row groups and pages, and the same table as CSV.
struct Twins {
    parquet: Bytes,
    csv: String,
}

/// Returns a table whose floats have all kinds of magnitudes.
fn random_twins(row_count: usize, group_row_count: usize) -> Twins {
    let mut rng = Pcg64::seed_from_u64(3);
    let mut csv = "id,a_px,a_py,a_vz,a_vx,duration\n".to_owned();
    let mut groups = Vec::new();
    let mut row = 0;
    while row < row_count {
        let count = group_row_count.min(row_count - row);
        let (mut ids, mut px, mut py) = (Vec::new(), Vec::new(), Vec::new());
        let (mut vz, mut vx, mut duration) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..count {
            ids.push(
                rng.random_bool(0.8)
                    .then(|| format!(" \"r{}\", é", row % 7)),
            );
            px.push(Some(random_double(&mut rng)));
            py.push(rng.random_bool(0.7).then(|| random_double(&mut rng)));
            vz.push(Some(f32::from_bits(rng.random::<u32>() & !0x4000_0000)));
            vx.push(rng.random_bool(0.7).then(|| rng.random()));
            duration.push(Some(rng.random::<i64>()));
            let text =
                |number: Option<f64>| number.map_or(String::new(), |number| format!("{number}"));
            let id = ids.last().unwrap().as_deref().unwrap_or_default();
            csv += &format!(
                "\"{}\",{},",
                id.replace('"', "\"\""),
                text(*px.last().unwrap())
            );
            csv += &format!(
                "{},{},",
                text(*py.last().unwrap()),
                text(vz.last().unwrap().map(f64::from))
            );
            let whole = vx
                .last()
                .unwrap()
                .map_or(String::new(), |whole: i32| whole.to_string());
            csv += &format!("{whole},{}\n", duration.last().unwrap().unwrap());
            row += 1;
        }
        groups.push(vec![
            Column::texts(ids),
            Column::Double(px),
            Column::Double(py),
            Column::Float(vz),
            Column::Int32(vx),
            Column::Int64(duration),
        ]);
    }
    let properties = WriterProperties::builder().set_data_page_row_count_limit(100);
    let properties = properties.set_write_batch_size(50);
    Twins {
        parquet: written(SCHEMA, properties.build(), &groups),
        csv,
    }
}

/// Returns a finite number of any magnitude.
fn random_double(rng: &mut Pcg64) -> f64 {
    match f64::from_bits(rng.random()) {
        number if number.is_finite() => number,
        _ => -0.0,
    }
}

/// Checks that both readers give the same cells, and returns the number of rows.
fn assert_same_cells(mut one: impl Records, mut other: impl Records) -> usize {
    let header = one.header().unwrap();
    assert_eq!(header, other.header().unwrap());
    let mut rows = 0;
    while let Some(position) = one.advance().unwrap() {
        assert_eq!(other.advance().unwrap().unwrap().row, position.row);
        assert_eq!(
            position,
            RowPosition {
                row: rows,
                line: None
            }
        );
        let (record, twin) = (one.current(), other.current());
        record.check(&header).unwrap();
        for (cell, name) in header.iter().enumerate() {
            assert_eq!(record.has_value(cell), twin.has_value(cell));
            let bits = |number: Result<Option<f64>, String>| number.map(|n| n.map(f64::to_bits));
            if name != "id" {
                assert_eq!(
                    bits(record.number(cell)),
                    bits(twin.number(cell)),
                    "{rows} {cell}"
                );
            } else {
                assert_eq!(record.text(cell), twin.text(cell));
            }
        }
        rows += 1;
    }
    assert_eq!(other.advance().unwrap(), None);
    rows
}

#[test]
fn cells_are_those_of_the_same_csv() {
    for (row_count, group_row_count) in [(0, 1), (1, 1), (1023, 5000), (1024, 300), (5000, 2049)] {
        let Twins { parquet, csv } = random_twins(row_count, group_row_count);
        let records = ParquetRecords::new(parquet).unwrap();
        let rows = assert_same_cells(records, CsvRecords::new(csv.as_bytes()).unwrap());
        assert_eq!(rows, row_count);
    }
}

#[test]
fn motions_are_those_of_the_same_csv() {
    let Twins { parquet, csv } = random_twins(3000, 700);
    let rows = MotionRows::of(ParquetRecords::new(parquet).unwrap()).unwrap();
    let twins = MotionRows::new(csv.as_bytes()).unwrap();
    let (mut valid, mut bad) = (0, 0);
    for (row, twin) in rows.zip(twins) {
        match (row.unwrap(), twin.unwrap()) {
            (Ok((position, motions)), Ok((other, twin))) => {
                assert_eq!((position.row, motions), (other.row, twin));
                valid += 1;
            }
            (Err(error), Err(twin)) => {
                assert_eq!(
                    (error.position.row, error.id, error.problem),
                    (twin.position.row, twin.id, twin.problem)
                );
                bad += 1;
            }
            other => panic!("{other:?}"),
        }
    }
    assert!(
        valid > 10 && bad > 1000 && valid + bad == 3000,
        "{valid} {bad}"
    );
}

#[test]
fn messages_give_rows_without_lines() {
    let parquet = written(
        "message table { required binary a_px (UTF8); }",
        WriterProperties::default(),
        &[vec![Column::texts([Some("1"), Some("x")])]],
    );
    let mut rows = MotionRows::of(ParquetRecords::new(parquet).unwrap()).unwrap();
    assert!(rows.next().unwrap().unwrap().is_ok());
    let error: RowError = rows.next().unwrap().unwrap().unwrap_err();
    assert_eq!(
        error.to_string(),
        "row 1: column a_px: `x` is not a finite number"
    );
}

/// Tests that a checksum is of all rows so far, also of skipped ones and of all row groups, and not of how they are stored.
#[test]
fn checksums_tell_tables_apart() {
    let at = |twins: &Twins, rows: usize| {
        let mut rows_of =
            MotionRows::of(ParquetRecords::new(twins.parquet.clone()).unwrap()).unwrap();
        assert_eq!(rows_of.skip_rows(rows).unwrap(), rows);
        rows_of.checksum()
    };
    let (twins, stored_otherwise) = (random_twins(2500, 1000), random_twins(2500, 600));
    let longer = random_twins(2501, 1000);
    let mut known = Vec::new();
    for rows in [0, 1, 999, 1000, 1001, 2500] {
        let checksum = at(&twins, rows);
        assert_eq!(checksum, at(&stored_otherwise, rows));
        assert_eq!(checksum, at(&longer, rows));
        assert!(!known.contains(&checksum));
        known.push(checksum);
    }
}

#[test]
fn consumed_bytes_grow_to_the_length_of_the_file() {
    let parquet = random_twins(2500, 1000).parquet;
    let mut records = ParquetRecords::new(parquet.clone()).unwrap();
    let mut before = 0;
    assert_eq!(records.consumed_bytes(), 0);
    while records.advance().unwrap().is_some() {
        assert!(records.consumed_bytes() > before);
        before = records.consumed_bytes();
    }
    assert_eq!(before, parquet.len() as u64);
}
