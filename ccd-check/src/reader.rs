//! Reads numbers from bytes.

use crate::number::Ball;
use crate::{Fault, Reason, Stop, Verdict};

/// The bytes of a file, and how far they are read.
pub(crate) struct Reader<'a> {
    bytes: &'a [u8],
    pub(crate) at: usize,
}

/// A number in IEEE 754's binary64: `mantissa` times 2 to the power of `exponent`.
#[derive(Clone, Copy)]
pub(crate) struct Binary64 {
    mantissa: i128,
    exponent: i32,
}

/// The largest number of bits of a coordinate in the unit of a certificate.
const MAX_BITS: i32 = 50;

impl<'a> Reader<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Reader { bytes, at: 0 }
    }

    /// Returns the verdict that something is wrong at the place that is read.
    pub(crate) fn broken<T>(&self, fault: Fault) -> Result<T, Stop> {
        Err(Verdict::Broken(fault, self.at))
    }

    pub(crate) fn array<const N: usize>(&mut self) -> Result<[u8; N], Stop> {
        match self.bytes[self.at..].first_chunk::<N>() {
            Some(bytes) => {
                self.at += N;
                Ok(*bytes)
            }
            None => self.broken(Fault::Format),
        }
    }

    pub(crate) fn require(&mut self, expected: &[u8; 8]) -> Result<(), Stop> {
        if self.array::<8>()? == *expected {
            Ok(())
        } else {
            self.broken(Fault::Format)
        }
    }

    pub(crate) fn u8(&mut self) -> Result<u8, Stop> {
        Ok(self.array::<1>()?[0])
    }

    pub(crate) fn u32(&mut self) -> Result<u32, Stop> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    pub(crate) fn i32(&mut self) -> Result<i32, Stop> {
        Ok(i32::from_le_bytes(self.array()?))
    }

    /// Reads three numbers of 16 bits.
    pub(crate) fn axis(&mut self) -> Result<[i128; 3], Stop> {
        let mut axis = [0; 3];
        for number in &mut axis {
            *number = i128::from(i16::from_le_bytes(self.array()?));
        }
        Ok(axis)
    }

    /// Reads three numbers of 32 bits.
    pub(crate) fn fine_axis(&mut self) -> Result<[i128; 3], Stop> {
        Ok([self.i32()?, self.i32()?, self.i32()?].map(i128::from))
    }

    pub(crate) fn binary64(&mut self) -> Result<Binary64, Stop> {
        let bits = u64::from_le_bytes(self.array()?);
        let (field, fraction) = ((bits >> 52 & 0x7ff) as i32, bits & ((1 << 52) - 1));
        if field == 0x7ff {
            return Err(Verdict::Unverifiable(Reason::Number));
        }
        let mantissa = i128::from(if field == 0 {
            fraction
        } else {
            fraction | 1 << 52
        });
        Ok(Binary64 {
            mantissa: if bits >> 63 == 1 { -mantissa } else { mantissa },
            exponent: field.max(1) - 1075,
        })
    }

    pub(crate) fn vector(&mut self) -> Result<[Binary64; 3], Stop> {
        Ok([self.binary64()?, self.binary64()?, self.binary64()?])
    }

    pub(crate) fn is_at_end(&self) -> bool {
        self.at == self.bytes.len()
    }
}

impl Binary64 {
    /// Converts the number to an integer in the unit of 2 to the power of `unit`, of at most `bits` bits.
    pub(crate) fn in_unit(self, unit: i32, bits: i32) -> Result<Ball, Stop> {
        let shift = i64::from(self.exponent) - i64::from(unit);
        let ball = match shift {
            _ if self.mantissa == 0 => Ball::ZERO,
            0..=60 => Ball::exact(self.mantissa << shift),
            61.. => return Err(Verdict::Unverifiable(Reason::Number)),
            // A shift to the right rounds down, by less than 1.
            _ => {
                let shift = (-shift).min(100);
                let mid = self.mantissa >> shift;
                let rad = i128::from(mid << shift != self.mantissa);
                Ball { mid, rad }
            }
        };
        if ball.size() <= 1 << bits {
            Ok(ball)
        } else {
            Err(Verdict::Unverifiable(Reason::Number))
        }
    }

    /// Converts a length.
    pub(crate) fn length(self, unit: i32) -> Result<Ball, Stop> {
        self.in_unit(unit, MAX_BITS)
    }

    pub(crate) fn is_negative(self) -> bool {
        self.mantissa < 0
    }
}
