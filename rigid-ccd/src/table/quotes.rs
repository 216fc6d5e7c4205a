//! Quotes of a table that nobody closes: all that follows would be one cell.

#[cfg(test)]
mod tests;

use std::io::{self, Read};

/// Hands a CSV on as it is, and follows its quotes; lines have to end in `\n`.
#[derive(Debug)]
pub struct Quotes<R> {
    input: R,
    state: State,
    /// The line that is being read, counted from 1.
    line: u64,
    /// The line on which the last quoted cell began.
    opened: u64,
    /// How many bytes of a byte order mark have been seen; none are looked for behind its place.
    mark: Option<usize>,
}

/// Where in a cell the next byte is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// At its first byte: a quote opens here alone.
    Start,
    /// Within one that has no quotes, or behind them.
    Plain,
    /// Between quotes.
    Quoted,
    /// Behind a quote, which closes the cell unless another one follows.
    Closing,
}

const MARK: [u8; 3] = *b"\xef\xbb\xbf";

impl<R> Quotes<R> {
    /// Reads from there.
    pub fn new(input: R) -> Self {
        Quotes {
            input,
            state: State::Start,
            line: 1,
            opened: 0,
            mark: Some(0),
        }
    }

    /// What is read from.
    pub fn input(&self) -> &R {
        &self.input
    }

    /// The line on which a quote opens that nobody closes, asked behind a record that ends before
    /// `line`.
    ///
    /// Such a record has closed its quotes. What is open is in a later one, on a line that is yet to come,
    /// unless the record ended because the table did.
    pub fn unclosed(&self, line: u64) -> Option<u64> {
        (self.state == State::Quoted && self.opened < line).then_some(self.opened)
    }

    fn follow(&mut self, byte: u8) {
        if let Some(seen) = self.mark {
            let goes_on = MARK.get(seen) == Some(&byte);
            self.mark = goes_on.then_some(seen + 1);
            if goes_on {
                return;
            }
        }
        self.state = match (self.state, byte) {
            (State::Start, b'"') => {
                self.opened = self.line;
                State::Quoted
            }
            (State::Closing, b'"') => State::Quoted,
            (State::Quoted, b'"') => State::Closing,
            (State::Quoted, _) => State::Quoted,
            (_, b',' | b'\n') => State::Start,
            _ => State::Plain,
        };
        self.line += u64::from(byte == b'\n');
    }
}

impl<R: Read> Read for Quotes<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let read = self.input.read(out)?;
        for &byte in &out[..read] {
            self.follow(byte);
        }
        Ok(read)
    }
}
