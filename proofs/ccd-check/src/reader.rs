//! Reads numbers from the bytes of a file.

use crate::{Checked, Stop, verifiable};

/// The bytes of a file, and the position of the next byte to read.
pub(crate) struct Reader<'a> {
    bytes: &'a [u8],
    position: usize,
}

impl<'a> Reader<'a> {
    /// Returns a reader of a file, after checking that its first bytes are `signature`.
    pub(crate) fn new(signature: &[u8], bytes: &'a [u8]) -> Checked<Self> {
        let mut reader = Reader { bytes, position: 0 };
        let has_signature = reader.take(signature.len())? == signature;
        reader.require(has_signature, "this is a file of another kind")?;
        Ok(reader)
    }

    /// Checks that all bytes are read.
    pub(crate) fn end(&self) -> Checked<()> {
        self.require(self.position == self.bytes.len(), "the file has bytes after its end")
    }

    /// Returns the error that the file is broken before the current position.
    pub(crate) fn broken(&self, reason: &'static str) -> Stop {
        Stop::Broken(reason, self.position)
    }

    /// Returns an error that the file is broken if the condition is false.
    pub(crate) fn require(&self, condition: bool, reason: &'static str) -> Checked<()> {
        condition.then_some(()).ok_or(self.broken(reason))
    }

    /// Reads the next `count` bytes.
    pub(crate) fn take(&mut self, count: usize) -> Checked<&'a [u8]> {
        let taken = self.bytes[self.position..].get(..count).ok_or(self.broken("the file ends too early"))?;
        self.position += count;
        Ok(taken)
    }

    /// Reads an array of `N` items, each with `f`.
    pub(crate) fn array<T: Copy + Default, const N: usize>(&mut self, f: impl Fn(&mut Self) -> Checked<T>) -> Checked<[T; N]> {
        let mut array = [T::default(); N];
        for item in &mut array {
            *item = f(self)?;
        }
        Ok(array)
    }

    /// Reads an unsigned number of `count` bytes, at most 8.
    pub(crate) fn unsigned(&mut self, count: usize) -> Checked<u64> {
        let mut number = [0; 8];
        number[..count].copy_from_slice(self.take(count)?);
        Ok(u64::from_le_bytes(number))
    }

    /// Reads a signed number of `count` bytes, at most 7, in two's complement.
    pub(crate) fn signed(&mut self, count: usize) -> Checked<i64> {
        let shift = 64 - 8 * count;
        Ok((self.unsigned(count)? as i64) << shift >> shift)
    }

    /// Reads an index below `count`, of 4 bytes.
    pub(crate) fn index(&mut self, count: usize) -> Checked<usize> {
        let index = self.unsigned(4)? as usize;
        self.require(index < count, "an index is out of range").map(|()| index)
    }

    /// Reads a binary64, and rounds it down to a fixed-point number in the unit 2 to the power of `unit`. The result has at most
    /// `bits` bits before the binary point, and `after` bits after it.
    pub(crate) fn number(&mut self, unit: i64, [bits, after]: [u32; 2]) -> Checked<i64> {
        let binary64 = self.unsigned(8)? as i64;
        let exponent = binary64 >> 52 & 0x7ff;
        // A subnormal number has the exponent of the smallest normal numbers, and no leading 1.
        let mantissa = (binary64 & ((1 << 52) - 1) | i64::from(exponent > 0) << 52) * (binary64 >> 63 | 1);
        let shift = exponent.max(1) - 1075 - unit + i64::from(after);
        let number = (mantissa << shift.clamp(0, 9)) >> (-shift).clamp(0, 60);
        let fits = exponent < 0x7ff && (shift <= 9 || mantissa == 0);
        verifiable(fits && number.unsigned_abs() <= 1 << (bits + after), "a number is not finite, or too large in its unit")?;
        Ok(number)
    }

    /// Reads a non-negative binary64, and rounds it up by at most 1.
    pub(crate) fn magnitude(&mut self, unit: i64, bits: [u32; 2]) -> Checked<i64> {
        let number = self.number(unit, bits)?;
        self.require(number >= 0, "a length or a time is negative").map(|()| number + 1)
    }
}
