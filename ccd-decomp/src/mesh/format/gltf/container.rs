//! Splits a glTF file into its JSON and its binary chunk.
//!
//! | bytes | what |
//! |---|---|
//! | 4 | `glTF` |
//! | 4 | the version; as all numbers, little endian |
//! | 4 | the length of the whole |
//! | 4, 4 | the length of a chunk, and its kind: first `JSON`, then perhaps `BIN` |
//! | as many | the chunk |

use crate::mesh::error::MeshFault;

/// The JSON of a glTF, and its binary chunk, if there is one.
#[derive(Debug)]
pub(super) struct Container<'a> {
    pub(super) json: &'a [u8],
    pub(super) binary_chunk: Option<&'a [u8]>,
}

const GLTF_VERSION: u32 = 2;

impl<'a> Container<'a> {
    pub(super) fn read(bytes: &'a [u8]) -> Result<Self, MeshFault> {
        let Some(mut rest) = bytes.strip_prefix(b"glTF") else {
            return Ok(Container {
                json: bytes,
                binary_chunk: None,
            });
        };
        let version = read_u32(&mut rest)?;
        if version != GLTF_VERSION {
            return Err(MeshFault::unsupported_content(
                format!("binary glTF of version {version}"),
                "glTF 2.0",
            ));
        }
        let length = read_u32(&mut rest)? as usize;
        if bytes.len() < length {
            let missing = format!("byte {} of the {length} that it announces", bytes.len());
            return Err(MeshFault::truncated_file(missing));
        }
        let (kind, json) = read_chunk(&mut rest)?;
        if kind != *b"JSON" {
            return Err(MeshFault::malformed_content("its first chunk is not JSON"));
        }
        let next = (!rest.is_empty())
            .then(|| read_chunk(&mut rest))
            .transpose()?;
        // Other chunks are of extensions.
        let binary = next.filter(|(kind, _)| kind == b"BIN\0");
        let binary = binary.map(|(_, content)| content);
        Ok(Container {
            json,
            binary_chunk: binary,
        })
    }
}

/// Reads the next chunk, and returns its kind and its content.
fn read_chunk<'a>(rest: &mut &'a [u8]) -> Result<([u8; 4], &'a [u8]), MeshFault> {
    let length = read_u32(rest)? as usize;
    let kind = read_four_bytes(rest)?;
    let (content, after) = rest.split_at_checked(length).ok_or_else(truncated_fault)?;
    *rest = after;
    Ok((kind, content))
}

fn read_u32(rest: &mut &[u8]) -> Result<u32, MeshFault> {
    read_four_bytes(rest).map(u32::from_le_bytes)
}

fn read_four_bytes(rest: &mut &[u8]) -> Result<[u8; 4], MeshFault> {
    let (bytes, after) = rest.split_first_chunk().ok_or_else(truncated_fault)?;
    *rest = after;
    Ok(*bytes)
}

fn truncated_fault() -> MeshFault {
    MeshFault::truncated_file("a chunk")
}
