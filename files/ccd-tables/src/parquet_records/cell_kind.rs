//! The kinds of values in the columns of a Parquet file, and which of them a table may have.

use parquet::basic::{ConvertedType, LogicalType, Type};
use parquet::schema::types::ColumnDescriptor;

/// How the stored values of a column become text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CellKind {
    /// As they are: numbers, text or booleans.
    Plain,
    /// As whole numbers without a sign, which are stored in integers with a sign.
    Unsigned,
    /// As whole numbers in units of a power of ten.
    Decimal {
        /// The number of digits after the decimal point.
        scale: u32,
    },
}

impl CellKind {
    /// Returns the kind of a column.
    ///
    /// # Errors
    /// The type of the column as text, if its values are no numbers, texts or booleans.
    pub(super) fn of(column: &ColumnDescriptor) -> Result<Self, String> {
        if column.path().parts().len() != 1 || column.max_rep_level() > 0 {
            return Err("lists or structs".to_owned());
        }
        let stored = column.physical_type();
        match (column.logical_type_ref(), column.converted_type(), stored) {
            (_, _, Type::INT96)
            | (Some(LogicalType::Timestamp(_)), _, _)
            | (_, ConvertedType::TIMESTAMP_MICROS | ConvertedType::TIMESTAMP_MILLIS, _) => {
                Err("timestamps".to_owned())
            }
            (Some(LogicalType::Time(_)), _, _)
            | (_, ConvertedType::TIME_MICROS | ConvertedType::TIME_MILLIS, _) => {
                Err("times of day".to_owned())
            }
            (_, ConvertedType::DATE, _) => Err("dates".to_owned()),
            (Some(LogicalType::Float16), _, _) => Err("floats of 16 bits".to_owned()),
            (_, ConvertedType::DECIMAL, _) => match u32::try_from(column.type_scale()) {
                Ok(scale) if scale <= MAX_SCALE => Ok(CellKind::Decimal { scale }),
                _ => Err(format!("decimals of scale {}", column.type_scale())),
            },
            (_, ConvertedType::UINT_8 | ConvertedType::UINT_16, _)
            | (_, ConvertedType::UINT_32 | ConvertedType::UINT_64, _) => Ok(CellKind::Unsigned),
            (_, ConvertedType::NONE, Type::FIXED_LEN_BYTE_ARRAY)
            | (_, ConvertedType::INTERVAL | ConvertedType::BSON, _) => Err("bytes".to_owned()),
            (_, ConvertedType::NONE, Type::BYTE_ARRAY) => match column.logical_type_ref() {
                // Old writers do not mark text as such.
                None => Ok(CellKind::Plain),
                Some(_) => Err("bytes".to_owned()),
            },
            _ => Ok(CellKind::Plain),
        }
    }
}

/// The most digits of a decimal of 128 bits.
const MAX_SCALE: u32 = 38;
