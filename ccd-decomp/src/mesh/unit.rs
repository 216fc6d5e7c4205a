//! Units of length, and conversions between them.

use ccd_core::glam::DVec3;
use std::fmt;
use std::str::FromStr;

/// A unit of length in which the coordinates of a mesh can be given.
///
/// ```
/// use ccd_decomp::Unit;
/// assert_eq!("mm".parse(), Ok(Unit::Millimetre));
/// assert_eq!(Unit::Inch.to_string(), "in");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unit {
    /// Micrometre, `um`: a millionth of a metre.
    Micrometre,
    /// Millimetre, `mm`: a thousandth of a metre.
    Millimetre,
    /// Centimetre, `cm`: a hundredth of a metre.
    Centimetre,
    /// Metre, `m`.
    Metre,
    /// Inch, `in`: 25.4 millimetres.
    Inch,
    /// Foot, `ft`: twelve inches.
    Foot,
}

/// The error for a text that is no unit of length.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no unit {name:?}; use um, mm, cm, m, in or ft")]
pub struct UnknownUnit {
    /// The text that was read as the name of a unit.
    pub name: String,
}

impl Unit {
    /// All units, in the order in which messages list them.
    pub const ALL: [Unit; 6] = [
        Unit::Micrometre,
        Unit::Millimetre,
        Unit::Centimetre,
        Unit::Metre,
        Unit::Inch,
        Unit::Foot,
    ];

    /// Returns the symbol of the unit in ASCII: `um`, `mm`, `cm`, `m`, `in`, `ft`.
    pub fn symbol(self) -> &'static str {
        self.symbol_and_micrometres().0
    }

    /// Returns the symbol of the unit, and its length in micrometres, a whole number for all units.
    fn symbol_and_micrometres(self) -> (&'static str, u32) {
        match self {
            Unit::Micrometre => ("um", 1),
            Unit::Millimetre => ("mm", 1_000),
            Unit::Centimetre => ("cm", 10_000),
            Unit::Metre => ("m", 1_000_000),
            Unit::Inch => ("in", 25_400),
            Unit::Foot => ("ft", 304_800),
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.symbol())
    }
}

impl FromStr for Unit {
    type Err = UnknownUnit;

    fn from_str(text: &str) -> Result<Self, UnknownUnit> {
        let named = Unit::ALL.into_iter().find(|unit| unit.symbol() == text);
        named.ok_or_else(|| UnknownUnit { name: text.into() })
    }
}

/// A conversion of coordinates between units: a multiplication by a whole number, then a division by a whole number.
///
/// Between metric units one of the two numbers is 1, so that a coordinate is rounded once. A 32-bit float converts
/// exactly to a smaller metric unit: the product with a power of ten up to 1e6 has at most 38 bits. Between metric
/// units and inches or feet a coordinate is rounded up to twice.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnitConversion {
    numerator: f64,
    denominator: f64,
}

impl UnitConversion {
    pub(crate) fn new(from: Unit, to: Unit) -> Self {
        let [from, to] = [from, to].map(|unit| unit.symbol_and_micrometres().1);
        let common = greatest_common_divisor(from, to);
        UnitConversion {
            numerator: f64::from(from / common),
            denominator: f64::from(to / common),
        }
    }

    /// Converts a point to the new unit. The result is exact if the units are equal.
    pub(crate) fn apply(self, point: DVec3) -> DVec3 {
        point * self.numerator / self.denominator
    }
}

fn greatest_common_divisor(mut a: u32, mut b: u32) -> u32 {
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a
}

#[cfg(test)]
mod tests;
