//! Reads numbers from bytes.

use crate::{Checked, Stop, verifiable};

/// The bytes of a file, and how far they are read.
pub(crate) struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Reader<'a> {
    /// Reads a file that begins with its name.
    pub(crate) fn new(name: &[u8], bytes: &'a [u8]) -> Checked<Self> {
        let mut reader = Reader { bytes, at: 0 };
        let is_name = reader.take(name.len())? == name;
        reader.require(is_name, "this is another kind of file")?;
        Ok(reader)
    }

    /// Requires that nothing is left.
    pub(crate) fn end(&self) -> Checked<()> {
        self.require(self.at == self.bytes.len(), "the file goes on after its end")
    }

    /// Returns the verdict that the file is broken before the place that is read next.
    pub(crate) fn broken(&self, reason: &'static str) -> Stop {
        Stop::Broken(reason, self.at)
    }

    pub(crate) fn require(&self, condition: bool, reason: &'static str) -> Checked<()> {
        condition.then_some(()).ok_or(self.broken(reason))
    }

    pub(crate) fn take(&mut self, count: usize) -> Checked<&'a [u8]> {
        let taken = self.bytes[self.at..].get(..count).ok_or(self.broken("the file ends too early"))?;
        self.at += count;
        Ok(taken)
    }

    /// Reads an array, one after the other.
    pub(crate) fn all<T: Copy + Default, const N: usize>(&mut self, one: impl Fn(&mut Self) -> Checked<T>) -> Checked<[T; N]> {
        let mut all = [T::default(); N];
        for item in &mut all {
            *item = one(self)?;
        }
        Ok(all)
    }

    /// Reads a number of so many bytes, at most 8, without a sign.
    pub(crate) fn unsigned(&mut self, count: usize) -> Checked<u64> {
        let mut number = [0; 8];
        number[..count].copy_from_slice(self.take(count)?);
        Ok(u64::from_le_bytes(number))
    }

    /// Reads a number of so many bytes, at most 7, in two's complement.
    pub(crate) fn signed(&mut self, count: usize) -> Checked<i64> {
        let rest = 64 - 8 * count;
        Ok((self.unsigned(count)? as i64) << rest >> rest)
    }

    /// Reads the number of one of so many things, in 4 bytes.
    pub(crate) fn index(&mut self, count: usize) -> Checked<usize> {
        let index = self.unsigned(4)? as usize;
        self.require(index < count, "there is nothing of this number").map(|()| index)
    }

    /// Reads a binary64, rounded down to a number of so many bits in a unit, which is a power of two, and so many bits after it.
    pub(crate) fn number(&mut self, unit: i64, [bits, after]: [u32; 2]) -> Checked<i64> {
        let all = self.unsigned(8)? as i64;
        let exponent = all >> 52 & 0x7ff;
        // A subnormal number has the exponent of the least normal ones, and no leading 1.
        let mantissa = (all & ((1 << 52) - 1) | i64::from(exponent > 0) << 52) * (all >> 63 | 1);
        let shift = exponent.max(1) - 1075 - unit + i64::from(after);
        let number = (mantissa << shift.clamp(0, 9)) >> (-shift).clamp(0, 60);
        let is_exact = exponent < 0x7ff && (shift <= 9 || mantissa == 0);
        verifiable(is_exact && number.unsigned_abs() <= 1 << (bits + after), "a number is infinite, or too large in its unit")?;
        Ok(number)
    }

    /// Reads a binary64 that is not negative, rounded up by at most one.
    pub(crate) fn size(&mut self, unit: i64, bits: [u32; 2]) -> Checked<i64> {
        let number = self.number(unit, bits)?;
        self.require(number >= 0, "a length or a time is negative").map(|()| number + 1)
    }
}
