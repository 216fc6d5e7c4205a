use super::*;

/// Returns the line of an unclosed quote in a text, read in chunks of `size` bytes.
fn unclosed_quote_line(text: impl AsRef<[u8]>, size: usize) -> Option<u64> {
    let mut quotes = QuoteTracker::new(text.as_ref());
    let mut piece = vec![0; size];
    while quotes.read(&mut piece).unwrap() > 0 {}
    quotes.open_quote_line(u64::MAX)
}

#[test]
fn only_unclosed_quotes_are_reported() {
    for (text, expected) in [
        ("", None),
        ("a,b\n1,2\n", None),
        ("a,\"b\nc\"\n", None),
        ("a,\"b\"\"c\"\n", None),
        ("\"a\"", None),
        // Within a cell, and after the closing quote, a quote is an ordinary character.
        ("a\"b,c\n", None),
        (" \"a\n", None),
        ("\"a\" \"b\n", None),
        ("\"\n", Some(1)),
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
