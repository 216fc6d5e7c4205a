//! Tests every mode of glTF primitives, and every kind of accessor.

use super::{error, gltf_with_square_points, mesh_file, read, second_vertex};
use crate::test_files::Gltf;
use ccd_core::glam::{DVec3, dvec3};
use rstest::rstest;
use serde_json::{Value, json};

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
    let mut gltf = gltf_with_square_points();
    let indices = gltf.add_index_accessor(corners);
    let mut primitive = json!({"attributes": {"POSITION": 0, "NORMAL": 0}, "indices": indices});
    if !mode.is_null() {
        primitive["mode"] = mode;
    }
    gltf.add_primitive(primitive);
    assert_eq!(read(&gltf).faces(), faces);
}

#[test]
fn corners_may_go_without_indices() {
    for (mode, expected) in [
        (4, vec![[0, 1, 2]]),
        (5, vec![[0, 1, 2], [1, 3, 2]]),
        (6, vec![[1, 2, 0], [2, 3, 0]]),
    ] {
        let mut gltf = if mode == 4 {
            Gltf::new()
        } else {
            gltf_with_square_points()
        };
        if mode == 4 {
            gltf.add_vec3_accessor(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]]);
        }
        gltf.add_primitive(json!({"attributes": {"POSITION": 0}, "mode": mode}));
        assert_eq!(read(&gltf).faces(), expected, "mode {mode}");
    }
}

#[test]
fn points_and_lines_are_passed_over() {
    let mut gltf = gltf_with_square_points();
    for mode in 0..4 {
        gltf.add_primitive(json!({"attributes": {"POSITION": 0}, "mode": mode}));
    }
    assert!(
        error(&gltf).to_string().starts_with("has no "),
        "{}",
        error(&gltf)
    );
    // Parts without faces are omitted.
    assert_eq!(mesh_file(&gltf).part_names().len(), 0);
    // Primitives without positions are skipped, too.
    gltf.add_primitive(json!({"attributes": {"TEXCOORD_0": 7}}));
    let indices = gltf.add_index_accessor(&[0, 1, 2]);
    gltf.add_primitive(json!({"attributes": {"POSITION": 0}, "indices": indices}));
    assert_eq!(read(&gltf).faces(), [[0, 1, 2]]);
}

#[test]
fn primitives_share_the_vertices_of_an_accessor() {
    let mut gltf = gltf_with_square_points();
    for corners in [[0, 1, 2], [0, 2, 3]] {
        let indices = gltf.add_index_accessor(&corners);
        gltf.add_primitive(json!({"attributes": {"POSITION": 0}, "indices": indices}));
    }
    let other = gltf.add_vec3_accessor(&[[5., 0., 0.], [6., 0., 0.], [5., 1., 0.]]);
    gltf.add_primitive(json!({"attributes": {"POSITION": other}}));
    let mesh = read(&gltf);
    assert_eq!(mesh.vertices().len(), 7);
    assert_eq!(mesh.faces(), [[0, 1, 2], [0, 2, 3], [4, 5, 6]]);
    assert_eq!(mesh.face_ids(), [0, 1, 2]);
    assert_eq!(mesh_file(&gltf).part_names().count(), 1);
}

#[test]
fn indices_are_of_any_size() {
    for (kind, bytes) in [
        (5121, vec![0, 1, 2]),
        (5123, vec![0, 0, 1, 0, 2, 0]),
        (5125, vec![0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]),
    ] {
        let mut gltf = gltf_with_square_points();
        let view = gltf.add_buffer_view(&bytes);
        let indices = gltf.push(
            "accessors",
            json!({"bufferView": view, "componentType": kind, "count": 3, "type": "SCALAR"}),
        );
        gltf.add_primitive(json!({"attributes": {"POSITION": 0}, "indices": indices}));
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
    let view = gltf.add_buffer_view(&bytes);
    gltf.json["bufferViews"][view]["byteStride"] = json!(20);
    let about = json!({"bufferView": view, "byteOffset": 4, "componentType": 5126, "count": 3, "type": "VEC3"});
    gltf.push("accessors", about);
    gltf.add_primitive(json!({"attributes": {"POSITION": 0}}));
    assert_eq!(read(&gltf).vertices(), [DVec3::ZERO, DVec3::X, DVec3::Y]);
}

/// Tests that integer components are read as coordinates or, if normalized, as fractions of their type's largest value.
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
    let mut gltf = Gltf::new().with_value("extensionsRequired", json!(["KHR_mesh_quantization"]));
    let stride = bytes.len().next_multiple_of(4);
    let mut rows = vec![0; 3 * stride];
    rows[stride..][..bytes.len()].copy_from_slice(bytes);
    rows[2 * stride] = 9;
    let view = gltf.add_buffer_view(&rows);
    gltf.json["bufferViews"][view]["byteStride"] = json!(stride);
    let about = json!({"bufferView": view, "componentType": kind, "normalized": normalized, "count": 3, "type": "VEC3"});
    gltf.push("accessors", about);
    gltf.add_primitive(json!({"attributes": {"POSITION": 0}}));
    assert_eq!(second_vertex(&gltf), expected);
}

#[test]
fn sparse_accessors_replace_elements() {
    for with_base in [true, false] {
        let mut gltf = Gltf::new();
        let base = gltf.add_vec3_accessor(&[[7., 7., 7.], [0., 0., 0.], [0., 1., 0.]]);
        let places = gltf.add_buffer_view(&[0, 1]);
        let bytes: Vec<u8> = [0., 0., 3., 1., 0., 0.]
            .iter()
            .flat_map(|x: &f32| x.to_le_bytes())
            .collect();
        let values = gltf.add_buffer_view(&bytes);
        let about = &mut gltf.json["accessors"][base];
        about["sparse"] = json!({
            "count": 2,
            "indices": {"bufferView": places, "componentType": 5121},
            "values": {"bufferView": values},
        });
        if !with_base {
            about.as_object_mut().unwrap().remove("bufferView");
        }
        gltf.add_primitive(json!({"attributes": {"POSITION": base}}));
        let last = if with_base { DVec3::Y } else { DVec3::ZERO };
        assert_eq!(read(&gltf).vertices(), [3.0 * DVec3::Z, DVec3::X, last]);
    }
}

#[test]
fn indices_may_be_sparse() {
    let mut gltf = gltf_with_square_points();
    let indices = gltf.add_index_accessor(&[0, 1, 1]);
    let places = gltf.add_buffer_view(&[2, 0, 0, 0]);
    let values = gltf.add_buffer_view(&[2, 0]);
    gltf.json["accessors"][indices]["sparse"] = json!({
        "count": 1,
        "indices": {"bufferView": places, "componentType": 5125},
        "values": {"bufferView": values},
    });
    gltf.add_primitive(json!({"attributes": {"POSITION": 0}, "indices": indices}));
    assert_eq!(read(&gltf).faces(), [[0, 1, 2]]);
}
