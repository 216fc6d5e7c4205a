//! Tests how line ends, quotes and row numbers of a table are read.

use super::*;

#[test]
fn rows_have_the_length_of_the_header() {
    let table = read("id,a_px\n1\n2,0,3\n3,0\n");
    assert_eq!(table.rows.len(), 1);
    let positions: Vec<(usize, Option<u64>)> = table
        .errors
        .iter()
        .map(|e| (e.position.row, e.position.line))
        .collect();
    assert_eq!(positions, [(0, Some(2)), (1, Some(3))]);
}

#[test]
fn bytes_that_are_not_text_affect_only_their_row() {
    let table = MotionTable::read(&b"id,a_px\n\xff,1\ngood,1\n"[..]).unwrap();
    assert_eq!(table.rows.len(), 1);
    let expected = RowProblem::NotText {
        column: "id".into(),
    };
    assert_eq!(table.errors[0].problem, expected);
}

#[test]
fn a_byte_order_mark_is_ignored() {
    assert_eq!(only_query("\u{feff}id\nx\n").id, "x");
}

/// Tests that an unclosed quote is an error with its own row and line, and that the rows before it are read.
#[test]
fn an_unclosed_quote_is_reported_where_it_opens() {
    for (text, rows, expected) in [
        ("id,a_px\n0,1\n\n1,\"2\n2,3\n", 1, (Some(1), 4)),
        ("id,a_px\n\"a\nb\",1\n\"c\n\n,2\n", 1, (Some(1), 4)),
        ("id,a_px\n0,1\n1,\"", 1, (Some(1), 3)),
        ("id,a_px\n0,\"1\"\"\n1,2\n", 0, (Some(0), 2)),
        ("\u{feff}\n\"id,a_px\n0,1\n", 0, (None, 2)),
    ] {
        for end in ["\n", "\r\n", "\r"] {
            let text = text.replace('\n', end);
            let mut read = 0;
            let message = MotionRows::new(text.as_bytes()).and_then(|mut table| {
                read = table.by_ref().take(rows).filter(Result::is_ok).count();
                table.next().transpose()
            });
            let Err(TableError::UnclosedQuote { row, line }) = message else {
                panic!("{text:?}: {message:?}");
            };
            assert_eq!((read, (row, line)), (rows, expected), "{text:?}");
        }
    }
    // Skipped rows count as rows.
    let mut passing = MotionRows::new(&b"id\n0\n\"1\n2\n"[..]).unwrap();
    assert!(matches!(
        passing.skip_rows(9),
        Err(TableError::UnclosedQuote {
            row: Some(1),
            line: 3
        })
    ));
}

/// Tests that quoted cells with line ends, commas and quotes are read correctly in a table of 5,000 rows.
#[test]
fn closed_quotes_are_legal() {
    let mut text = "id,a_px\n".to_owned();
    for k in 0..5000 {
        text += &format!("\"{k}\n, \"\"x\"\"\",\"{k}\"\n");
    }
    let table = read(&text);
    assert_eq!((table.rows.len(), table.errors.len()), (5000, 0));
    assert_eq!(table.rows[7].1.id, "7\n, \"x\"");
}

/// Tests that messages give the line that an editor shows, for any kind of line end.
#[test]
fn lines_are_counted_as_editors_count_them() {
    let text = "\u{feff}\nid,a_px\n\nx1,x\n\n\n\"a\nb\",x\nx3,x\n  ,x\n\"c\n\n\",\"\n1\n\"\nlast,x";
    let expected = [(0, 4), (1, 7), (2, 9), (3, 10), (5, 16)];
    for end in ["\n", "\r\n", "\r"] {
        for last in ["", end] {
            let text = text.replace('\n', end) + last;
            let table = read(&text);
            let positions: Vec<(usize, u64)> = table
                .errors
                .iter()
                .map(|error| (error.position.row, error.position.line.unwrap()))
                .collect();
            assert_eq!(positions, expected, "{end:?} {last:?}");
            let ids: Vec<&str> = table.errors.iter().map(|error| error.id.as_str()).collect();
            assert_eq!(ids, ["x1", "a\nb", "x3", "3", "last"]);
            assert_eq!(table.rows[0].1.a.start().translation(), DVec3::X);
        }
    }
}

/// A reader that returns one byte at a time, and so splits every `\r\n`.
struct OneByteReader<'a>(&'a [u8]);

impl io::Read for OneByteReader<'_> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let some = out.len().min(1);
        self.0.read(&mut out[..some])
    }
}

#[test]
fn lines_split_anywhere_are_the_same_lines() {
    let text = "id,a_px\r\n\r\n1,x\r\n2,2\r\n";
    let mut rows = MotionRows::new(OneByteReader(text.as_bytes())).unwrap();
    let error = rows.next().unwrap().unwrap().unwrap_err();
    assert_eq!((error.position.row, error.position.line), (0, Some(3)));
    assert!(rows.next().unwrap().unwrap().is_ok());
    assert!(rows.next().is_none());
    assert_eq!(rows.consumed_bytes(), text.len() as u64);
}

/// Tests that the byte count ends with the last row returned, although later rows are already buffered.
#[test]
fn bytes_are_those_up_to_the_last_row() {
    let header = "id,a_px\n";
    let mut rows = MotionRows::new("id,a_px\n1,1\nlonger,2\n3,3".as_bytes()).unwrap();
    for expected in ["", "1,1\n", "1,1\nlonger,2\n", "1,1\nlonger,2\n3,3"] {
        assert_eq!(
            rows.consumed_bytes(),
            (header.len() + expected.len()) as u64
        );
        let _ = rows.next();
    }
}

/// Tests that a byte order mark that arrives in several reads is dropped. The fuzz target `motions` found this case.
#[test]
fn a_byte_order_mark_in_parts_is_ignored() {
    let mut rows = MotionRows::new(OneByteReader("\u{feff}id\nx\n".as_bytes())).unwrap();
    assert_eq!(rows.next().unwrap().unwrap().unwrap().1.id, "x");
}

#[test]
fn skipped_rows_are_counted() {
    let text = "id,a_px\n1,1\n2,x\n3,x\n";
    let rows = || MotionRows::new(text.as_bytes()).unwrap();
    let (mut passing, mut reading) = (rows(), rows());
    assert_eq!(passing.skip_rows(2).unwrap(), 2);
    reading.by_ref().take(2).for_each(drop);
    assert_eq!(passing.checksum(), reading.checksum());
    let error = passing.next().unwrap().unwrap().unwrap_err();
    assert_eq!((error.position.row, error.position.line), (2, Some(4)));
    assert_ne!(passing.checksum(), reading.checksum());
    assert_eq!(rows().skip_rows(9).unwrap(), 3);
}
