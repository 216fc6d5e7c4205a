//! What a glTF may hold, and that it is read as the specification says. What it must not hold is in `faults`.

mod faults;

use crate::test_files::Gltf;
use crate::{Format, MeshError, MeshFile, TriangleMesh, Unit};
use ccd_core::glam::{DVec3, dvec3};
use rstest::rstest;
use serde_json::{Value, json};

fn file(gltf: &Gltf) -> MeshFile {
    MeshFile::from_reader(Format::Gltf, &gltf.glb()[..]).unwrap()
}

fn read(gltf: &Gltf) -> TriangleMesh {
    file(gltf).into_mesh().unwrap()
}

fn error(gltf: &Gltf) -> MeshError {
    let read = TriangleMesh::from_reader(Format::Gltf, &gltf.glb()[..]);
    read.err().expect("a fault")
}

fn corner(gltf: &Gltf) -> DVec3 {
    read(gltf).vertices()[1]
}

/// Two triangles of four corners of a square.
fn square() -> Gltf {
    let mut gltf = Gltf::new();
    gltf.floats(&[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]]);
    gltf
}

#[test]
fn text_and_binary_are_the_same() {
    let gltf = Gltf::triangle();
    for bytes in [
        gltf.glb(),
        gltf.text(),
        [b"\xef\xbb\xbf", &gltf.text()[..]].concat(),
    ] {
        let mesh = TriangleMesh::from_reader(Format::Gltf, &bytes[..]).unwrap();
        assert_eq!(mesh.vertices(), [DVec3::ZERO, DVec3::X, DVec3::Y]);
        assert_eq!(mesh.faces(), [[0, 1, 2]]);
        assert!(mesh.repairs().is_empty());
    }
}

#[rstest]
#[case::triangles(json!(4), &[0, 1, 2, 0, 2, 3], &[[0, 1, 2], [0, 2, 3]])]
#[case::default(Value::Null, &[3, 2, 1], &[[3, 2, 1]])]
#[case::strip(json!(5), &[0, 1, 3, 2], &[[0, 1, 3], [1, 2, 3]])]
#[case::fan(json!(6), &[0, 1, 2, 3], &[[1, 2, 0], [2, 3, 0]])]
fn every_mode_of_triangles_is_read(
    #[case] mode: Value,
    #[case] corners: &[u16],
    #[case] faces: &[[u32; 3]],
) {
    let mut gltf = square();
    let indices = gltf.indices(corners);
    let mut primitive = json!({"attributes": {"POSITION": 0, "NORMAL": 0}, "indices": indices});
    if !mode.is_null() {
        primitive["mode"] = mode;
    }
    gltf.primitive(primitive);
    assert_eq!(read(&gltf).faces(), faces);
}

#[test]
fn corners_may_go_without_indices() {
    for (mode, expected) in [
        (4, vec![[0, 1, 2]]),
        (5, vec![[0, 1, 2], [1, 3, 2]]),
        (6, vec![[1, 2, 0], [2, 3, 0]]),
    ] {
        let mut gltf = if mode == 4 { Gltf::new() } else { square() };
        if mode == 4 {
            gltf.floats(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]]);
        }
        gltf.primitive(json!({"attributes": {"POSITION": 0}, "mode": mode}));
        assert_eq!(read(&gltf).faces(), expected, "mode {mode}");
    }
}

#[test]
fn points_and_lines_are_passed_over() {
    let mut gltf = square();
    for mode in 0..4 {
        gltf.primitive(json!({"attributes": {"POSITION": 0}, "mode": mode}));
    }
    assert!(
        error(&gltf).to_string().starts_with("has no "),
        "{}",
        error(&gltf)
    );
    // So is what has no positions at all.
    gltf.primitive(json!({"attributes": {"TEXCOORD_0": 7}}));
    let indices = gltf.indices(&[0, 1, 2]);
    gltf.primitive(json!({"attributes": {"POSITION": 0}, "indices": indices}));
    assert_eq!(read(&gltf).faces(), [[0, 1, 2]]);
}

#[test]
fn primitives_share_the_vertices_of_an_accessor() {
    let mut gltf = square();
    for corners in [[0, 1, 2], [0, 2, 3]] {
        let indices = gltf.indices(&corners);
        gltf.primitive(json!({"attributes": {"POSITION": 0}, "indices": indices}));
    }
    let other = gltf.floats(&[[5., 0., 0.], [6., 0., 0.], [5., 1., 0.]]);
    gltf.primitive(json!({"attributes": {"POSITION": other}}));
    let mesh = read(&gltf);
    assert_eq!(mesh.vertices().len(), 7);
    assert_eq!(mesh.faces(), [[0, 1, 2], [0, 2, 3], [4, 5, 6]]);
    assert_eq!(mesh.face_ids(), [0, 1, 2]);
    assert_eq!(file(&gltf).part_names().count(), 1);
}

#[test]
fn indices_are_of_any_size() {
    for (kind, bytes) in [
        (5121, vec![0, 1, 2]),
        (5123, vec![0, 0, 1, 0, 2, 0]),
        (5125, vec![0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]),
    ] {
        let mut gltf = square();
        let view = gltf.view(&bytes);
        let indices = gltf.push(
            "accessors",
            json!({"bufferView": view, "componentType": kind, "count": 3, "type": "SCALAR"}),
        );
        gltf.primitive(json!({"attributes": {"POSITION": 0}, "indices": indices}));
        assert_eq!(read(&gltf).faces(), [[0, 1, 2]]);
    }
}

#[test]
fn vertices_may_be_interleaved_with_other_data() {
    let mut gltf = Gltf::new();
    let rows: Vec<f32> = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]]
        .into_iter()
        .flat_map(|[x, y, z]: [f32; 3]| [7., x, y, z, 8.])
        .collect();
    // The last row ends with its position.
    let bytes: Vec<u8> = rows[..14].iter().flat_map(|x| x.to_le_bytes()).collect();
    let view = gltf.view(&bytes);
    gltf.json["bufferViews"][view]["byteStride"] = json!(20);
    let about = json!({"bufferView": view, "byteOffset": 4, "componentType": 5126, "count": 3, "type": "VEC3"});
    gltf.push("accessors", about);
    gltf.primitive(json!({"attributes": {"POSITION": 0}}));
    assert_eq!(read(&gltf).vertices(), [DVec3::ZERO, DVec3::X, DVec3::Y]);
}

/// Integers stand for themselves or, normalized, for fractions of the largest one.
#[rstest]
#[case::bytes(5120, false, &[1, 0x80, 0], dvec3(1.0, -128.0, 0.0))]
#[case::fractions_of_bytes(5120, true, &[127, 0x80, 0x81], dvec3(1.0, -1.0, -1.0))]
#[case::unsigned_bytes(5121, false, &[1, 255, 0], dvec3(1.0, 255.0, 0.0))]
#[case::fractions_of_unsigned_bytes(5121, true, &[51, 255, 0], dvec3(0.2, 1.0, 0.0))]
#[case::shorts(5122, false, &[0, 1, 0xff, 0xff, 0, 0x80], dvec3(256.0, -1.0, -32768.0))]
#[case::fractions_of_shorts(5122, true, &[0xff, 0x7f, 1, 0x80, 0, 0x80], dvec3(1.0, -1.0, -1.0))]
#[case::unsigned_shorts(5123, false, &[0, 1, 0xff, 0xff, 0, 0], dvec3(256.0, 65535.0, 0.0))]
#[case::fractions_of_unsigned_shorts(5123, true, &[0x33, 0x33, 0xff, 0xff, 0, 0], dvec3(0.2, 1.0, 0.0))]
fn quantized_positions_are_read(
    #[case] kind: u32,
    #[case] normalized: bool,
    #[case] bytes: &[u8],
    #[case] expected: DVec3,
) {
    let mut gltf = Gltf::new().set("extensionsRequired", json!(["KHR_mesh_quantization"]));
    let stride = bytes.len().next_multiple_of(4);
    let mut rows = vec![0; 3 * stride];
    rows[stride..][..bytes.len()].copy_from_slice(bytes);
    rows[2 * stride] = 9;
    let view = gltf.view(&rows);
    gltf.json["bufferViews"][view]["byteStride"] = json!(stride);
    let about = json!({"bufferView": view, "componentType": kind, "normalized": normalized, "count": 3, "type": "VEC3"});
    gltf.push("accessors", about);
    gltf.primitive(json!({"attributes": {"POSITION": 0}}));
    assert_eq!(corner(&gltf), expected);
}

#[test]
fn sparse_accessors_replace_elements() {
    for with_base in [true, false] {
        let mut gltf = Gltf::new();
        let base = gltf.floats(&[[7., 7., 7.], [0., 0., 0.], [0., 1., 0.]]);
        let places = gltf.view(&[0, 1]);
        let bytes: Vec<u8> = [0., 0., 3., 1., 0., 0.]
            .iter()
            .flat_map(|x: &f32| x.to_le_bytes())
            .collect();
        let values = gltf.view(&bytes);
        let about = &mut gltf.json["accessors"][base];
        about["sparse"] = json!({
            "count": 2,
            "indices": {"bufferView": places, "componentType": 5121},
            "values": {"bufferView": values},
        });
        if !with_base {
            about.as_object_mut().unwrap().remove("bufferView");
        }
        gltf.primitive(json!({"attributes": {"POSITION": base}}));
        let last = if with_base { DVec3::Y } else { DVec3::ZERO };
        assert_eq!(read(&gltf).vertices(), [3.0 * DVec3::Z, DVec3::X, last]);
    }
}

#[test]
fn indices_may_be_sparse() {
    let mut gltf = square();
    let indices = gltf.indices(&[0, 1, 1]);
    let places = gltf.view(&[2, 0, 0, 0]);
    let values = gltf.view(&[2, 0]);
    gltf.json["accessors"][indices]["sparse"] = json!({
        "count": 1,
        "indices": {"bufferView": places, "componentType": 5125},
        "values": {"bufferView": values},
    });
    gltf.primitive(json!({"attributes": {"POSITION": 0}, "indices": indices}));
    assert_eq!(read(&gltf).faces(), [[0, 1, 2]]);
}

#[rstest]
#[case::none(json!({}), DVec3::X)]
#[case::translation(json!({"translation": [1, 0.1, -2]}), dvec3(2.0, 0.1, -2.0))]
#[case::scale(json!({"scale": [3, 1, 1]}), dvec3(3.0, 0.0, 0.0))]
#[case::rotation(json!({"rotation": [0, 0, 1, 0]}), dvec3(-1.0, 0.0, 0.0))]
#[case::longer_rotation(json!({"rotation": [0, 0, 2e200, 0]}), dvec3(-1.0, 0.0, 0.0))]
#[case::all(
    json!({"translation": [0, 0, 5], "rotation": [0, 0, 1, 0], "scale": [2, 1, 1]}),
    dvec3(-2.0, 0.0, 5.0)
)]
#[case::matrix(json!({"matrix": [0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 4, 5, 6, 1]}), dvec3(4.0, 7.0, 6.0))]
fn nodes_are_placed(#[case] node: Value, #[case] expected: DVec3) {
    let mut gltf = Gltf::triangle();
    gltf.json["nodes"][0] = node;
    gltf.json["nodes"][0]["mesh"] = json!(0);
    assert_eq!(corner(&gltf), expected);
}

/// A rotation whose floats have been rounded does not scale.
#[test]
fn rotations_are_made_unit_first() {
    let half = 0.707_106_77_f32;
    let mut gltf = Gltf::triangle();
    gltf.json["nodes"][0]["rotation"] = json!([0.0, 0.0, half, half]);
    let corner = corner(&gltf);
    assert!((corner - DVec3::Y).length() < 1e-15, "{corner}");
}

#[test]
fn nodes_are_placed_in_those_above_them() {
    let gltf = Gltf::triangle().set(
        "nodes",
        json!([
            {"children": [1], "translation": [10, 0, 0]},
            {"children": [2], "rotation": [0, 0, 1, 0]},
            {"children": [3], "matrix": [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 1, 1]},
            {"mesh": 0, "translation": [0, 1, 0]},
        ]),
    );
    let mesh = read(&gltf);
    assert_eq!(
        mesh.vertices(),
        [
            dvec3(10.0, -2.0, 1.0),
            dvec3(8.0, -2.0, 1.0),
            dvec3(10.0, -4.0, 1.0)
        ]
    );
}

/// A node that mirrors turns the triangles round, one that mirrors twice does not.
#[test]
fn mirrored_nodes_turn_the_faces_round() {
    let mut gltf = Gltf::triangle();
    for (scale, faces) in [
        ([-1, 1, 1], [[0, 2, 1]]),
        ([-1, 1, -1], [[0, 1, 2]]),
        ([-1, -1, -1], [[0, 2, 1]]),
    ] {
        gltf.json["nodes"][0]["scale"] = json!(scale);
        assert_eq!(read(&gltf).faces(), faces);
    }
    let gltf = gltf.set(
        "nodes",
        json!([{"children": [1], "scale": [1, -1, 1]}, {"mesh": 0, "scale": [1, 1, -3]}]),
    );
    assert_eq!(read(&gltf).faces(), [[0, 1, 2]]);
}

#[test]
fn a_mesh_may_be_used_twice() {
    let gltf = Gltf::triangle()
        .set("scenes", json!([{"nodes": [0, 1, 2]}]))
        .set(
            "nodes",
            json!([
                {"mesh": 0, "name": "left"},
                {"mesh": 0, "translation": [5, 0, 0]},
                {"mesh": 0, "name": "", "translation": [7, 0, 0]},
            ]),
        )
        .set(
            "meshes",
            json!([{"name": "tile", "primitives": [{"attributes": {"POSITION": 0}}]}]),
        );
    let file = file(&gltf);
    let names: Vec<_> = file.part_names().collect();
    assert_eq!(names, [Some("left"), Some("tile"), Some("tile")]);
    assert_eq!(file.part("left").unwrap().vertices()[0], DVec3::ZERO);
    assert_eq!(file.part("2").unwrap().vertices()[0].x, 7.0);
    let error = file.part("tile").unwrap_err().to_string();
    assert_eq!(error, r#"has 2 parts "tile"; give the number of one: 1, 2"#);
    let mesh = file.into_mesh().unwrap();
    assert_eq!(mesh.faces(), [[0, 1, 2], [3, 4, 5], [6, 7, 8]]);
}

#[test]
fn the_scene_that_is_shown_is_read() {
    let mut gltf = Gltf::triangle()
        .set("scenes", json!([{}, {"nodes": [1]}, {"nodes": [0]}]))
        .set("nodes", json!([{"mesh": 0, "name": "a"}, {"mesh": 0, "name": "b", "children": [2]}, {"mesh": 0, "name": "c"}]));
    let names = |gltf: &Gltf| -> Vec<String> {
        let file = file(gltf);
        file.part_names()
            .map(|name| name.unwrap().to_owned())
            .collect()
    };
    gltf.json["scene"] = json!(1);
    assert_eq!(names(&gltf), ["b", "c"]);
    gltf.json["scene"] = json!(2);
    assert_eq!(names(&gltf), ["a"]);
    gltf.json.as_object_mut().unwrap().remove("scene");
    assert!(names(&gltf).is_empty());
    gltf.json.as_object_mut().unwrap().remove("scenes");
    assert_eq!(names(&gltf), ["a", "b", "c"]);
    // A library of meshes has no nodes.
    gltf.json.as_object_mut().unwrap().remove("nodes");
    assert_eq!(read(&gltf).faces().len(), 1);
}

#[test]
fn what_is_scaled_to_nothing_is_hidden() {
    let mut gltf = Gltf::triangle().set(
        "nodes",
        json!([{"mesh": 0, "children": [1]}, {"scale": [0, 0, 0], "children": [2]}, {"mesh": 0}]),
    );
    assert_eq!(file(&gltf).part_names().count(), 1);
    // What is scaled flat is not.
    gltf.json["nodes"][1]["scale"] = json!([1, 1, 0]);
    assert_eq!(file(&gltf).part_names().count(), 2);
}

#[test]
fn metres_are_converted() {
    let mut gltf = Gltf::new();
    gltf.floats(&[[0., 0., 0.], [0.1, 0., 0.], [0., 1., 0.]]);
    gltf.primitive(json!({"attributes": {"POSITION": 0}}));
    assert_eq!(file(&gltf).unit(), Some(Unit::Metre));
    assert_eq!(corner(&gltf).x, f64::from(0.1_f32));
    let file = file(&gltf).in_unit(Unit::Millimetre);
    assert_eq!(file.unit(), Some(Unit::Millimetre));
    assert_eq!(
        file.into_mesh().unwrap().vertices()[1].x,
        f64::from(0.1_f32) * 1000.0
    );
}

#[test]
fn extensions_about_looks_do_not_hinder() {
    let required = json!([
        "KHR_materials_unlit",
        "KHR_texture_transform",
        "EXT_texture_webp",
        "KHR_mesh_quantization"
    ]);
    let gltf = Gltf::triangle()
        .set("extensionsRequired", required)
        .set(
            "materials",
            json!([{"pbrMetallicRoughness": {"baseColorFactor": [1, 1]}}]),
        )
        .set("skins", json!("anything"));
    assert_eq!(read(&gltf).faces().len(), 1);
}

/// Draco and meshopt may come with the plain data, for those that cannot read them.
#[test]
fn data_beside_a_compression_is_read() {
    let mut gltf = Gltf::triangle().set(
        "extensionsUsed",
        json!(["KHR_draco_mesh_compression", "EXT_meshopt_compression"]),
    );
    gltf.json["meshes"][0]["primitives"][0]["extensions"] =
        json!({"KHR_draco_mesh_compression": {"bufferView": 9}});
    gltf.json["bufferViews"][0]["extensions"] = json!({"EXT_meshopt_compression": {"buffer": 1}});
    assert_eq!(read(&gltf).faces().len(), 1);
}
