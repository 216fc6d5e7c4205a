//! The fuzz target that loads stored bodies. The frame of the `.ccd` file is repaired, so that changed payloads pass
//! the checksum.

use super::bodies;
use crate::memory;
use ccd_decomp::{Format, PieceChoice, StoredBodyContent, TriangleMesh, prepare};
use std::sync::LazyLock;

/// The maximum size of the input, in bytes.
const MAX_FILE_BYTES: usize = 1 << 14;

/// The constant part of the memory limit of loading, in bytes; the limit grows with the input.
const BASE_MEMORY_LIMIT: usize = 1 << 25;
const MEMORY_LIMIT_PER_INPUT_BYTE: usize = 1 << 10;

/// The length in bytes of the magic number and the version at the start of a file. The length of the payload and its
/// checksum follow.
const HEADER_BYTES: usize = 12;
const LENGTH_BYTES: usize = 8;
const CHECKSUM_BYTES: usize = 4;

/// The magic number and the version of this build's format.
static HEADER: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let mesh = TriangleMesh::from_reader(Format::Obj, triangle.as_bytes()).expect("a triangle");
    let model = prepare(&mesh, PieceChoice::Triangles).expect("a body");
    bodies::stored_bytes(&model)[..HEADER_BYTES].to_vec()
});

pub(super) fn run(bytes: &[u8]) {
    if bytes.len() > MAX_FILE_BYTES {
        return;
    }
    LazyLock::force(&HEADER);
    memory::with_memory_limit(
        BASE_MEMORY_LIMIT + MEMORY_LIMIT_PER_INPUT_BYTE * bytes.len(),
        || {
            check(bytes);
            check(&with_repaired_framing(bytes));
        },
    );
}

/// Returns the file with a magic number, version, length and checksum that fit its payload.
fn with_repaired_framing(bytes: &[u8]) -> Vec<u8> {
    let end = bytes.len().saturating_sub(CHECKSUM_BYTES);
    let payload = bytes
        .get(HEADER_BYTES + LENGTH_BYTES..end)
        .unwrap_or_default();
    let mut file = HEADER.clone();
    file.extend((payload.len() as u64).to_le_bytes());
    file.extend(payload);
    let checksum = crc32fast::hash(&file);
    file.extend(checksum.to_le_bytes());
    file
}

fn check(bytes: &[u8]) {
    let model = match StoredBodyContent::read(bytes) {
        Ok(model) => model,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    let _ = model.report.to_string();
    let body = model.body().expect("a model that was read is a body");
    assert_eq!(body.pieces().len(), model.report.pieces);
    bodies::check_storing(&model);
}
