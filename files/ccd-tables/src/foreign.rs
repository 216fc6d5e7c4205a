//! Recognises files that are not CSV by their first bytes.

/// The first bytes of a Parquet file. Its reader is a part of this build only with the feature `parquet`.
pub(super) const PARQUET_SIGNATURE: &[u8] = b"PAR1";

/// The first bytes of other file formats, each with the name of the format.
const FILE_SIGNATURES: [(&[u8], &str); 9] = [
    (PARQUET_SIGNATURE, "Parquet"),
    (b"PARE", "encrypted Parquet"),
    (b"ARROW1", "Arrow"),
    (b"\x1f\x8b", "gzip"),
    (b"\x28\xb5\x2f\xfd", "zstd"),
    (b"PK\x03\x04", "a zip archive, such as a workbook"),
    (b"\x89HDF", "HDF5"),
    (b"\xff\xfe", "text in UTF-16"),
    (b"\xfe\xff", "text in UTF-16"),
];

/// The first bytes of a Git LFS pointer, which stands for a file that is not fetched yet.
const LFS_SIGNATURE: &[u8] = b"version https://git-lfs";

/// Returns whether a header belongs to a Git LFS pointer.
pub(super) fn is_lfs_pointer(header: &csv::ByteRecord) -> bool {
    header.as_slice().starts_with(LFS_SIGNATURE)
}

/// Returns whether a header belongs to a Parquet file.
pub(super) fn is_parquet(header: &csv::ByteRecord) -> bool {
    header.as_slice().starts_with(PARQUET_SIGNATURE)
}

/// Returns the format of a binary file, recognised by its header; `None` for text.
pub(super) fn format(header: &csv::ByteRecord) -> Option<&'static str> {
    let bytes = header.as_slice();
    let signature = FILE_SIGNATURES
        .iter()
        .find(|(first_bytes, _)| bytes.starts_with(first_bytes));
    signature
        .map(|&(_, format)| format)
        .or_else(|| bytes.contains(&0).then_some("binary"))
}

/// Returns whether a column is the index of a pandas frame, which has no name in CSV and a special one in Parquet.
pub(super) fn is_pandas_index(column: &str) -> bool {
    column.is_empty() || column.starts_with("__index_level_")
}

/// Returns the semicolon, tab or bar that separates the cells of a header without commas; `None` if it has none of
/// these.
pub(super) fn header_separator(header: &str) -> Option<char> {
    [';', '\t', '|']
        .into_iter()
        .find(|&separator| header.contains(separator))
}
