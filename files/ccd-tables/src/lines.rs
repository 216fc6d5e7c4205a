//! Converts line ends to `\n`, and drops byte order marks.

use std::io::{self, Read};

/// A reader that converts every line end (`\n`, `\r\n`, `\r`) to `\n`, so that lines can be counted, and drops byte order
/// marks at the start.
#[derive(Debug)]
pub(super) struct LineEndConverter<R> {
    input: io::Chain<io::Cursor<Vec<u8>>, R>,
    is_after_carriage_return: bool,
    /// The number of bytes read from the input.
    read_byte_count: u64,
    /// The number of dropped bytes: the bytes of byte order marks, and one byte for each `\r\n`.
    dropped_byte_count: u64,
    /// The greatest number of bytes that this reader gives in total.
    allowed_byte_count: u64,
}

const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

impl<R: Read> LineEndConverter<R> {
    /// Creates a reader of `input`, and reads past byte order marks at its start.
    ///
    /// # Errors
    /// The first bytes cannot be read.
    pub(super) fn new(mut input: R) -> io::Result<Self> {
        let (mut start, mut mark_byte_count) = (Vec::new(), 0);
        loop {
            // A read from a pipe may end within a mark.
            let mark_length = BYTE_ORDER_MARK.len() as u64;
            input.by_ref().take(mark_length).read_to_end(&mut start)?;
            if start != BYTE_ORDER_MARK {
                break;
            }
            mark_byte_count += mark_length;
            start.clear();
        }
        Ok(LineEndConverter {
            input: io::Cursor::new(start).chain(input),
            is_after_carriage_return: false,
            read_byte_count: mark_byte_count,
            dropped_byte_count: mark_byte_count,
            allowed_byte_count: u64::MAX,
        })
    }

    /// Limits the number of bytes that this reader gives in total. A read after that fails.
    pub(super) fn allow_up_to(&mut self, bytes: u64) {
        self.allowed_byte_count = bytes;
    }

    /// Returns the number of bytes that this reader has given so far.
    pub(super) fn output_byte_count(&self) -> u64 {
        self.read_byte_count - self.dropped_byte_count
    }

    /// Returns the number of input bytes for the first `output_bytes` bytes of this reader's output.
    pub(super) fn input_bytes_for_output(&self, output_bytes: u64) -> u64 {
        self.read_byte_count
            .min(output_bytes + self.dropped_byte_count)
    }
}

impl<R: Read> Read for LineEndConverter<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        if self.output_byte_count() > self.allowed_byte_count {
            let problem = "a row does not end within 16 MB; is this a table?";
            return Err(io::Error::new(io::ErrorKind::InvalidData, problem));
        }
        loop {
            let read_count = self.input.read(out)?;
            self.read_byte_count += read_count as u64;
            // Most tables have no `\r`, and a search for it is many times as fast as the loop below.
            if !self.is_after_carriage_return && !out[..read_count].contains(&b'\r') {
                return Ok(read_count);
            }
            let mut kept_count = 0;
            for k in 0..read_count {
                let (byte, is_second_of_pair) =
                    (out[k], self.is_after_carriage_return && out[k] == b'\n');
                self.is_after_carriage_return = byte == b'\r';
                if !is_second_of_pair {
                    out[kept_count] = if self.is_after_carriage_return {
                        b'\n'
                    } else {
                        byte
                    };
                    kept_count += 1;
                }
            }
            self.dropped_byte_count += (read_count - kept_count) as u64;
            // A read of 0 bytes would mean the end of the input.
            if kept_count > 0 || read_count == 0 {
                return Ok(kept_count);
            }
        }
    }
}
