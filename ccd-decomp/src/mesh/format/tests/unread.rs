//! Tests that unsupported content is an error if it defines faces, and a remark otherwise.

use super::{
    Format, OBJ_WITH_OPTIONAL_CONTENT, TETRAHEDRON_OBJ, TETRAHEDRON_OFF, TETRAHEDRON_PLY,
    TETRAHEDRON_STL, binary_ply, binary_stl, corners, read,
};
use crate::TriangleMesh;
use rstest::rstest;

const TRIANGLE_OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n";

fn remarks(mesh: &TriangleMesh) -> String {
    mesh.repairs().remarks.to_string()
}

#[rstest]
#[case::capital("F 1 2 4\n", "line 6: \"F\" instead of \"f\"")]
#[case::vertex("V 1 2 4\n", "line 6: \"V\" instead of \"v\"")]
#[case::surface(
    "cstype bezier\nsurf 0 1 0 1 1 2 3 4\n",
    "line 7: holds a free-form surface"
)]
#[case::patch("bzp 1 2 3 4\n", "line 6: holds a free-form surface")]
#[case::call("call other.obj\n", "line 6: holds a call of another file")]
#[case::shell("csh -ls\n", "line 6: holds a call of another file")]
fn statements_that_make_faces_are_errors(#[case] more: &str, #[case] expected: &str) {
    let text = [TRIANGLE_OBJ, more].concat();
    let message = read(Format::Obj, text.as_bytes()).unwrap_err().to_string();
    assert!(message.contains(expected), "{message}");
}

#[rstest]
#[case::none(
    "vn 0 0 1\nvt 0 0\ns 1\nusemtl a\\b\\\nmtllib x.mtl\n# F 1 2 4\n\n",
    ""
)]
#[case::lines("l 1 2\nl 2 \\\n3 \\\n1\n", "lines passed over: 2 (from line 6 on)")]
#[case::points("p 1\n", "points passed over: 1 (line 6)")]
#[case::curves("curv 0 1 1 2\n", "curves passed over: 1 (line 6)")]
#[case::unknown(
    "vc 1 1 1\nvc 0 0 0\n\u{1b}[2J 1\n",
    "statements \"vc\" passed over: 2 (from line 6 on); statements \"\\u{1b}[2J\" passed over: 1 (line 8)"
)]
#[case::weights(
    "v 2 2 2 2\nv 1 1 1 1.0\nv 1 1 \\\n1\n",
    "vertices divided by their fourth number: 1 (line 6)"
)]
fn other_statements_are_remarked_upon(#[case] more: &str, #[case] expected: &str) {
    let text = [TRIANGLE_OBJ, more].concat();
    let mesh = read(Format::Obj, text.as_bytes()).unwrap();
    assert_eq!(remarks(&mesh), expected);
    assert_eq!(mesh.faces(), [[0, 1, 2]]);
}

#[test]
fn kinds_of_statements_are_counted_to_a_limit() {
    let unknown: String = (0..1000).map(|k| format!("x{k} 1\n")).collect();
    let text = [TRIANGLE_OBJ, &unknown].concat();
    let mesh = read(Format::Obj, text.as_bytes()).unwrap();
    let counts: Vec<usize> = mesh
        .repairs()
        .remarks
        .iter()
        .map(|remark| remark.count)
        .collect();
    assert_eq!(counts, [1, 1, 1, 1, 1, 1, 1, 1, 992]);
    assert!(remarks(&mesh).ends_with("others passed over: 992 (from line 14 on)"));
    // All parts of a file have its remarks; a merged mesh has those of both.
    let both = TriangleMesh::merge([&mesh, &mesh]).unwrap();
    assert_eq!(
        both.repairs()
            .remarks
            .iter()
            .map(|r| r.count)
            .sum::<usize>(),
        2000
    );
}

#[test]
fn an_element_that_is_passed_over_is_named() {
    let mesh = read(Format::Ply, TETRAHEDRON_PLY.as_bytes()).unwrap();
    assert_eq!(remarks(&mesh), "elements \"edge\" passed over: 1");
    let mesh = read(Format::Obj, OBJ_WITH_OPTIONAL_CONTENT).unwrap();
    let expected =
        "lines passed over: 1 (line 12); vertices divided by their fourth number: 1 (line 13)";
    assert_eq!(remarks(&mesh), expected);
    for (format, bytes) in [
        (Format::Obj, TETRAHEDRON_OBJ),
        (Format::Off, TETRAHEDRON_OFF),
        (Format::Stl, TETRAHEDRON_STL),
    ] {
        assert_eq!(remarks(&read(format, bytes.as_bytes()).unwrap()), "");
    }
}

/// Returns a text PLY of five vertices, with `faces` as the end of its header and `lines` after the vertices.
fn ply_text(faces: &str, lines: &str) -> String {
    format!(
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
         {faces}end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n{lines}"
    )
}

const FACE_HEADER_LINES: &str = "element face 1\nproperty list uchar int vertex_indices\n";
const STRIPS_HEADER_LINES: &str = "element tristrips 1\nproperty list int int vertex_indices\n";

#[test]
fn strips_are_triangles_turned_alike() {
    for (elements, lines, expected) in [
        (
            STRIPS_HEADER_LINES.to_owned(),
            "5 0 1 2 3 4\n",
            &[[0, 1, 2], [2, 1, 3], [2, 3, 4]][..],
        ),
        // −1 begins another strip, whose first triangle is not reversed.
        (
            STRIPS_HEADER_LINES.to_owned(),
            "8 0 1 2 3 -1 2 3 4\n",
            &[[0, 1, 2], [2, 1, 3], [2, 3, 4]],
        ),
        (
            STRIPS_HEADER_LINES.to_owned(),
            "9 -1 0 1 -1 -1 0 1 2 -1\n",
            &[[0, 1, 2]],
        ),
        (
            [FACE_HEADER_LINES, STRIPS_HEADER_LINES].concat(),
            "3 2 3 4\n4 0 1 2 3\n",
            &[[2, 3, 4], [0, 1, 2], [2, 1, 3]],
        ),
    ] {
        let mesh = read(Format::Ply, ply_text(&elements, lines).as_bytes()).unwrap();
        assert_eq!(mesh.faces(), expected, "{lines}");
        assert!(mesh.repairs().remarks.is_empty());
    }
    let text = ply_text(STRIPS_HEADER_LINES, "3 0 1 7\n");
    let message = read(Format::Ply, text.as_bytes()).unwrap_err().to_string();
    assert!(message.contains("names vertex 7"), "{message}");
}

#[rstest]
#[case::two_elements([FACE_HEADER_LINES, FACE_HEADER_LINES].concat(), "3 0 1 2\n3 2 1 3\n", "line 9: a second element \"face\"")]
#[case::two_properties(
    [FACE_HEADER_LINES, "property list uchar int vertex_indices\n"].concat(),
    "3 0 1 2 3 2 1 3\n",
    "line 9: a second property \"vertex_indices\""
)]
#[case::more_lines(FACE_HEADER_LINES.to_owned(), "3 0 1 2\n3 2 1 3\n", "has 8 bytes more than its header announces")]
#[case::more_corners(FACE_HEADER_LINES.to_owned(), "3 0 1 2 3\n", "line 15: \"3\" follows the last property of \"face\"")]
fn faces_beyond_the_header_are_errors(
    #[case] elements: String,
    #[case] lines: &str,
    #[case] expected: &str,
) {
    let text = ply_text(&elements, lines);
    let message = read(Format::Ply, text.as_bytes()).unwrap_err().to_string();
    assert!(message.contains(expected), "{message}");
}

#[test]
fn what_follows_the_end_is_an_error() {
    let longer = |bytes: &[u8], more: &[u8]| [bytes, more].concat();
    for (format, bytes) in [
        (Format::Off, TETRAHEDRON_OFF.as_bytes()),
        (Format::Ply, TETRAHEDRON_PLY.as_bytes()),
        (Format::Ply, &binary_ply("little")),
        (Format::Ply, &binary_ply("big")),
    ] {
        assert!(read(format, &longer(bytes, b"\n \n")).is_ok());
        let message = read(format, &longer(bytes, b"3 0 2 1\n"))
            .unwrap_err()
            .to_string();
        assert!(
            message.contains("that it announces") || message.contains("its header"),
            "{message}"
        );
    }
    let text = TETRAHEDRON_OFF.replace("4 4 6", "4 3 6");
    let message = read(Format::Off, text.as_bytes()).unwrap_err().to_string();
    let expected = "line 12: goes on after the 4 vertices and 3 faces that it announces";
    assert!(message.contains(expected), "{message}");
}

/// Tests that texts are read with byte order marks, in UTF-16, and with any line endings.
#[test]
fn texts_are_read_however_they_are_written() {
    let rich = String::from_utf8_lossy(OBJ_WITH_OPTIONAL_CONTENT).into_owned();
    for (format, text) in [
        (Format::Obj, TETRAHEDRON_OBJ),
        (Format::Obj, &rich),
        (Format::Stl, TETRAHEDRON_STL),
        (Format::Ply, TETRAHEDRON_PLY),
        (Format::Off, TETRAHEDRON_OFF),
    ] {
        let expected = corners(&read(format, text.as_bytes()).unwrap());
        let units = |text: &str, bytes: fn(u16) -> [u8; 2]| -> Vec<u8> {
            text.encode_utf16().flat_map(bytes).collect()
        };
        let marked = ["\u{feff}", text].concat();
        let unix = text.replace("\r\n", "\n");
        for bytes in [
            marked.clone().into_bytes(),
            units(&marked, u16::to_le_bytes),
            units(&marked, u16::to_be_bytes),
            unix.replace('\n', "\r").into_bytes(),
            unix.replace('\n', "\r\n").into_bytes(),
            units(
                &marked.replace("\r\n", "\n").replace('\n', "\r"),
                u16::to_le_bytes,
            ),
        ] {
            let mesh = read(format, &bytes).unwrap_or_else(|fault| panic!("{format:?}: {fault}"));
            assert_eq!(corners(&mesh), expected, "{format:?}");
        }
    }
    let message = read(
        Format::Obj,
        TETRAHEDRON_OBJ
            .replace("f 3 1 4", "f 3 1 9")
            .replace('\n', "\r")
            .as_bytes(),
    );
    let message = message.unwrap_err().to_string();
    assert!(
        message.contains("line 8: face 3 names vertex 9"),
        "{message}"
    );
    // Binary numbers may contain any byte.
    for endian in ["little", "big"] {
        let bytes = binary_ply(endian);
        let end = bytes
            .windows(11)
            .position(|w| w == b"end_header\n")
            .unwrap()
            + 11;
        let header = String::from_utf8(bytes[..end].to_vec())
            .unwrap()
            .replace('\n', "\r");
        let returns = [header.as_bytes(), &bytes[end..]].concat();
        let read = |bytes: &[u8]| corners(&read(Format::Ply, bytes).unwrap());
        assert_eq!(read(&returns), read(&bytes));
    }
    let mut marked = binary_stl();
    marked[..5].copy_from_slice(b"\xef\xbb\xbfso");
    assert_eq!(read(Format::Stl, &marked).unwrap().faces().len(), 4);
}

#[test]
fn a_fault_of_a_ply_is_told_in_words() {
    for (good, bad, expected) in [
        ("element face 4", "elemen face 4", "line 9: "),
        ("property int z", "property intt z", "line 8: "),
        ("format ascii 1.0", "format asci 1.0", "line 2: "),
        ("0 0 7 1", "0 x 7 1", "line 18: "),
        ("0 0 7 1", "0 7 1", "line 18: "),
        ("9 3 1 2 3", "9 3 1 2.5 3", "line 21: "),
        ("9 3 1 2 3", "9 3 1", "line 21: "),
        ("9 3 1 2 3", "300 3 1 2 3", "line 21: "),
    ] {
        assert!(TETRAHEDRON_PLY.contains(good));
        let text = TETRAHEDRON_PLY.replace(good, bad);
        let message = read(Format::Ply, text.as_bytes()).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
        for inner in [
            "ParseError",
            "expected one of",
            "Error:",
            "String:",
            "\\n",
            "{",
            "ScalarType",
            "ParseInt",
        ] {
            assert!(!message.contains(inner), "{message}");
        }
        assert!(message.contains(bad), "{message}");
    }
}
