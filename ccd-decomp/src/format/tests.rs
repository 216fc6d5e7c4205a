use super::Format;
use crate::{MeshFault, TriangleMesh, write_obj};
use ccd_core::glam::DVec3;
use proptest::prelude::*;
use rstest::rstest;

const OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// Everything an OBJ may have besides: carriage returns, normals, relative indices, objects,
/// materials, a continued line, colours, a weight, and a byte that is no UTF-8.
const RICH_OBJ: &[u8] = b"# caf\xe9\r\nmtllib none.mtl\r\no first\r\nv 0 0 0 1\r\nv 1 0 0 0.5 0.5 0.5\r\n\
    v 0 1 0 # up\r\nvn 0 0 1\r\nvt 0 0\r\nusemtl red\r\nf 1/1/1 -1/-1/-1 2/1/1\r\ng second\r\nl 1 2\r\n\
    v 0 0 2 2\r\nf 1//1 2//1 \\\r\n  4//1\r\nusemtl blue\r\nf 2/1 3/1 4/1\r\ns off\r\nf +3 1 -1\r\n";

const STL: &str = "solid a tetrahedron\n\
    facet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n\
    facet normal 0 0 0\nouter loop\nvertex -0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n\
    endsolid\n\nSOLID\nFACET NORMAL 1 0 0\n  OUTER LOOP\nVERTEX 1.0E0 0 0\nVERTEX 0 1 0\nVERTEX 0 0 1\n\
    ENDLOOP\nENDFACET\nfacet normal 0 0 0\nouter loop\nvertex 0 1 0\nvertex 0 0 0\nvertex 0 0 1\nendloop\n\
    endfacet\nendsolid\n";

const PLY: &str = "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\n\
    property float x\nproperty double y\nproperty float nx\nproperty int z\nelement face 4\n\
    property uchar flags\nproperty list uchar int vertex_indices\nelement edge 1\nproperty int a\n\
    end_header\n0 0 7 0\n1 0 7 0\n0 1 7 0\n0 0 7 1\n9 3 0 2 1\n9 3 0 1 3\n9 3 1 2 3\n9 3 2 0 3\n5\n";

const OFF: &str = "COFF # colours\n\n4 4 6\n0 0 0 255 0 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n# the tip\n0 0 1\n\
    3 0 2 1\n3 0 1 3  0.5 0.5 0.5\n3 1 2 3\n3 2 0 3\n";

const POINTS: [[f32; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];
const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

/// A binary STL whose header begins like a text.
fn binary_stl() -> Vec<u8> {
    let mut bytes = Vec::new();
    let facets = FACES.map(|face| stl_io::Triangle {
        normal: stl_io::Normal::new([0.0; 3]),
        vertices: face.map(|v| stl_io::Vertex::new(POINTS[v as usize])),
    });
    stl_io::write_stl(&mut bytes, facets.iter()).unwrap();
    bytes[..10].copy_from_slice(b"solid bin\n");
    bytes
}

fn binary_ply(endian: &str) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat binary_{endian}_endian 1.0\nelement face 4\n\
         property list uchar uint vertex_index\nelement vertex 4\nproperty double x\n\
         property double y\nproperty double z\nend_header\n"
    )
    .into_bytes();
    let little = endian == "little";
    for face in FACES {
        bytes.push(3);
        bytes.extend(face.iter().flat_map(|v| {
            if little {
                v.to_le_bytes()
            } else {
                v.to_be_bytes()
            }
        }));
    }
    for x in POINTS.iter().flatten().map(|&x| f64::from(x)) {
        bytes.extend(if little {
            x.to_le_bytes()
        } else {
            x.to_be_bytes()
        });
    }
    bytes
}

fn valid() -> Vec<(Format, Vec<u8>)> {
    vec![
        (Format::Obj, OBJ.into()),
        (Format::Obj, RICH_OBJ.into()),
        (Format::Stl, STL.into()),
        (Format::Stl, binary_stl()),
        (Format::Ply, PLY.into()),
        (Format::Ply, binary_ply("little")),
        (Format::Ply, binary_ply("big")),
        (Format::Off, OFF.into()),
    ]
}

fn read(format: Format, bytes: &[u8]) -> Result<TriangleMesh, MeshFault> {
    TriangleMesh::from_reader(format, bytes).map_err(|error| error.fault)
}

/// The corners of all triangles, whatever the vertices are numbered.
fn corners(mesh: &TriangleMesh) -> Vec<[DVec3; 3]> {
    let point = |v: u32| mesh.vertices()[v as usize];
    mesh.faces().iter().map(|face| face.map(point)).collect()
}

#[test]
fn all_formats_read_the_same_tetrahedron() {
    let expected: Vec<[DVec3; 3]> = FACES
        .iter()
        .map(|face| face.map(|v| ccd_core::glam::Vec3::from_array(POINTS[v as usize]).as_dvec3()))
        .collect();
    for (format, bytes) in valid() {
        let mesh = read(format, &bytes).unwrap();
        assert_eq!(corners(&mesh), expected, "{format:?}");
        assert_eq!(mesh.vertices().len(), 4, "{format:?}");
        assert_eq!(mesh.face_ids(), [0, 1, 2, 3], "{format:?}");
        assert!(mesh.repairs().is_empty(), "{format:?}: {}", mesh.repairs());
    }
}

#[test]
fn obj_keeps_the_numbers_of_the_file() {
    let text =
        "v 9 9 9\nv 0 0 1\nv 0 1 0\nv 1 0 0\nv 8 8 8\nv 1 1 0\no a\nf 6 4 3 2\no b\nf 4 3 2\n";
    let mesh = read(Format::Obj, text.as_bytes()).unwrap();
    assert_eq!(mesh.faces(), [[5, 3, 2], [5, 2, 1], [3, 2, 1]]);
    assert_eq!(mesh.face_ids(), [0, 0, 1]);
    assert_eq!(mesh.vertices()[4], DVec3::splat(8.0));
    assert_eq!(mesh.repairs().unreferenced.first(), [0, 4]);
}

#[test]
fn obj_of_three_vertices_and_of_few_polygons() {
    // The library treats exactly three vertices, and all faces alike, as a special case.
    let three = read(Format::Obj, b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1").unwrap();
    assert_eq!(three.faces(), [[0, 1, 2], [2, 1, 0]]);
    let mixed = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3 1\nf 3 2 1";
    assert_eq!(read(Format::Obj, mixed).unwrap().face_ids(), [0, 2]);
}

#[test]
fn stl_welds_corners_in_order_of_appearance() {
    let mesh = read(Format::Stl, &binary_stl()).unwrap();
    assert_eq!(mesh.faces()[0], [0, 1, 2]);
    assert_eq!(mesh.vertices()[1], DVec3::Y);
}

#[test]
fn off_counts_may_follow_the_keyword_or_stand_alone() {
    let body = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for text in [format!("OFF {body}"), body.to_string()] {
        assert_eq!(
            read(Format::Off, text.as_bytes()).unwrap().faces(),
            [[0, 1, 2]]
        );
    }
}

#[rstest]
#[case::empty_obj(Format::Obj, "", "has no vertices")]
#[case::empty_stl(Format::Stl, "", "has no vertices")]
#[case::empty_ply(Format::Ply, "", "has no vertices")]
#[case::empty_off(Format::Off, "\n# nothing\n", "has no vertices")]
#[case::no_faces(Format::Obj, "v 0 0 0\nl 1 1\n", "has no faces")]
#[case::no_facets(Format::Stl, "solid x\nendsolid x\n", "has no vertices")]
#[case::nan(
    Format::Obj,
    "v 0 0 0\n\nv 0 nan 0\nv 1 0 0\nf 1 2 3",
    "line 3: vertex 1 is NaN"
)]
#[case::infinite(
    Format::Off,
    "OFF\n1 1 0\ninf 0 0\n3 0 0 0\n",
    "line 3: vertex 0 is NaN or inf"
)]
#[case::large(
    Format::Obj,
    "v 0 0 2e15\nf 1 1 1",
    "line 1: vertex 0 has a coordinate beyond ±1e15"
)]
#[case::zero_index(
    Format::Obj,
    "v 0 0 0\nf 1 1 1\nf 1 0 1",
    "line 3: face 1 names vertex 0"
)]
#[case::above(
    Format::Obj,
    "v 0 0 0\nf 1 1 2",
    "face 0 names vertex 2, but there are 1, numbered from 1"
)]
#[case::relative(Format::Obj, "f -1 1 1\nv 0 0 0", "line 1: face 0 names vertex -1")]
#[case::huge_index(
    Format::Obj,
    "v 0 0 0\nf 1 1 9223372036854775807",
    "names vertex 9223372036854775807"
)]
#[case::lowest_index(
    Format::Obj,
    "v 0 0 0\nf 1 1 -9223372036854775808",
    "names vertex -9223372036854775808"
)]
#[case::no_vertex(Format::Obj, "v 0 0 0\nf 1 1 /1/1", "face 0 names vertex 0")]
#[case::word(
    Format::Obj,
    "v 0 0 0\nv 0 zero 0\nf 1 1 1",
    "line 2: position parse error"
)]
#[case::short_vertex(Format::Obj, "# one\nv 0 0\nf 1 1 1", "line 2: position parse error")]
#[case::weightless(Format::Obj, "v 0 0 0 0\nf 1 1 1", "line 1: scaling (w) by zero")]
#[case::bad_face(Format::Obj, "v 0 0 0\nf 1 1 1\nf 1 x 1", "line 3: face parse error")]
#[case::two_corners(Format::Obj, "v 0 0 0\nf 1 1 1\nf 1 1", "line 3: face 1 has 2 corners")]
#[case::no_corners(Format::Obj, "v 0 0 0\nf", "line 2: face 0 has 0 corners")]
#[case::stl_infinite(
    Format::Stl,
    "solid x\nfacet normal 0 0 1\nouter loop\nvertex inf 0 0",
    "line 2: facet 0"
)]
#[case::stl_ends(
    Format::Stl,
    "solid x\nfacet normal 0 0 1\nouter loop\n",
    "ends before facet 0"
)]
#[case::stl_open(Format::Stl, "solid x\n", "ends before the last solid")]
#[case::stl_garbage(Format::Stl, "hello", "ends before the header")]
#[case::ply_magic(Format::Ply, "plyx\n", "line 1: ")]
#[case::ply_header(
    Format::Ply,
    "ply\nformat ascii 1.0\n",
    "ends before what its header announces"
)]
#[case::off_magic(Format::Off, "ONN\n1 1 1\n", "line 1: \"ONN\" instead of OFF")]
#[case::off_binary(Format::Off, "OFF BINARY\n", "holds binary OFF")]
#[case::off_4d(Format::Off, "4OFF\n", "holds \"4OFF\"")]
#[case::off_ends(Format::Off, "OFF\n2 1 0\n0 0 0\n", "ends before vertex 1 of 2")]
#[case::off_face_ends(Format::Off, "OFF\n1 2 0\n0 0 0\n3 0 0 0\n", "ends before face 1 of 2")]
#[case::off_short(
    Format::Off,
    "OFF\n1 1 0\n0 0 0\n3 0 0\n",
    "line 4: ends before as many vertex"
)]
#[case::off_index(
    Format::Off,
    "OFF\n1 1 0\n0 0 0\n3 0 0 -1\n",
    "line 4: face 0 names vertex -1"
)]
#[case::off_count(Format::Off, "OFF\n1 -1 0\n", "line 2: \"-1\" instead of the numbers")]
fn bad_input_is_named(#[case] format: Format, #[case] text: &str, #[case] expected: &str) {
    let message = read(format, text.as_bytes()).unwrap_err().to_string();
    assert!(message.contains(expected), "{message}");
}

#[rstest]
#[case::index(
    "3 1 2 3\n",
    "3 1 2 4\n",
    "face 2 names vertex 4, but there are 4, numbered from 0"
)]
#[case::negative("3 1 2 3\n", "3 1 2 -3\n", "face 2 names vertex -3")]
#[case::corners("9 3 1 2 3\n", "9 2 1 2\n", "face 2 has 2 corners")]
#[case::number("1 0 7 0\n", "1 x 7 0\n", "line 16: ")]
#[case::list("3 2 0 3\n", "3 2 0\n", "line 22: ")]
#[case::coordinate("property int z", "property int w", "lacks the property x, y, z")]
#[case::text(
    "property int z",
    "property list int int z",
    "is unsupported by the destination"
)]
#[case::indices(
    "vertex_indices",
    "corners",
    "lacks the property vertex_indices or vertex_index"
)]
#[case::no_faces("element face 4", "element farce 4", "has no faces")]
#[case::no_vertices("element vertex 4", "element vertices 4", "has no vertices")]
#[case::endless(
    "element edge 1",
    "element edge 99999999999999999",
    "ends before all 99999999999999999"
)]
#[case::missing(
    "element edge 1",
    "element edge 2",
    "ends before what its header announces"
)]
fn bad_ply_is_named(#[case] good: &str, #[case] bad: &str, #[case] expected: &str) {
    assert!(PLY.contains(good));
    let text = PLY.replace(good, bad);
    let message = read(Format::Ply, text.as_bytes()).unwrap_err().to_string();
    assert!(message.contains(expected), "{message}");
}

#[test]
fn faults_are_typed() {
    let fault = |text: &str| read(Format::Obj, text.as_bytes()).unwrap_err();
    assert!(matches!(
        fault("v 0 0 0\nv inf 0 0\nf 1 1 1"),
        MeshFault::NotFinite {
            vertex: 1,
            line: Some(2)
        }
    ));
    assert!(matches!(
        fault("v 0 0 0\nf 1 1 1\nf 1 7 1"),
        MeshFault::NoSuchVertex {
            face: 1,
            line: Some(3),
            vertex: 7,
            vertices: 1,
            base: 1
        }
    ));
    assert!(matches!(
        fault("v 0 0 0\nf 1 1"),
        MeshFault::TooFewCorners {
            face: 0,
            line: Some(2),
            corners: 2
        }
    ));
    let cut = read(Format::Stl, &binary_stl()[..200]).unwrap_err();
    assert!(matches!(cut, MeshFault::Truncated { .. }), "{cut}");
    assert!(cut.to_string().contains("facet 2 of the 4"), "{cut}");
}

#[test]
fn a_binary_stl_that_announces_too_few_facets_loses_none() {
    let mut bytes = binary_stl();
    bytes[80] = 2;
    bytes[0] = b'x';
    let message = read(Format::Stl, &bytes).unwrap_err().to_string();
    assert!(
        message.contains("announces 2 facets, but has room for 4"),
        "{message}"
    );
}

#[test]
fn a_file_cut_anywhere_gives_an_error_or_a_valid_mesh() {
    for (format, bytes) in valid() {
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

#[test]
fn files_are_named() {
    let path = std::env::temp_dir().join(format!("ccd-decomp-{}.OBJ", std::process::id()));
    std::fs::write(&path, "v 0 0 0\nf 1 1 2\n").unwrap();
    let error = TriangleMesh::read(&path).unwrap_err();
    std::fs::remove_file(&path).unwrap();
    assert_eq!(error.file.as_deref(), Some(path.as_path()));
    let expected = format!("{}: line 2: face 0 names vertex 2", path.display());
    assert!(error.to_string().starts_with(&expected), "{error}");

    let missing = TriangleMesh::read(&path).unwrap_err();
    assert!(
        matches!(missing.fault, MeshFault::Unreadable(_)),
        "{missing}"
    );
    for name in ["part.step", "part", ".obj"] {
        let unknown = TriangleMesh::read(name).unwrap_err();
        assert!(
            matches!(unknown.fault, MeshFault::UnknownExtension { .. }),
            "{unknown}"
        );
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

const FORMATS: [Format; 4] = [Format::Obj, Format::Stl, Format::Ply, Format::Off];

proptest! {
    #[test]
    fn no_bytes_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        for format in FORMATS {
            check(format, &bytes);
        }
    }

    #[test]
    fn no_change_to_a_valid_file_panics(
        file in 0..8usize,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        cut in any::<prop::sample::Index>(),
    ) {
        let (format, mut bytes) = valid().swap_remove(file);
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

    #[test]
    fn a_written_obj_reads_back_to_the_same_bits(
        points in prop::collection::vec(prop::array::uniform3(-1e15..1e15), 3..20),
        picks in prop::collection::vec(prop::array::uniform3(any::<prop::sample::Index>()), 1..20),
    ) {
        let faces: Vec<[u32; 3]> = picks
            .iter()
            .map(|pick| pick.map(|index| index.index(points.len()) as u32))
            .collect();
        let mesh = TriangleMesh::new(points.iter().copied().map(DVec3::from).collect(), &faces).unwrap();
        let mut bytes = Vec::new();
        write_obj(&mesh, &mut bytes).unwrap();
        let again = read(Format::Obj, &bytes).unwrap();
        prop_assert_eq!(again.vertices(), mesh.vertices());
        prop_assert_eq!(again.faces(), mesh.faces());
    }
}
