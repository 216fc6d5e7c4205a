//! Converts line ends to `\n`.

use std::io::{self, Read};

/// A reader that converts every line end (`\n`, `\r\n`, `\r`) to `\n`, so that lines can be counted.
///
/// Its first read holds a byte order mark whole, and a byte more: `csv` takes no other for one, and pipes may cut
/// it.
#[derive(Debug)]
pub struct Lines<R> {
    input: R,
    after_carriage_return: bool,
    /// The number of bytes read from the input, and the number of those dropped: one for each `\r\n`.
    bytes: u64,
    left_out: u64,
}

impl<R: Read> Lines<R> {
    /// Creates a reader of `input`.
    pub fn new(input: R) -> Self {
        Lines {
            input,
            after_carriage_return: false,
            bytes: 0,
            left_out: 0,
        }
    }

    /// Returns the number of input bytes for the first `taken` bytes of this reader's output.
    pub fn input_bytes_for(&self, taken: u64) -> u64 {
        self.bytes.min(taken + self.left_out)
    }

    /// Reads some bytes of the input; the first call reads enough for a byte order mark.
    fn read_some(&mut self, out: &mut [u8]) -> io::Result<usize> {
        const BOM_LENGTH: usize = 3;
        let (start, least) = (self.bytes == 0, out.len().min(BOM_LENGTH + 1));
        let mut read = 0;
        loop {
            match self.input.read(&mut out[read..]) {
                Ok(0) => return Ok(read),
                Ok(more) => read += more,
                Err(error) if start && error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
            if !start || read >= least {
                return Ok(read);
            }
        }
    }
}

impl<R: Read> Read for Lines<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        loop {
            let read = self.read_some(out)?;
            self.bytes += read as u64;
            // Most tables have no `\r`, and a search for it is many times as fast as the loop below.
            if !self.after_carriage_return && !out[..read].contains(&b'\r') {
                return Ok(read);
            }
            let mut kept = 0;
            for k in 0..read {
                let (byte, second) = (out[k], self.after_carriage_return && out[k] == b'\n');
                self.after_carriage_return = byte == b'\r';
                if !second {
                    out[kept] = if self.after_carriage_return {
                        b'\n'
                    } else {
                        byte
                    };
                    kept += 1;
                }
            }
            self.left_out += (read - kept) as u64;
            // A read of 0 bytes would mean the end of the input.
            if kept > 0 || read == 0 {
                return Ok(kept);
            }
        }
    }
}
