//! Detects unclosed quotes in CSV, which would turn the rest of the table into one cell.

#[cfg(test)]
mod tests;

use std::io::{self, Read};

/// A reader that passes CSV through and tracks its quotes; lines must end in `\n`.
#[derive(Debug)]
pub struct QuoteTracker<R> {
    input: R,
    state: QuoteState,
    /// The current line, counted from 1.
    line: u64,
    /// The line on which the last quoted cell began.
    quote_line: u64,
}

/// The state of the reader between two bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum QuoteState {
    /// The next byte is the first of a cell, the only place where a quote opens.
    CellStart,
    /// The next byte is within a cell without quotes, or after the closing quote.
    Unquoted,
    /// The next byte is between quotes.
    Quoted,
    /// The last byte was a quote that closes the cell unless another quote follows.
    AfterClosingQuote,
}

impl<R> QuoteTracker<R> {
    /// Creates a reader of `input`, which starts at the table's first line.
    pub fn new(input: R) -> Self {
        QuoteTracker {
            input,
            state: QuoteState::CellStart,
            line: 1,
            quote_line: 0,
        }
    }

    /// Returns the reader from which this one reads.
    pub fn input(&self) -> &R {
        &self.input
    }

    /// Returns the line of an unclosed quote, after a record that ends before `line`; `None` if no quote is open.
    ///
    /// Such a record has closed its quotes. An open quote belongs to a later record, on a later line,
    /// unless the record ended with the table.
    pub fn open_quote_line(&self, line: u64) -> Option<u64> {
        (self.state == QuoteState::Quoted && self.quote_line < line).then_some(self.quote_line)
    }

    fn track_byte(&mut self, byte: u8) {
        self.state = match (self.state, byte) {
            (QuoteState::CellStart, b'"') => {
                self.quote_line = self.line;
                QuoteState::Quoted
            }
            (QuoteState::AfterClosingQuote, b'"') => QuoteState::Quoted,
            (QuoteState::Quoted, b'"') => QuoteState::AfterClosingQuote,
            (QuoteState::Quoted, _) => QuoteState::Quoted,
            (_, b',' | b'\n') => QuoteState::CellStart,
            _ => QuoteState::Unquoted,
        };
        self.line += u64::from(byte == b'\n');
    }
}

impl<R: Read> Read for QuoteTracker<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let read = self.input.read(out)?;
        let mut bytes = &out[..read];
        let within_quotes = matches!(
            self.state,
            QuoteState::Quoted | QuoteState::AfterClosingQuote
        );
        // Most tables have no quotes, and a search for them is many times as fast as tracking each byte.
        if !within_quotes && !bytes.contains(&b'"') {
            let Some((_, before)) = bytes.split_last() else {
                return Ok(0);
            };
            // The state after the last byte depends only on that byte.
            self.line += before.iter().filter(|&&byte| byte == b'\n').count() as u64;
            bytes = &bytes[before.len()..];
        }
        for &byte in bytes {
            self.track_byte(byte);
        }
        Ok(read)
    }
}
