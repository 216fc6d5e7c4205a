use super::Format;
use crate::{MeshFault, Remarks, Repairs, TriangleMesh, write_obj};
use ccd_core::glam::DVec3;
use proptest::prelude::*;

mod faults;
mod flat_corners;
mod fuzz;
mod unread;

const TETRAHEDRON_OBJ: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// An OBJ with optional content: carriage returns, normals, relative indices, objects, materials, a continued line,
/// colours, a weight, and a byte that is not valid UTF-8.
const OBJ_WITH_OPTIONAL_CONTENT: &[u8] = b"# caf\xe9\r\nmtllib none.mtl\r\no first\r\nv 0 0 0 1\r\nv 1 0 0 0.5 0.5 0.5\r\n\
    v 0 1 0 # up\r\nvn 0 0 1\r\nvt 0 0\r\nusemtl red\r\nf 1/1/1 -1/-1/-1 2/1/1\r\ng second\r\nl 1 2\r\n\
    v 0 0 2 2\r\nf 1//1 2//1 \\\r\n  4//1\r\nusemtl blue\r\nf 2/1 3/1 4/1\r\ns off\r\nf +3 1 -1\r\n";

const TETRAHEDRON_STL: &str = "solid a tetrahedron\n\
    facet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n\
    facet normal 0 0 0\nouter loop\nvertex -0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n\
    endsolid\n\nSOLID\nFACET NORMAL 1 0 0\n  OUTER LOOP\nVERTEX 1.0E0 0 0\nVERTEX 0 1 0\nVERTEX 0 0 1\n\
    ENDLOOP\nENDFACET\nfacet normal 0 0 0\nouter loop\nvertex 0 1 0\nvertex 0 0 0\nvertex 0 0 1\nendloop\n\
    endfacet\nendsolid\n";

const TETRAHEDRON_PLY: &str = "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\n\
    property float x\nproperty double y\nproperty float nx\nproperty int z\nelement face 4\n\
    property uchar flags\nproperty list uchar int vertex_indices\nelement edge 1\nproperty int a\n\
    end_header\n0 0 7 0\n1 0 7 0\n0 1 7 0\n0 0 7 1\n9 3 0 2 1\n9 3 0 1 3\n9 3 1 2 3\n9 3 2 0 3\n5\n";

const TETRAHEDRON_OFF: &str = "COFF # colours\n\n4 4 6\n0 0 0 255 0 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n# the tip\n0 0 1\n\
    3 0 2 1\n3 0 1 3  0.5 0.5 0.5\n3 1 2 3\n3 2 0 3\n";

#[cfg(feature = "collada")]
const TETRAHEDRON_DAE: &str = r##"<COLLADA version="1.5.0"><library_geometries><geometry><mesh>
<source id="s"><float_array id="a">0 0 0 1 0 0 0 1 0 0 0 1</float_array><technique_common>
<accessor source="#a" count="4" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v"/><p>0 2 1 0 1 3 1 2 3 2 0 3</p></triangles>
</mesh></geometry></library_geometries></COLLADA>"##;

const TETRAHEDRON_POINTS: [[f32; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];
const TETRAHEDRON_FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

/// Returns a binary STL of a tetrahedron whose header begins with `solid`, like a text STL.
fn binary_stl() -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes[..10].copy_from_slice(b"solid bin\n");
    bytes.extend(4_u32.to_le_bytes());
    for face in TETRAHEDRON_FACES {
        let corners = face.map(|v| TETRAHEDRON_POINTS[v as usize]);
        let numbers = [[0.0; 3]].into_iter().chain(corners).flatten();
        bytes.extend(numbers.flat_map(f32::to_le_bytes));
        bytes.extend([0; 2]);
    }
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
    for face in TETRAHEDRON_FACES {
        bytes.push(3);
        bytes.extend(face.iter().flat_map(|v| {
            if little {
                v.to_le_bytes()
            } else {
                v.to_be_bytes()
            }
        }));
    }
    for x in TETRAHEDRON_POINTS.iter().flatten().map(|&x| f64::from(x)) {
        bytes.extend(if little {
            x.to_le_bytes()
        } else {
            x.to_be_bytes()
        });
    }
    bytes
}

/// Returns a glTF of the same tetrahedron as the files of the other formats.
#[cfg(feature = "gltf")]
fn tetrahedron_gltf() -> crate::test_files::Gltf {
    let mut gltf = crate::test_files::Gltf::new();
    let position = gltf.add_vec3_accessor(&TETRAHEDRON_POINTS);
    let indices = gltf.add_index_accessor(
        TETRAHEDRON_FACES
            .as_flattened()
            .iter()
            .map(|&v| v as u16)
            .collect::<Vec<_>>()
            .as_slice(),
    );
    gltf.add_primitive(
        serde_json::json!({"attributes": {"POSITION": position}, "indices": indices}),
    );
    gltf
}

fn valid_files() -> Vec<(Format, Vec<u8>)> {
    vec![
        (Format::Obj, TETRAHEDRON_OBJ.into()),
        (Format::Obj, OBJ_WITH_OPTIONAL_CONTENT.into()),
        (Format::Stl, TETRAHEDRON_STL.into()),
        (Format::Stl, binary_stl()),
        (Format::Ply, TETRAHEDRON_PLY.into()),
        (Format::Ply, binary_ply("little")),
        (Format::Ply, binary_ply("big")),
        (Format::Off, TETRAHEDRON_OFF.into()),
        #[cfg(feature = "gltf")]
        (Format::Gltf, tetrahedron_gltf().text_with_embedded_buffer()),
        #[cfg(feature = "gltf")]
        (Format::Gltf, tetrahedron_gltf().glb()),
        #[cfg(feature = "collada")]
        (Format::Collada, TETRAHEDRON_DAE.into()),
    ]
}

fn read(format: Format, bytes: &[u8]) -> Result<TriangleMesh, MeshFault> {
    TriangleMesh::from_reader(format, bytes).map_err(|error| error.fault)
}

/// Returns the corner points of all triangles, independent of the numbering of the vertices.
fn corners(mesh: &TriangleMesh) -> Vec<[DVec3; 3]> {
    let point = |v: u32| mesh.vertices()[v as usize];
    mesh.faces().iter().map(|face| face.map(point)).collect()
}

#[test]
fn all_formats_read_the_same_tetrahedron() {
    let expected: Vec<[DVec3; 3]> = TETRAHEDRON_FACES
        .iter()
        .map(|face| {
            face.map(|v| {
                ccd_core::glam::Vec3::from_array(TETRAHEDRON_POINTS[v as usize]).as_dvec3()
            })
        })
        .collect();
    for (format, bytes) in valid_files() {
        let mesh = read(format, &bytes).unwrap();
        assert_eq!(corners(&mesh), expected, "{format:?}");
        assert_eq!(mesh.vertices().len(), 4, "{format:?}");
        assert_eq!(mesh.face_ids(), [0, 1, 2, 3], "{format:?}");
        let repairs = Repairs {
            remarks: Remarks::default(),
            ..mesh.repairs().clone()
        };
        assert!(repairs.is_empty(), "{format:?}: {repairs}");
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
    assert_eq!(
        mesh.repairs().unreferenced_vertices.first_elements(),
        [0, 4]
    );
}

#[test]
fn obj_of_three_vertices_and_of_few_polygons() {
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

/// Tests that the keywords at the end of an element may be two words, as some programs write them.
#[test]
fn stl_reads_ends_of_two_words() {
    let apart = ["solid", "loop", "facet"]
        .iter()
        .fold(TETRAHEDRON_STL.to_owned(), |text, word| {
            text.replace(&format!("end{word}"), &format!("end {word}"))
        });
    assert_eq!(apart.matches("end solid").count(), 2);
    for text in [
        apart.clone(),
        apart.replace("end solid\n\n", "  End\tSolid a tetrahedron\n"),
    ] {
        let mesh = read(Format::Stl, text.as_bytes()).unwrap();
        assert_eq!(
            corners(&mesh),
            corners(&read(Format::Stl, TETRAHEDRON_STL.as_bytes()).unwrap())
        );
    }
    let fault = read(Format::Stl, b"solid\nend\n").unwrap_err();
    assert!(fault.to_string().contains("\"end\" instead of"), "{fault}");
}

#[test]
fn a_byte_order_mark_hides_no_vertex() {
    let marked = ["\u{feff}", TETRAHEDRON_OBJ].concat();
    let mesh = read(Format::Obj, marked.as_bytes()).unwrap();
    assert_eq!(mesh.vertices().len(), 4);
}

#[test]
fn a_pointer_of_git_lfs_is_recognised() {
    let pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 12\n";
    for (format, _) in valid_files() {
        let fault = read(format, pointer).unwrap_err();
        assert!(
            matches!(fault, MeshFault::LfsPointer),
            "{format:?}: {fault}"
        );
        assert!(fault.to_string().contains("git lfs pull"), "{fault}");
    }
}

/// Tests that the page which some servers send for any path is not taken for an empty or a damaged mesh.
#[test]
fn a_page_of_html_is_recognised() {
    for page in [
        "<!DOCTYPE html>\n<html></html>",
        "\u{feff} <html lang='en'>",
    ] {
        for (format, _) in valid_files() {
            let fault = read(format, page.as_bytes()).unwrap_err();
            assert!(matches!(fault, MeshFault::Html), "{format:?}: {fault}");
        }
    }
}

/// Tests that the error for a format that is not compiled in names the Cargo feature to enable.
#[test]
fn a_format_that_is_not_built_is_named() {
    for (format, name, is_built) in [
        (Format::Gltf, "gltf", cfg!(feature = "gltf")),
        (Format::Collada, "collada", cfg!(feature = "collada")),
    ] {
        let fault = read(format, b"anything").unwrap_err();
        let is_missing = matches!(fault, MeshFault::MissingFeature { .. });
        assert_eq!(is_missing, !is_built, "{fault}");
        let names_feature = fault.to_string().contains(&format!("feature {name:?}"));
        assert_eq!(names_feature, !is_built, "{fault}");
    }
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

proptest! {
    #[test]
    fn a_written_obj_reads_back_to_the_same_bits(
        points in prop::collection::vec(prop::array::uniform3(-1e12..1e12), 3..20),
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
