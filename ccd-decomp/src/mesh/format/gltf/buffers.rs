//! Finds the bytes of the buffers of a glTF: embedded in the JSON, in the binary chunk, or in a separate file.

use super::schema::{Buffer, Root};
use super::{element_at_index, extensions};
use crate::mesh::error::{MeshFault, element_name, quoted};
use crate::mesh::format::LinkedFiles;
use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::general_purpose::{GeneralPurpose, PAD_INDIFFERENT};
use std::borrow::Cow;

/// The bytes of all buffers of a glTF. A buffer that only a compression extension fills has no data and is `None`.
pub(super) struct Buffers<'a> {
    document: &'a Root,
    bytes_by_buffer: Vec<Option<Cow<'a, [u8]>>>,
}

impl<'a> Buffers<'a> {
    pub(super) fn new(
        root: &'a Root,
        binary: Option<&'a [u8]>,
        linked: &'a LinkedFiles,
    ) -> Result<Self, MeshFault> {
        let found = |(k, buffer)| {
            let binary = binary.filter(|_| k == 0);
            buffer_bytes(buffer, binary, linked)
                .map_err(|fault| fault.at_element(element_name("buffer", k, None)))
        };
        let bytes: Result<_, _> = root.buffers.iter().enumerate().map(found).collect();
        Ok(Buffers {
            document: root,
            bytes_by_buffer: bytes?,
        })
    }

    /// Returns the bytes of a buffer view, except for the first `offset` bytes.
    pub(super) fn view_bytes(&self, view: usize, offset: u64) -> Result<&[u8], MeshFault> {
        let about = element_at_index(&self.document.buffer_views, "buffer view", view)?;
        let buffer = self.bytes_by_buffer.get(about.buffer);
        if about.extensions.meshopt.is_some() && buffer.is_none_or(Option::is_none) {
            return Err(extensions::meshopt_fault());
        }
        let found = || {
            let Some(buffer) = element_at_index(&self.bytes_by_buffer, "buffer", about.buffer)?
            else {
                let problem = format!("buffer {} has neither bytes nor a file", about.buffer);
                return Err(MeshFault::malformed_content(problem));
            };
            let start = about.byte_offset.checked_add(offset);
            let end = about.byte_offset.checked_add(about.byte_length);
            let range = start
                .zip(end)
                .filter(|&(_, end)| end <= buffer.len() as u64);
            // The conversions are exact: both ends are within the buffer.
            let within = range.and_then(|(start, end)| buffer.get(start as usize..end as usize));
            within.ok_or_else(|| {
                let (bytes, buffer) = (buffer.len(), about.buffer);
                MeshFault::malformed_content(format!(
                    "reaches beyond buffer {buffer}, which has {bytes} bytes"
                ))
            })
        };
        found()
            .map_err(|fault: MeshFault| fault.at_element(element_name("buffer view", view, None)))
    }

    /// Returns the stride of a buffer view in bytes, if the view states one.
    pub(super) fn stride(&self, view: usize) -> Option<u64> {
        self.document.buffer_views.get(view)?.byte_stride
    }
}

fn buffer_bytes<'a>(
    buffer: &'a Buffer,
    binary: Option<&'a [u8]>,
    linked: &'a LinkedFiles,
) -> Result<Option<Cow<'a, [u8]>>, MeshFault> {
    let bytes: Cow<'_, [u8]> = match (&buffer.uri, binary) {
        (None, None) => return Ok(None),
        (None, Some(binary)) => binary.into(),
        (Some(uri), _) => match data_uri_payload(uri) {
            Some(data) => decode_base64(data?)?.into(),
            None => {
                let name = path_from_uri(uri)?;
                let bytes = linked.get(&name).map(Vec::as_slice);
                bytes.ok_or_else(|| missing_linked_file_fault(name))?.into()
            }
        },
    };
    if (bytes.len() as u64) < buffer.byte_length {
        let missing = format!("byte {} of {}", bytes.len(), buffer.byte_length);
        Err(MeshFault::truncated_file(missing))
    } else {
        Ok(Some(bytes))
    }
}

fn missing_linked_file_fault(name: String) -> MeshFault {
    MeshFault::UnreadableLinkedFile {
        referenced_file_name: name,
        reason: "bytes have no files beside them; export it as a .glb, which holds all of it, or read it by the path of its file"
            .into(),
    }
}

/// Returns the path of the file of a buffer relative to the mesh; `None` for an embedded buffer.
pub(super) fn linked_file_path(buffer: &Buffer) -> Result<Option<String>, MeshFault> {
    let uri = buffer.uri.as_deref();
    let linked = uri.filter(|uri| data_uri_payload(uri).is_none());
    linked.map(path_from_uri).transpose()
}

/// Returns the base64 text of a data URI; `None` for any other URI.
fn data_uri_payload(uri: &str) -> Option<Result<&str, MeshFault>> {
    let rest = match uri.split_at_checked(5) {
        Some((scheme, rest)) if scheme.eq_ignore_ascii_case("data:") => rest,
        _ => return None,
    };
    Some(match rest.split_once(',') {
        Some((kind, data)) if kind.to_ascii_lowercase().ends_with(";base64") => Ok(data),
        _ => Err(MeshFault::malformed_content("its data is not in base64")),
    })
}

fn decode_base64(data: &str) -> Result<Vec<u8>, MeshFault> {
    // Some programs omit the padding.
    const LENIENT_BASE64: GeneralPurpose = GeneralPurpose::new(
        &STANDARD,
        PAD_INDIFFERENT.with_decode_allow_trailing_bits(true),
    );
    let decoded = LENIENT_BASE64.decode(data);
    decoded
        .map_err(|error| MeshFault::malformed_content(format!("its base64 is not valid: {error}")))
}

/// Decodes the percent escapes of a URI to a path: `%20` is a space, and so on.
fn path_from_uri(uri: &str) -> Result<String, MeshFault> {
    let problem = |what| {
        let problem = format!("its URI {} {what}", quoted(uri));
        Err(MeshFault::malformed_content(problem))
    };
    // This also refuses drive letters.
    if uri.contains(':') {
        return problem("is no path in the folder of the mesh");
    }
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&byte, after)) = rest.split_first() {
        rest = after;
        if byte != b'%' {
            bytes.push(byte);
            continue;
        }
        let digits = rest
            .get(..2)
            .and_then(|digits| std::str::from_utf8(digits).ok());
        let Some(byte) = digits.and_then(|digits| u8::from_str_radix(digits, 16).ok()) else {
            return problem("has a % without two digits");
        };
        bytes.push(byte);
        rest = &rest[2..];
    }
    match String::from_utf8(bytes) {
        Ok(path) => Ok(normalized_path(&path)),
        Err(_) => problem("is no UTF-8"),
    }
}

/// Removes empty and `.` components from a path, so that one file has one name. Absolute paths and `..` are kept.
fn normalized_path(path: &str) -> String {
    let root = if path.starts_with('/') { "/" } else { "" };
    let steps = path.split('/').filter(|step| !matches!(*step, "" | "."));
    let steps: Vec<&str> = steps.collect();
    format!("{root}{}", steps.join("/"))
}
