//! Texts of any encoding and with any line ends, as they come.

use std::borrow::Cow;

/// A text in UTF-8, without a byte order mark, whose lines end in a line feed.
///
/// A mark tells UTF-16. Bytes that are no UTF-8 stay as they are: names and comments may hold them, and so may formats
/// that are no text at all.
pub(super) fn plain(bytes: &[u8]) -> Cow<'_, [u8]> {
    lines(decoded(bytes))
}

/// The text in UTF-8, without its mark: the first keyword would be lost in it.
pub(super) fn decoded(bytes: &[u8]) -> Cow<'_, [u8]> {
    let from_units = |bytes: &[u8], unit: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = bytes.as_chunks().0.iter().map(|&pair| unit(pair)).collect();
        Cow::from(String::from_utf16_lossy(&units).into_bytes())
    };
    match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => rest.into(),
        [0xff, 0xfe, rest @ ..] => from_units(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => from_units(rest, u16::from_be_bytes),
        plain => plain.into(),
    }
}

/// The text with a line feed in the place of every carriage return that none follows.
pub(super) fn lines(mut text: Cow<'_, [u8]>) -> Cow<'_, [u8]> {
    let alone = |text: &[u8], at: usize| text[at] == b'\r' && text.get(at + 1) != Some(&b'\n');
    if (0..text.len()).any(|at| alone(&text, at)) {
        let text = text.to_mut();
        for at in 0..text.len() {
            if alone(text, at) {
                text[at] = b'\n';
            }
        }
    }
    text
}
