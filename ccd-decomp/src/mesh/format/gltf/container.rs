//! Splits a glTF into its JSON and its binary chunk.
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
    pub(super) binary: Option<&'a [u8]>,
}

const VERSION: u32 = 2;

impl<'a> Container<'a> {
    pub(super) fn read(bytes: &'a [u8]) -> Result<Self, MeshFault> {
        let Some(mut rest) = bytes.strip_prefix(b"glTF") else {
            return Ok(Container {
                json: bytes,
                binary: None,
            });
        };
        let version = number(&mut rest)?;
        if version != VERSION {
            return Err(MeshFault::Unsupported {
                what: format!("binary glTF of version {version}"),
                instead: "glTF 2.0",
            });
        }
        let length = number(&mut rest)? as usize;
        if bytes.len() < length {
            let missing = format!("byte {} of the {length} that it announces", bytes.len());
            return Err(MeshFault::Truncated { missing });
        }
        let Chunk { kind, content } = chunk(&mut rest)?;
        if kind != *b"JSON" {
            return Err(MeshFault::syntax(
                None,
                "its first chunk is not JSON".into(),
            ));
        }
        let mut container = Container {
            json: content,
            binary: None,
        };
        if !rest.is_empty() {
            let Chunk { kind, content } = chunk(&mut rest)?;
            // Other chunks are of extensions.
            container.binary = (kind == *b"BIN\0").then_some(content);
        }
        Ok(container)
    }
}

struct Chunk<'a> {
    kind: [u8; 4],
    content: &'a [u8],
}

fn chunk<'a>(rest: &mut &'a [u8]) -> Result<Chunk<'a>, MeshFault> {
    let length = number(rest)? as usize;
    let kind = four(rest)?;
    let (content, after) = rest.split_at_checked(length).ok_or_else(cut_short)?;
    *rest = after;
    Ok(Chunk { kind, content })
}

fn number(rest: &mut &[u8]) -> Result<u32, MeshFault> {
    four(rest).map(u32::from_le_bytes)
}

fn four(rest: &mut &[u8]) -> Result<[u8; 4], MeshFault> {
    let (bytes, after) = rest.split_first_chunk().ok_or_else(cut_short)?;
    *rest = after;
    Ok(*bytes)
}

fn cut_short() -> MeshFault {
    MeshFault::Truncated {
        missing: "a chunk".into(),
    }
}
