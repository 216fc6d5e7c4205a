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
