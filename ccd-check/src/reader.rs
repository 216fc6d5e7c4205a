//! Reads numbers from bytes.

use crate::Stop;
use crate::number::{Number, Vector};

/// The bytes of a file, and how far they are read.
#[derive(Clone)]
pub(crate) struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Reader<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Reader { bytes, at: 0 }
    }

    /// Requires that the file begins with a name.
    pub(crate) fn name(&mut self, name: &[u8; 8]) -> Result<(), Stop> {
        let is_name = self.take(8)? == name;
        self.require(is_name, "this is another kind of file")
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

    /// Reads three numbers of so many bytes in two's complement.
    pub(crate) fn axis(&mut self, count: usize) -> Result<[i64; 3], Stop> {
        let [x, y, z] = [(); 3].map(|()| self.signed(count));
        Ok([x?, y?, z?])
    }

    /// Reads the number of one of so many things, in 4 bytes.
    pub(crate) fn index(&mut self, count: usize) -> Result<usize, Stop> {
        let index = self.unsigned(4)? as usize;
        self.require(index < count, "there is nothing of this number")?;
        Ok(index)
    }

    /// Reads a binary64 as a multiple of 2 to the power of `unit` that has at most so many bits. What is between two multiples
    /// is rounded down.
    pub(crate) fn number(&mut self, unit: i64, bits: u32) -> Result<Number, Stop> {
        let all = self.unsigned(8)? as i64;
        let exponent = all >> 52 & 0x7ff;
        // A subnormal number has the exponent of the least normal ones, and no leading 1.
        let mantissa = all & ((1 << 52) - 1) | i64::from(exponent > 0) << 52;
        let mantissa = if all < 0 { -mantissa } else { mantissa };
        let shift = exponent.max(1) - 1075 - unit;
        let (mantissa, dropped) = (mantissa << shift.clamp(0, 9), (-shift).clamp(0, 60));
        let mid = mantissa >> dropped;
        let number = Number { mid: [mid], rad: i64::from(mid << dropped != mantissa) };
        let is_finite = exponent < 0x7ff && (shift <= 9 || mantissa == 0);
        if is_finite && number.size() <= 1 << bits {
            Ok(number)
        } else {
            Err(Stop::Unverifiable("a number is infinite, or too large in its unit"))
        }
    }

    /// Reads a binary64 that is not negative, rounded up to a multiple.
    pub(crate) fn size(&mut self, unit: i64, bits: u32) -> Result<i64, Stop> {
        let number = self.number(unit, bits)?;
        self.require(number.mid[0] >= 0, "a length or a time is negative")?;
        Ok(number.size())
    }

    /// Reads three binary64.
    pub(crate) fn vector(&mut self, unit: i64, bits: u32) -> Result<Vector, Stop> {
        let [x, y, z] = [(); 3].map(|()| self.number(unit, bits));
        Ok(Vector::of([x?, y?, z?]))
    }
}
