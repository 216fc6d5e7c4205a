//! Reads whole numbers in JSON, which may be written with a zero fraction or an exponent: 1.0 is 1.

use serde::de::{Deserialize, Deserializer, Error, Unexpected, Visitor};
use std::fmt;
use std::marker::PhantomData;

/// Deserializes a required whole number.
pub(super) fn required<'de, D: Deserializer<'de>, T: TryFrom<u64>>(from: D) -> Result<T, D::Error> {
    Whole::deserialize(from).map(|Whole(number)| number)
}

/// Deserializes an optional whole number.
pub(super) fn optional<'de, D: Deserializer<'de>, T: TryFrom<u64>>(
    from: D,
) -> Result<Option<T>, D::Error> {
    let number = Option::<Whole<T>>::deserialize(from)?;
    Ok(number.map(|Whole(number)| number))
}

/// Deserializes a list of whole numbers.
pub(super) fn list<'de, D: Deserializer<'de>, T: TryFrom<u64>>(
    from: D,
) -> Result<Vec<T>, D::Error> {
    let numbers = Vec::<Whole<T>>::deserialize(from)?.into_iter();
    Ok(numbers.map(|Whole(number)| number).collect())
}

struct Whole<T>(T);

impl<'de, T: TryFrom<u64>> Deserialize<'de> for Whole<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(WholeNumberVisitor(PhantomData))
    }
}

struct WholeNumberVisitor<T>(PhantomData<T>);

/// The number 2⁵³, from which on f64 does not represent every whole number.
const FIRST_INEXACT: f64 = (1_u64 << 53) as f64;

impl<T: TryFrom<u64>> Visitor<'_> for WholeNumberVisitor<T> {
    type Value = Whole<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a whole number from 0 on")
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Self::Value, E> {
        let unexpected = |_| E::invalid_value(Unexpected::Unsigned(number), &self);
        T::try_from(number).map(Whole).map_err(unexpected)
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Self::Value, E> {
        Err(E::invalid_value(Unexpected::Signed(number), &self))
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Self::Value, E> {
        if number.fract() == 0.0 && (0.0..FIRST_INEXACT).contains(&number) {
            self.visit_u64(number as u64)
        } else {
            Err(E::invalid_value(Unexpected::Float(number), &self))
        }
    }
}
