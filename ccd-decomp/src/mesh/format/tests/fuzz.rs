//! Tests that any bytes give an error or a valid mesh, never a panic.

use super::{Format, binary_ply, binary_stl, read, valid_files};
use proptest::prelude::*;

#[test]
fn a_file_cut_anywhere_gives_an_error_or_a_valid_mesh() {
    for (format, bytes) in valid_files() {
        for end in 0..bytes.len() {
            check(format, &bytes[..end]);
        }
    }
}

#[test]
fn a_binary_file_cut_anywhere_gives_an_error() {
    for (format, bytes) in [
        (Format::Stl, binary_stl()),
        (Format::Ply, binary_ply("little")),
        (Format::Ply, binary_ply("big")),
    ] {
        for end in 0..bytes.len() {
            assert!(
                read(format, &bytes[..end]).is_err(),
                "{format:?} cut at {end}"
            );
        }
    }
}

fn check(format: Format, bytes: &[u8]) {
    if let Ok(mesh) = read(format, bytes) {
        assert!(!mesh.faces().is_empty());
        assert_eq!(mesh.faces().len(), mesh.face_ids().len());
        assert!(mesh.vertices().iter().all(|v| v.is_finite()));
        let count = mesh.vertices().len() as u32;
        assert!(mesh.faces().iter().flatten().all(|&v| v < count));
    }
}

const FORMATS: [Format; 6] = [
    Format::Obj,
    Format::Stl,
    Format::Ply,
    Format::Off,
    Format::Gltf,
    Format::Collada,
];

proptest! {
    #[test]
    fn no_bytes_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        for format in FORMATS {
            check(format, &bytes);
        }
    }

    #[test]
    fn no_change_to_a_valid_file_panics(
        file in any::<prop::sample::Index>(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        cut in any::<prop::sample::Index>(),
    ) {
        let mut valid = valid_files();
        let (format, mut bytes) = valid.swap_remove(file.index(valid.len()));
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        check(format, &bytes);
        check(format, &bytes[cut.index(bytes.len())..]);
    }

    #[test]
    fn no_sequence_of_words_panics(
        words in prop::collection::vec(prop::sample::select(vec![
            "v", "f", "o", "\\", "\n", "\n", "0", "1", "-1", "3", "4e400", "nan", "1/2/3", "//", "#", "OFF",
            "ply\n", "format ascii 1.0\n", "element vertex 1\n", "element face 1\n", "end_header\n",
            "property float x\n", "property list char int vertex_index\n", "solid", "facet normal",
            "vertex", "outer loop\n", "endloop\n", "endfacet\n", "endsolid\n",
        ]), 0..60),
    ) {
        let text = words.join(" ");
        for format in FORMATS {
            check(format, text.as_bytes());
        }
    }
}
