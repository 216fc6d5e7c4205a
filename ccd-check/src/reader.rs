//! Reads numbers from bytes.

use crate::number::Vector;
use crate::{Stop, verifiable};

/// The bytes of a file, and how far they are read.
pub(crate) struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Reader<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Reader { bytes, at: 0 }
    }

    /// Returns what a file has after its name.
    pub(crate) fn after(name: &[u8; 8], bytes: &'a [u8]) -> Result<Self, Stop> {
        let mut reader = Reader::new(bytes);
        let is_name = reader.take(8)? == name;
        reader.require(is_name, "this is another kind of file")?;
        Ok(reader)
    }

    /// Requires that nothing is left.
    pub(crate) fn end(&self) -> Result<(), Stop> {
        self.require(self.at == self.bytes.len(), "the file goes on after its end")
    }

    /// Returns the verdict that the file is broken before the place that is read next.
    pub(crate) fn broken(&self, reason: &'static str) -> Stop {
        let at = self.at;
        Stop::Broken { reason, at }
    }

    pub(crate) fn require(&self, condition: bool, reason: &'static str) -> Result<(), Stop> {
        condition.then_some(()).ok_or(self.broken(reason))
    }

    pub(crate) fn take(&mut self, count: usize) -> Result<&'a [u8], Stop> {
        let rest = &self.bytes[self.at..];
        self.require(count <= rest.len(), "the file ends too early")?;
        self.at += count;
        Ok(&rest[..count])
    }

    /// Reads a number of so many bytes, at most 8, without a sign.
    pub(crate) fn unsigned(&mut self, count: usize) -> Result<u64, Stop> {
        let bytes = self.take(count)?.iter().rev();
        Ok(bytes.fold(0, |number, &byte| number << 8 | u64::from(byte)))
    }

    /// Reads a number of so many bytes, at most 7, in two's complement.
    pub(crate) fn signed(&mut self, count: usize) -> Result<i64, Stop> {
        let half = 1 << (8 * count - 1);
        Ok((self.unsigned(count)? as i64 ^ half) - half)
    }

    /// Reads the number of one of so many things, in 4 bytes.
    pub(crate) fn index(&mut self, count: usize) -> Result<usize, Stop> {
        let index = self.unsigned(4)? as usize;
        self.require(index < count, "there is nothing of this number")?;
        Ok(index)
    }

    /// Reads a binary64 as a multiple of 2 to the power of `unit` that has at most so many bits, rounded down.
    pub(crate) fn number(&mut self, unit: i64, bits: u32) -> Result<i64, Stop> {
        let all = self.unsigned(8)? as i64;
        let exponent = all >> 52 & 0x7ff;
        // A subnormal number has the exponent of the least normal ones, and no leading 1.
        let mantissa = all & ((1 << 52) - 1) | i64::from(exponent > 0) << 52;
        let mantissa = if all < 0 { -mantissa } else { mantissa };
        let shift = exponent.max(1) - 1075 - unit;
        let number = (mantissa << shift.clamp(0, 9)) >> (-shift).clamp(0, 60);
        let is_exact = exponent < 0x7ff && (shift <= 9 || mantissa == 0);
        verifiable(is_exact && number.unsigned_abs() <= 1 << bits, "a number is infinite, or too large in its unit")?;
        Ok(number)
    }

    /// Reads a binary64 that is not negative as a multiple that is larger, by at most one.
    pub(crate) fn size(&mut self, unit: i64, bits: u32) -> Result<i64, Stop> {
        let number = self.number(unit, bits)?;
        self.require(number >= 0, "a length or a time is negative")?;
        Ok(number + 1)
    }

    /// Reads three binary64.
    pub(crate) fn vector(&mut self, unit: i64, bits: u32) -> Result<Vector, Stop> {
        let [x, y, z] = [(); 3].map(|()| self.number(unit, bits));
        Ok([x?, y?, z?])
    }
}
