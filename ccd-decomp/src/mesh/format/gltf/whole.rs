//! Reads whole numbers in JSON, which may be written with a zero fraction or an exponent: 1.0 is 1.

use serde::de::{Deserialize, Deserializer, Error, Unexpected};
use serde_json::Value;

/// Deserializes a required whole number, which may be written like 1.0 or 1e0.
pub(super) fn required_whole_number<'de, D: Deserializer<'de>, T: TryFrom<u64>>(
    from: D,
) -> Result<T, D::Error> {
    to_whole_number(&Value::deserialize(from)?)
}

/// Deserializes an optional whole number, which may be written like 1.0 or 1e0.
pub(super) fn optional_whole_number<'de, D: Deserializer<'de>, T: TryFrom<u64>>(
    from: D,
) -> Result<Option<T>, D::Error> {
    let number = Option::<Value>::deserialize(from)?;
    number.as_ref().map(to_whole_number).transpose()
}

/// Deserializes a list of whole numbers, which may be written like 1.0 or 1e0.
pub(super) fn whole_number_list<'de, D: Deserializer<'de>, T: TryFrom<u64>>(
    from: D,
) -> Result<Vec<T>, D::Error> {
    Vec::<Value>::deserialize(from)?
        .iter()
        .map(to_whole_number)
        .collect()
}

/// The number 2⁵³, from which on f64 does not represent every whole number.
const EXACT_INTEGER_LIMIT: f64 = (1_u64 << 53) as f64;

fn to_whole_number<T: TryFrom<u64>, E: Error>(value: &Value) -> Result<T, E> {
    let is_whole =
        |number: &f64| number.fract() == 0.0 && (0.0..EXACT_INTEGER_LIMIT).contains(number);
    let of_float = || value.as_f64().filter(is_whole).map(|number| number as u64);
    let number = value.as_u64().or_else(of_float);
    let number = number.and_then(|number| T::try_from(number).ok());
    number.ok_or_else(|| {
        let text = value.to_string();
        let unexpected = match (value.as_i64(), value.as_f64()) {
            (Some(number), _) => Unexpected::Signed(number),
            (None, Some(number)) => Unexpected::Float(number),
            (None, None) => Unexpected::Other(&text),
        };
        E::invalid_value(unexpected, &"a whole number from 0 on")
    })
}
