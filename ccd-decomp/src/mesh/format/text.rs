//! Decodes texts: character encodings and line endings.

use std::borrow::Cow;

/// Converts a text to UTF-8 with line feeds, without a byte order mark.
///
/// UTF-16 is recognised by its mark. Invalid UTF-8 is kept: names, comments and binary formats may hold it.
pub(super) fn to_utf8_with_lf(bytes: &[u8]) -> Cow<'_, [u8]> {
    lone_cr_to_lf(to_utf8(bytes))
}

/// Converts a text to UTF-8 and removes the byte order mark, which would hide the first keyword.
pub(super) fn to_utf8(bytes: &[u8]) -> Cow<'_, [u8]> {
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

/// Replaces every carriage return without a following line feed by a line feed.
pub(super) fn lone_cr_to_lf(mut text: Cow<'_, [u8]>) -> Cow<'_, [u8]> {
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
