//! The pickled form of a table: an Arrow stream of one batch.

use crate::errors::input_error as refuse;
use arrow_array::RecordBatch;
use arrow_buffer::Buffer;
use arrow_ipc::reader::StreamDecoder;
use arrow_ipc::writer::StreamWriter;
use pyo3::prelude::*;

/// Writes a table in its pickled form.
pub(super) fn write(batch: &RecordBatch) -> PyResult<Vec<u8>> {
    let mut writer = StreamWriter::try_new(Vec::new(), &batch.schema()).map_err(refuse)?;
    writer.write(batch).map_err(refuse)?;
    writer.into_inner().map_err(refuse)
}

/// Returns the CRC-32 checksum of the bytes.
pub(super) fn checksum(stored: &[u8]) -> u32 {
    crc32fast::hash(stored)
}

/// Reads a table from its pickled form. Fails if the checksum of the bytes is wrong.
///
/// Even if the checksum is forged, allocates nothing for data that is announced but missing.
pub(super) fn read(stored: &[u8], checksum: u32) -> PyResult<RecordBatch> {
    if self::checksum(stored) != checksum {
        return Err(refuse(
            "table: is damaged: its checksum is not that of its bytes; make the pickle again",
        ));
    }
    let (mut decoder, mut rest) = (StreamDecoder::new(), Buffer::from(stored));
    let batch = decoder.decode(&mut rest).map_err(refuse)?;
    let second = decoder.decode(&mut rest).map_err(refuse)?;
    decoder.finish().map_err(refuse)?;
    match (batch, second) {
        (Some(batch), None) => Ok(batch),
        _ => Err(refuse("table: holds no batch, or several")),
    }
}
