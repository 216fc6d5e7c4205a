//! Decodes a column of a Parquet file to the texts of its cells.

use super::cell_kind::CellKind;
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::errors::ParquetError;
use std::io::Write;

/// A column of a row group, some of whose rows are decoded.
pub(super) struct ColumnTexts {
    reader: ColumnReader,
    kind: CellKind,
    /// The level of a value that is present; 0 in a column without absent values.
    present_level: i16,
    texts: Texts,
}

/// The texts of consecutive cells, one after another.
#[derive(Default)]
struct Texts {
    bytes: Vec<u8>,
    /// The end of each cell's text.
    ends: Vec<usize>,
}

impl ColumnTexts {
    /// Prepares to decode a column from its first row on.
    pub(super) fn new(reader: ColumnReader, kind: CellKind, present_level: i16) -> Self {
        ColumnTexts {
            reader,
            kind,
            present_level,
            texts: Texts::default(),
        }
    }

    /// Decodes the next `count` cells, in place of the cells decoded before.
    ///
    /// # Errors
    /// The column has fewer cells, or cannot be decoded.
    pub(super) fn decode(&mut self, count: usize) -> Result<(), ParquetError> {
        let (kind, level, texts) = (self.kind, self.present_level, &mut self.texts);
        match &mut self.reader {
            ColumnReader::BoolColumnReader(reader) => {
                texts.fill(reader, (count, level), |value, out| write!(out, "{value}"))
            }
            ColumnReader::Int32ColumnReader(reader) => {
                texts.fill(reader, (count, level), |&value, out| match kind {
                    CellKind::Plain => write!(out, "{value}"),
                    CellKind::Unsigned => write!(out, "{}", value as u32),
                    CellKind::Decimal { scale } => write_decimal(out, value.into(), scale),
                })
            }
            ColumnReader::Int64ColumnReader(reader) => {
                texts.fill(reader, (count, level), |&value, out| match kind {
                    CellKind::Plain => write!(out, "{value}"),
                    CellKind::Unsigned => write!(out, "{}", value as u64),
                    CellKind::Decimal { scale } => write_decimal(out, value.into(), scale),
                })
            }
            // A 32-bit number keeps its exact value; the shortest decimal number that rounds to it may differ.
            ColumnReader::FloatColumnReader(reader) => {
                texts.fill(reader, (count, level), |&value, out| {
                    write!(out, "{:?}", f64::from(value))
                })
            }
            ColumnReader::DoubleColumnReader(reader) => {
                texts.fill(reader, (count, level), |value, out| {
                    write!(out, "{value:?}")
                })
            }
            ColumnReader::ByteArrayColumnReader(reader) => {
                texts.fill(reader, (count, level), |value, out| {
                    write_text_or_decimal(out, value.data(), kind)
                })
            }
            ColumnReader::FixedLenByteArrayColumnReader(reader) => {
                texts.fill(reader, (count, level), |value, out| {
                    write_text_or_decimal(out, value.data(), kind)
                })
            }
            ColumnReader::Int96ColumnReader(_) => {
                Err(ParquetError::NYI("numbers of 96 bits".to_owned()))
            }
        }
    }

    /// Returns the text of a decoded cell, which is empty if its value is absent.
    pub(super) fn cell(&self, row: usize) -> &[u8] {
        let before = row.checked_sub(1);
        let start = before.map_or(0, |before| self.texts.ends[before]);
        &self.texts.bytes[start..self.texts.ends[row]]
    }
}

impl Texts {
    /// Reads the next `count` cells, of which those with the given level have values, and writes the text of each.
    fn fill<T: DataType>(
        &mut self,
        reader: &mut ColumnReaderImpl<T>,
        (count, present_level): (usize, i16),
        mut write: impl FnMut(&T::T, &mut Vec<u8>) -> std::io::Result<()>,
    ) -> Result<(), ParquetError> {
        self.bytes.clear();
        self.ends.clear();
        let (mut levels, mut values) = (Vec::new(), Vec::new());
        let (read_count, ..) = reader.read_records(count, Some(&mut levels), None, &mut values)?;
        // Columns without absent values have no levels.
        if present_level == 0 {
            levels = vec![0; read_count];
        }
        let mut values = values.iter();
        for &level in &levels {
            if level == present_level {
                let value = values.next().ok_or_else(missing_values)?;
                write(value, &mut self.bytes)?;
            }
            self.ends.push(self.bytes.len());
        }
        if self.ends.len() == count && values.next().is_none() {
            Ok(())
        } else {
            Err(missing_values())
        }
    }
}

fn missing_values() -> ParquetError {
    ParquetError::EOF("the number of values is not the number of rows".to_owned())
}

/// The greatest length in bytes of a cell's text. A dictionary stores a text once for many rows, and each row gets a copy:
/// without a limit, a small file could fill the memory.
const MAX_TEXT_BYTES: usize = 1 << 16;

/// Writes text, or the decimal number that big-endian bytes hold.
fn write_text_or_decimal(out: &mut Vec<u8>, bytes: &[u8], kind: CellKind) -> std::io::Result<()> {
    let CellKind::Decimal { scale } = kind else {
        if bytes.len() > MAX_TEXT_BYTES {
            let problem = format!(
                "a text of {} bytes; the longest that is read has {MAX_TEXT_BYTES}",
                bytes.len()
            );
            return Err(std::io::Error::other(problem));
        }
        return out.write_all(bytes);
    };
    let mut padded_bytes = [if is_negative(bytes) { 0xff } else { 0 }; 16];
    let Some(padding_length) = padded_bytes.len().checked_sub(bytes.len()) else {
        return Err(std::io::Error::other("a decimal of more than 128 bits"));
    };
    padded_bytes[padding_length..].copy_from_slice(bytes);
    write_decimal(out, i128::from_be_bytes(padded_bytes), scale)
}

fn is_negative(big_endian: &[u8]) -> bool {
    big_endian.first().is_some_and(|&byte| byte >= 0x80)
}

/// Writes a whole number of units of 10^-scale with all its decimals, such as 1.50.
fn write_decimal(out: &mut Vec<u8>, units: i128, scale: u32) -> std::io::Result<()> {
    let sign = if units < 0 { "-" } else { "" };
    let width = scale as usize + 1;
    let digits = format!("{:0>width$}", units.unsigned_abs());
    let (whole, decimals) = digits.split_at(digits.len() - scale as usize);
    match decimals {
        "" => write!(out, "{sign}{whole}"),
        _ => write!(out, "{sign}{whole}.{decimals}"),
    }
}
