//! Quotes texts of files in messages.

use std::fmt;

/// Displays the beginning of a text from a file, with its length if that is not all.
#[derive(Clone, Copy)]
pub struct Excerpt<'a>(pub &'a str);

/// The greatest number of characters of a text that a message quotes.
const MAX_QUOTED_CHARS: usize = 60;

impl fmt::Display for Excerpt<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Excerpt(text) = *self;
        match text.char_indices().nth(MAX_QUOTED_CHARS) {
            Some((end, _)) => write!(f, "{}… ({} bytes)", &text[..end], text.len()),
            None => f.write_str(text),
        }
    }
}

#[cfg(test)]
mod tests;
