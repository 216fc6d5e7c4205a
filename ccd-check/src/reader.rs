//! Reads numbers from bytes.

use crate::number::{Number, Vector};
use crate::{Fault, Stop};

/// The bytes of a file, and how far they are read.
pub(crate) struct Reader<'a> {
    pub(crate) bytes: &'a [u8],
    pub(crate) at: usize,
}

impl<'a> Reader<'a> {
    /// Returns the verdict that something is wrong at the place that is read.
    pub(crate) fn broken<T>(&self, fault: Fault) -> Result<T, Stop> {
        Err(Stop::Broken(fault, self.at))
    }

    pub(crate) fn take(&mut self, count: usize) -> Result<&'a [u8], Stop> {
        let Some(taken) = self.bytes.get(self.at..self.at + count) else {
            return self.broken(Fault::Format);
        };
        self.at += count;
        Ok(taken)
    }

    pub(crate) fn require(&mut self, expected: &[u8], fault: Fault) -> Result<(), Stop> {
        if self.take(expected.len())? == expected {
            Ok(())
        } else {
            self.broken(fault)
        }
    }

    pub(crate) fn require_end(&self) -> Result<(), Stop> {
        if self.at == self.bytes.len() {
            Ok(())
        } else {
            self.broken(Fault::Format)
        }
    }

    /// Reads a number of so many bytes, without a sign.
    pub(crate) fn unsigned(&mut self, count: usize) -> Result<i128, Stop> {
        let bytes = self.take(count)?.iter().rev();
        Ok(bytes.fold(0, |number, &byte| number << 8 | i128::from(byte)))
    }

    /// Reads a number of so many bytes in two's complement.
    pub(crate) fn signed(&mut self, count: usize) -> Result<i128, Stop> {
        let number = self.unsigned(count)?;
        let half = 1 << (8 * count - 1);
        Ok((number ^ half) - half)
    }

    /// Reads three numbers of so many bytes in two's complement.
    pub(crate) fn axis(&mut self, count: usize) -> Result<[i128; 3], Stop> {
        Ok([
            self.signed(count)?,
            self.signed(count)?,
            self.signed(count)?,
        ])
    }

    /// Reads a binary64, as a multiple of 2 to the power of `unit` that has at most so many bits. What is between two multiples
    /// is rounded down.
    pub(crate) fn number(&mut self, unit: i128, bits: i128, fault: Fault) -> Result<Number, Stop> {
        let all = self.unsigned(8)?;
        let (sign, field, fraction) = (all >> 63, all >> 52 & 0x7ff, all & ((1 << 52) - 1));
        // A subnormal number has the exponent of the least normal ones, and no leading 1.
        let mantissa = if field == 0 {
            fraction
        } else {
            fraction | 1 << 52
        };
        let mantissa = if sign == 1 { -mantissa } else { mantissa };
        let shift = field.max(1) - 1075 - unit;
        let number = match shift {
            _ if mantissa == 0 => Number::exact([0]),
            0..=60 => Number::exact([mantissa << shift]),
            ..0 => Number {
                mid: [mantissa >> (-shift).min(100)],
                rad: 1,
            },
            _ => return Err(Stop::Unverifiable(fault)),
        };
        let is_in_range = field != 0x7ff && number.size() <= 1 << bits;
        if is_in_range {
            Ok(number)
        } else {
            Err(Stop::Unverifiable(fault))
        }
    }

    /// Reads three binary64.
    pub(crate) fn vector(&mut self, unit: i128, bits: i128, fault: Fault) -> Result<Vector, Stop> {
        let [x, y, z] = [(); 3].map(|()| self.number(unit, bits, fault));
        let (x, y, z) = (x?, y?, z?);
        let rad = x.rad.max(y.rad).max(z.rad);
        Ok(Vector {
            mid: [x.mid[0], y.mid[0], z.mid[0]],
            rad,
        })
    }
}
