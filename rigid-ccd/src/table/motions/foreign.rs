//! What is given for a table of motions, and is none: told by how it begins.

/// How files begin that are no CSV, and what they are.
const BEGINNINGS: [(&[u8], &str); 8] = [
    (b"PAR1", "Parquet"),
    (b"ARROW1", "Arrow"),
    (b"\x1f\x8b", "gzip"),
    (b"\x28\xb5\x2f\xfd", "zstd"),
    (b"PK\x03\x04", "a zip archive, such as a workbook"),
    (b"\x89HDF", "HDF5"),
    (b"\xff\xfe", "text in UTF-16"),
    (b"\xfe\xff", "text in UTF-16"),
];

/// How a file begins that Git LFS has in the place of one that is not fetched yet.
const LFS_BEGINNING: &[u8] = b"version https://git-lfs";

/// Whether a header is that of a pointer of Git LFS.
pub(super) fn is_lfs_pointer(header: &csv::ByteRecord) -> bool {
    header.as_slice().starts_with(LFS_BEGINNING)
}

/// Which format a header belongs to, when it is not that of a text.
pub(super) fn format(header: &csv::ByteRecord) -> Option<&'static str> {
    let bytes = header.as_slice();
    let known = BEGINNINGS
        .iter()
        .find(|(begin, _)| bytes.starts_with(begin));
    known
        .map(|&(_, format)| format)
        .or_else(|| bytes.contains(&0).then_some("binary"))
}

/// What separates the cells of a header that has no commas.
pub(super) fn separator(header: &str) -> Option<char> {
    [';', '\t', '|']
        .into_iter()
        .find(|&mark| header.contains(mark))
}
