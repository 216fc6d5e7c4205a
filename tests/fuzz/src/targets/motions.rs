//! The fuzz target that reads tables of motions.

use crate::memory;
use ccd_tables::motions::{MotionRows, MotionTable, Motions, RowPosition, write};
use std::io::{self, Read};

/// The maximum size of the input, in bytes.
const MAX_TABLE_BYTES: usize = 1 << 14;

/// The constant part of the memory limit, in bytes. The limit grows with the input, because a row of one byte is a
/// whole query.
const BASE_MEMORY_LIMIT: usize = 1 << 24;
const MEMORY_LIMIT_PER_INPUT_BYTE: usize = 1 << 11;

pub(super) fn run(bytes: &[u8]) {
    run_within_memory_limit(bytes, || {
        let whole = MotionTable::read(bytes);
        let slow = MotionTable::read(OneByteReader(bytes));
        match (whole, slow) {
            (Ok(whole), Ok(slow)) => {
                assert_eq!(whole, slow, "read byte by byte, it differs");
                check(bytes, &whole);
            }
            (Err(one), Err(other)) => assert_eq!(one.to_string(), other.to_string()),
            (one, other) => panic!("at once {one:?}, byte by byte {other:?}"),
        }
    });
}

/// Runs a check of a table within a memory limit, unless the table has more than `MAX_TABLE_BYTES`.
pub(super) fn run_within_memory_limit(bytes: &[u8], check: impl FnOnce()) {
    if bytes.len() <= MAX_TABLE_BYTES {
        memory::with_memory_limit(
            BASE_MEMORY_LIMIT + MEMORY_LIMIT_PER_INPUT_BYTE * bytes.len(),
            check,
        );
    }
}

/// A reader that returns one byte at a time.
pub(super) struct OneByteReader<'a>(pub(super) &'a [u8]);

impl Read for OneByteReader<'_> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let one = out.len().min(1);
        self.0.read(&mut out[..one])
    }
}

fn check(bytes: &[u8], table: &MotionTable) {
    let rows = table.rows.iter().map(|(position, _)| *position);
    let mut all: Vec<RowPosition> = rows
        .chain(table.errors.iter().map(|e| e.position))
        .collect();
    all.sort_unstable_by_key(|position| position.row);
    let lines = bytes.len() as u64 + 1;
    for (k, position) in all.iter().enumerate() {
        assert_eq!(position.row, k, "rows are counted from 0");
        assert!(
            position
                .line
                .is_some_and(|line| (1..=lines).contains(&line)),
            "{position:?}"
        );
    }
    // An empty line is no row, and several rows are never on one line.
    assert!(
        all.windows(2).all(|two| two[0].line < two[1].line),
        "{all:?}"
    );
    table.errors.iter().for_each(|error| {
        assert!(!error.to_string().is_empty());
    });
    check_rows_after_skip(bytes, table, all.len());
    check_written_rows(table);
}

/// Checks that skipping rows does not affect the rows after them.
fn check_rows_after_skip(bytes: &[u8], table: &MotionTable, rows: usize) {
    let half = rows / 2;
    let mut rest = MotionRows::new(bytes).expect("a header that was read");
    assert_eq!(rest.skip_rows(half).ok(), Some(half));
    let rest: Vec<_> = rest.by_ref().filter_map(|row| row.ok()?.ok()).collect();
    let expected: Vec<_> = table.rows.iter().filter(|row| row.0.row >= half).collect();
    assert!(rest.iter().eq(expected.into_iter()));
}

/// Checks that written rows read back to the same numbers, except that orientations are rounded.
fn check_written_rows(table: &MotionTable) {
    let queries: Vec<Motions> = table.rows.iter().map(|(_, query)| query.clone()).collect();
    let mut bytes = Vec::new();
    write(&mut bytes, &queries).expect("memory takes all bytes");
    let again = MotionTable::read(&bytes[..]).expect("a table that was written");
    assert_eq!(again.errors, [], "{}", String::from_utf8_lossy(&bytes));
    assert_eq!(again.rows.len(), queries.len());
    for (one, (_, other)) in queries.iter().zip(&again.rows) {
        assert_eq!(
            losslessly_written_values(one),
            losslessly_written_values(other)
        );
        for (one, other) in [(one.a, other.a), (one.b, other.b)] {
            let turn = one.start().rotation().dot(other.start().rotation());
            assert!(turn.abs() > 1.0 - 1e-12, "{one:?} {other:?}");
        }
    }
}

/// Returns the values of a row that are written without loss.
fn losslessly_written_values(query: &Motions) -> (&str, f64, [[[f64; 3]; 4]; 2]) {
    let numbers = [query.a, query.b].map(|motion| {
        [
            motion.start().translation(),
            motion.velocity(),
            motion.angular_velocity(),
            motion.center(),
        ]
        .map(|v| v.to_array())
    });
    (&query.id, query.duration, numbers)
}
