//! The header and checksum around the stored bytes of a body, by which foreign, truncated and damaged files are
//! detected.
//!
//! | bytes | what |
//! |---|---|
//! | 8 | the magic number |
//! | 4 | the version of the format; as all numbers, little endian |
//! | 8 | the length of the payload |
//! | as many | the payload |
//! | 4 | CRC-32 of all before |

use super::error::{FORMAT_VERSION, StoreFault};
use crate::messages::is_lfs_pointer;
use std::io::{self, Read, Write};

/// The magic bytes at the start of the file of a stored body, modelled on those of PNG. No text begins with them, and a
/// transfer that converts line ends or strips the eighth bit damages them.
const MAGIC: [u8; 8] = *b"\x89ccd\r\n\x1a\n";

const HEADER_BYTES: usize = MAGIC.len() + size_of::<u32>() + size_of::<u64>();

/// Writes the header, the payload and the checksum of both, which [`read`] verifies.
pub(super) fn write(mut writer: impl Write, payload: &[u8]) -> io::Result<()> {
    let mut header = Vec::with_capacity(HEADER_BYTES);
    header.extend(MAGIC);
    header.extend(FORMAT_VERSION.to_le_bytes());
    header.extend((payload.len() as u64).to_le_bytes());
    writer.write_all(&header)?;
    writer.write_all(payload)?;
    writer.write_all(&checksum(&header, payload).to_le_bytes())?;
    writer.flush()
}

/// Reads a payload, and verifies its header, length and checksum.
///
/// # Complexity
/// Linear in the bytes present, for any announced length.
pub(super) fn read(mut reader: impl Read) -> Result<Vec<u8>, StoreFault> {
    let mut header = read_up_to(&mut reader, HEADER_BYTES as u64)?;
    if !header.starts_with(&MAGIC) {
        // More bytes identify an LFS pointer. A file shorter than the magic number is more likely foreign.
        header.extend(read_up_to(&mut reader, HEADER_BYTES as u64)?);
        return Err(if is_lfs_pointer(&header) {
            StoreFault::LfsPointer
        } else {
            StoreFault::NotStoredBody
        });
    }
    let mut fields = &header[MAGIC.len()..];
    let version = u32::from_le_bytes(take_array(&mut fields)?);
    if version != FORMAT_VERSION {
        return Err(StoreFault::UnsupportedVersion { version });
    }
    let length = u64::from_le_bytes(take_array(&mut fields)?);
    let payload = read_up_to(&mut reader, length)?;
    if payload.len() as u64 != length {
        return Err(StoreFault::Truncated);
    }
    let end = read_up_to(&mut reader, size_of::<u32>() as u64)?;
    let is_damaged = u32::from_le_bytes(take_array(&mut &end[..])?) != checksum(&header, &payload);
    if is_damaged || !read_up_to(&mut reader, 1)?.is_empty() {
        return Err(StoreFault::ChecksumMismatch);
    }
    Ok(payload)
}

/// Reads up to `count` bytes; fewer if the reader ends before.
fn read_up_to(reader: &mut impl Read, count: u64) -> Result<Vec<u8>, StoreFault> {
    let mut bytes = Vec::new();
    let taken = reader.take(count).read_to_end(&mut bytes);
    taken.map_err(StoreFault::Unreadable)?;
    Ok(bytes)
}

/// Removes the first `N` bytes from a slice and returns them; [`StoreFault::Truncated`] if there are fewer.
fn take_array<const N: usize>(from: &mut &[u8]) -> Result<[u8; N], StoreFault> {
    let (first, rest) = from.split_first_chunk().ok_or(StoreFault::Truncated)?;
    *from = rest;
    Ok(*first)
}

fn checksum(header: &[u8], payload: &[u8]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(header);
    hasher.update(payload);
    hasher.finalize()
}
