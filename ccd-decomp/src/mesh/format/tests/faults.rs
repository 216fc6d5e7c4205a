//! Tests the error message for every kind of invalid mesh file.

use super::{Format, TETRAHEDRON_PLY, binary_stl, read};
use crate::{MeshFault, TriangleMesh};
use rstest::rstest;

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
    "line 1: vertex 0 has a coordinate beyond ±1e12"
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
    "line 2: \"v 0 zero 0\" does not hold the three coordinates of a vertex"
)]
#[case::short_vertex(
    Format::Obj,
    "# one\nv 0 0\nf 1 1 1",
    "line 2: \"v 0 0\" does not hold the three coordinates of a vertex"
)]
#[case::weightless(
    Format::Obj,
    "v 0 0 0 0\nf 1 1 1",
    "line 1: \"v 0 0 0 0\" divides a position by no number"
)]
#[case::bad_face(
    Format::Obj,
    "v 0 0 0\nf 1 1 1\nf 1 x 1",
    "line 3: \"x\" instead of the number of a vertex"
)]
#[case::nan_face(
    Format::Obj,
    "v 0 0 0\nf 1 NaN/1 1",
    "line 2: \"NaN/1\" instead of the number of a vertex"
)]
#[case::nan_face_off(
    Format::Off,
    "OFF\n1 1 0\n0 0 0\n3 0 nan 0\n",
    "line 4: \"nan\" instead of the number of a vertex"
)]
#[case::nan_face_stl(
    Format::Stl,
    "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 NaN 0",
    "line 5: facet 0: \"nan\" instead of a finite coordinate"
)]
#[case::two_corners(Format::Obj, "v 0 0 0\nf 1 1 1\nf 1 1", "line 3: face 1 has 2 corners")]
#[case::no_corners(Format::Obj, "v 0 0 0\nf", "line 2: face 0 has 0 corners")]
#[case::stl_infinite(
    Format::Stl,
    "solid x\nfacet normal 0 0 1\nouter loop\nvertex inf 0 0",
    "line 4: facet 0: \"inf\""
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
    "line 4: ends before the number of a vertex for each corner"
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
#[case::coordinate(
    "property int z",
    "property int w",
    "element \"vertex\" lacks the property z"
)]
#[case::text(
    "property int z",
    "property list int int z",
    "property \"z\" of element \"vertex\" is not a number"
)]
#[case::float_indices(
    "int vertex_indices",
    "float vertex_indices",
    "property \"vertex_indices\" of element \"face\" is not a list of integers"
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
fn ply_faults_name_the_problem(#[case] good: &str, #[case] bad: &str, #[case] expected: &str) {
    assert!(TETRAHEDRON_PLY.contains(good));
    let text = TETRAHEDRON_PLY.replace(good, bad);
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
            first_vertex_number: 1
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
fn long_lines_are_quoted_in_part() {
    let text = format!("v 0 0 0\nf 1 1 {}\n", "é".repeat(10_000));
    let message = read(Format::Obj, text.as_bytes()).unwrap_err().to_string();
    assert!(
        message.len() < 1000 && message.starts_with("line 2: \"éé"),
        "{message}"
    );
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
    let folder = TriangleMesh::read(std::env::temp_dir()).unwrap_err();
    assert!(matches!(folder.fault, MeshFault::Folder), "{folder}");
    for name in ["part.step", "part", ".obj"] {
        let unknown = TriangleMesh::read(name).unwrap_err();
        assert!(
            matches!(unknown.fault, MeshFault::UnknownExtension { .. }),
            "{unknown}"
        );
    }
}

/// Tests that errors for common CAD and scene formats say how to convert the file to a mesh.
#[test]
fn files_of_other_programs_are_told_how_to_convert() {
    for (name, way) in [
        ("part.step", "gmsh part.step -2 -o part.stl"),
        ("PART.STP", "gmsh"),
        ("part.iges", "gmsh part.iges -2 -o part.stl"),
        ("part.sldprt", "export it there as .stl"),
        ("scene.fbx", "assimp export scene.fbx scene.glb"),
        ("scene.3ds", "assimp"),
        ("scene.blend", "Blender"),
        ("scene.usdz", "Blender"),
        ("arm.urdf", "the mesh of one link"),
        ("arm.xml", "the mesh of one link"),
        ("part.msh", "meshio"),
        (
            "part.3mf",
            "\"3mf\" is not the extension of a mesh; use .gltf, .glb, .dae, .obj, .stl, .ply or .off",
        ),
        ("part.txt", "use .gltf, .glb, .dae, .obj"),
        ("part", "use .gltf, .glb, .dae, .obj"),
    ] {
        let message = TriangleMesh::read(name).unwrap_err().to_string();
        assert!(message.contains(way), "{message}");
    }
}

/// Tests that a STEP file with the extension of another format is recognised.
#[test]
fn a_renamed_step_file_is_told_how_to_convert() {
    let step = "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n";
    for format in [
        Format::Stl,
        Format::Obj,
        Format::Ply,
        Format::Off,
        Format::Gltf,
        Format::Collada,
    ] {
        for text in [step.to_owned(), format!("\u{feff}\r\n{step}")] {
            let fault = format
                .parse(text.as_bytes(), &Default::default())
                .unwrap_err();
            let message = fault.to_string();
            assert!(
                message.starts_with("is a STEP file") && message.contains("gmsh part.step"),
                "{message}"
            );
        }
    }
}
