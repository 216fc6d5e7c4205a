//! The fuzz target that reads tables of paths.

use super::motions::{OneByteReader, run_within_memory_limit};
use ccd_tables::motions::{RowPosition, TableError};
use ccd_tables::movements::{MovementRow, MovementRows, Movements};
use ccd_tables::paths::Grouping;
use std::io::Read;

pub(super) fn run(bytes: &[u8]) {
    // Most headers are those of motions; one more column makes a table of paths.
    let paths = [b"t,", bytes].concat();
    run_within_memory_limit(bytes, || {
        for bytes in [bytes, &paths] {
            for grouping in [Grouping::ById, Grouping::QueryPerRow] {
                check(bytes, grouping);
            }
        }
    });
}

/// Checks that a table is the same when read at once, byte by byte, and after skipped rows.
fn check(bytes: &[u8], grouping: Grouping) {
    let (whole, slow) = (read(bytes, grouping), read(OneByteReader(bytes), grouping));
    match (whole, slow) {
        (Ok(whole), Ok(slow)) => {
            assert_eq!(whole, slow, "read byte by byte, it differs");
            let (rows, checksum) = whole;
            rows.iter().for_each(check_row);
            check_rows_after_skip(bytes, grouping, &rows, checksum);
        }
        (Err(one), Err(other)) => assert_eq!(one.to_string(), other.to_string()),
        (one, other) => panic!("at once {one:?}, byte by byte {other:?}"),
    }
}

/// Reads all rows, and the checksum at the end.
fn read(input: impl Read, grouping: Grouping) -> Result<(Vec<MovementRow>, u32), TableError> {
    let mut rows = MovementRows::new(input, grouping)?;
    let all: Result<_, _> = rows.by_ref().collect();
    Ok((all?, rows.checksum()))
}

fn check_row(row: &MovementRow) {
    match row {
        Ok((_, course)) => {
            assert!(course.duration() >= 0.0 && course.duration().is_finite());
            let [first, last] = [
                course.table_time_rounded_down(0.0),
                course.table_time_rounded_up(course.duration()),
            ];
            // Written so that NaN fails.
            assert!(first <= last, "{first} {last}");
            if let Movements::Path(path) = course {
                assert!(path.poses_at(path.duration).is_ok());
            }
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// Checks that skipping rows does not affect the rows after them, except for default ids.
fn check_rows_after_skip(bytes: &[u8], grouping: Grouping, rows: &[MovementRow], checksum: u32) {
    let half = rows.len() / 2;
    let mut rest = MovementRows::new(bytes, grouping).expect("a header that was read");
    assert_eq!(rest.skip_rows(half).ok(), Some(half));
    let place = |row: &MovementRow| -> RowPosition {
        match row {
            Ok((position, _)) => *position,
            Err(error) => error.position,
        }
    };
    let found: Vec<_> = rest.by_ref().filter_map(Result::ok).collect();
    assert!(found.iter().map(place).eq(rows[half..].iter().map(place)));
    assert_eq!(rest.checksum(), checksum);
}
