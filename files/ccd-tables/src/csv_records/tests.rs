use super::*;

/// A reader that gives at most some bytes at a time.
struct PieceReader<'t>(&'t [u8], usize);

impl Read for PieceReader<'_> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let most = self.1.min(out.len());
        self.0.read(&mut out[..most])
    }
}

/// Returns the line of an unclosed quote in a table, read in chunks of `size` bytes.
fn unclosed_quote_line(text: impl AsRef<[u8]>, size: usize) -> Option<u64> {
    let found = CsvRecords::new(PieceReader(text.as_ref(), size)).and_then(|mut records| {
        while records.advance()?.is_some() {}
        Ok(())
    });
    match found {
        Ok(()) => None,
        Err(TableError::UnclosedQuote { line, .. }) => Some(line),
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn only_unclosed_quotes_are_reported() {
    for (text, expected) in [
        ("", None),
        ("a,b\n1,2\n", None),
        ("a,\"b\nc\"\n", None),
        ("a,\"b\"\"c\"\n", None),
        ("\"a\"", None),
        ("\"a\n\"", None),
        ("a,\"b\n\n\"\r\n", None),
        ("\n\n", None),
        // Within a cell, and after the closing quote, a quote is an ordinary character.
        ("a\"b,c\n", None),
        (" \"a\n", None),
        ("\"a\" \"b\n", None),
        ("\"\n", Some(1)),
        ("\"", Some(1)),
        ("a\n\r\"", Some(3)),
        ("a,b\n1,\"2\n3,4\n", Some(2)),
        ("\"x\ny\",\"b\"\"\n\n", Some(2)),
    ] {
        for size in [1, 2, 64] {
            assert_eq!(unclosed_quote_line(text, size), expected, "{text:?}");
        }
    }
}

#[test]
fn quotes_after_pieces_without_quotes_are_followed() {
    let rows = "1,2,3\n".repeat(40);
    assert_eq!(unclosed_quote_line(format!("{rows}\"x\n"), 64), Some(41));
    // The first piece ends after a separator, or within a cell.
    let cells = "1,".repeat(31);
    assert_eq!(unclosed_quote_line(format!("{cells}1,\"x"), 64), Some(1));
    assert_eq!(unclosed_quote_line(format!("{cells}11\"x"), 64), None);
}

/// A reader that repeats some bytes, and counts how many have been taken.
struct EndlessReader(&'static [u8], std::rc::Rc<std::cell::Cell<usize>>);

impl Read for EndlessReader {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let EndlessReader(bytes, taken) = self;
        for (k, byte) in out.iter_mut().enumerate() {
            *byte = bytes[(taken.get() + k) % bytes.len()];
        }
        taken.set(taken.get() + out.len());
        Ok(out.len())
    }
}

/// Tests that a header, a row or empty lines without an end are an error before they fill the memory.
#[test]
fn what_does_not_end_is_refused() {
    for (start, repeated) in [
        ("", &b"\0"[..]),
        ("", b"x,"),
        ("", b"\n"),
        ("", b"\"\""),
        ("a\n1\n", b"\r"),
        ("a\n1\n", b"9"),
    ] {
        let taken = std::rc::Rc::default();
        let input = start
            .as_bytes()
            .chain(EndlessReader(repeated, std::rc::Rc::clone(&taken)));
        let error = CsvRecords::new(input).and_then(|mut records| {
            while records.advance()?.is_some() {}
            Ok(())
        });
        let text = error.unwrap_err().to_string();
        assert!(text.contains("does not end within 16 MB"), "{text}");
        assert!(taken.get() < 1 << 25, "{}", taken.get());
    }
    // Rows that end may be as many as there are.
    let rows = io::repeat(b'7').take(9_999_999).chain(&b"\n"[..]);
    let two = rows
        .chain(io::repeat(b'8').take(9_999_999))
        .chain(&b"\n"[..]);
    let mut records = CsvRecords::new(two).unwrap();
    assert!(records.advance().unwrap().is_some());
    assert!(records.advance().unwrap().is_none());
}

#[test]
fn cells_have_a_greatest_length() {
    let header = ["a".to_owned(), "b".to_owned()];
    let check = |length: usize| {
        let text = format!("a,b\n1,{}\n", "9".repeat(length));
        let mut records = CsvRecords::new(text.as_bytes()).unwrap();
        records.advance().unwrap();
        records.current().check(&header)
    };
    assert_eq!(check(MAX_CELL_BYTES), Ok(()));
    assert_eq!(
        check(MAX_CELL_BYTES + 1).unwrap_err().to_string(),
        "column b: a cell of 65537 bytes; 65536 are the most"
    );
}
