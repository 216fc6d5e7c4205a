//! The reader of glTF 2.0, text and binary.
//!
//! The crate `gltf` is not used: it rounds node transforms to f32, reads quantized positions as floats, and overflows
//! at the lengths and counts of hostile files.

mod accessor;
mod buffers;
mod container;
mod extensions;
mod nodes;
mod primitive;
mod schema;
mod transform;
mod whole;

use super::{FileReferences, LinkedFiles};
use crate::mesh::content::Content;
use crate::mesh::content::allowance::ExpansionBudget;
use crate::mesh::error::{MeshFault, element_name};
use accessor::AccessorReader;
use buffers::Buffers;
use container::Container;
use schema::Root;

/// Parses a glTF, text or binary, into an assembly of parts.
pub(super) fn parse(bytes: &[u8], linked: &LinkedFiles) -> Result<Content, MeshFault> {
    if bytes.is_empty() {
        return Err(MeshFault::NoVertices);
    }
    let container = Container::read(bytes)?;
    let root = Root::read(container.json)?;
    extensions::check_required_extensions(&root)?;
    let buffers = Buffers::new(&root, container.binary_chunk, linked)?;
    let all_bytes = bytes.len() + linked.values().map(Vec::len).sum::<usize>();
    let accessors = AccessorReader {
        root: &root,
        buffers: &buffers,
        expansion_budget: ExpansionBudget::for_file(all_bytes as u64),
    };
    nodes::read_scene(&root, accessors)
}

/// Returns the references of a glTF to buffers that are separate files.
pub(super) fn file_references(bytes: &[u8]) -> Result<FileReferences, MeshFault> {
    let mut references = FileReferences::new();
    if bytes.is_empty() {
        return Ok(references);
    }
    let unmarked = bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes);
    let root = Root::read(Container::read(unmarked)?.json)?;
    for (k, buffer) in root.buffers.iter().enumerate() {
        let name = buffers::linked_file_path(buffer)
            .map_err(|fault| fault.at_element(element_name("buffer", k, None)))?;
        if let Some(name) = name {
            let most = references.entry(name).or_default();
            *most = buffer.byte_length.max(*most);
        }
    }
    Ok(references)
}

/// Returns the element of a JSON array at the index `number`, or a fault that names the elements by `kind`.
fn element_at_index<'a, T>(list: &'a [T], kind: &str, number: usize) -> Result<&'a T, MeshFault> {
    list.get(number).ok_or_else(|| {
        let count = list.len();
        MeshFault::malformed_content(format!(
            "names {kind} {number}, but there are {count}, numbered from 0"
        ))
    })
}

#[cfg(test)]
mod tests;
