//! Tests how nodes place meshes, and which scene is read.

use super::{mesh_file, read, second_vertex};
use crate::test_files::Gltf;
use crate::{Format, TriangleMesh};
use ccd_core::glam::{DVec3, dvec3};
use proptest::prelude::*;
use rstest::rstest;
use serde_json::{Value, json};

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
fn nodes_are_placed_by_their_transforms(#[case] node: Value, #[case] expected: DVec3) {
    let mut gltf = Gltf::triangle();
    gltf.json["nodes"][0] = node;
    gltf.json["nodes"][0]["mesh"] = json!(0);
    assert_eq!(second_vertex(&gltf), expected);
}

/// Tests that a rotation quaternion in rounded f32 is normalized, so that it does not scale the mesh.
#[test]
fn rotations_are_made_unit_first() {
    let half = 0.707_106_77_f32;
    let mut gltf = Gltf::triangle();
    gltf.json["nodes"][0]["rotation"] = json!([0.0, 0.0, half, half]);
    let corner = second_vertex(&gltf);
    assert!((corner - DVec3::Y).length() < 1e-15, "{corner}");
}

proptest! {
    /// Tests that decimal numbers in the JSON are rounded to the nearest f64, as by Rust's own parser.
    #[test]
    fn numbers_are_rounded_to_the_nearest(digits in 0..u64::MAX, exponent in -30..10) {
        let text = format!("{digits}e{exponent}");
        let expected: f64 = text.parse().unwrap();
        prop_assume!(expected.abs() <= 1e12);
        let gltf = Gltf::triangle().with_value("nodes", json!([{"mesh": 0, "translation": [0, 0, 777]}]));
        let bytes = String::from_utf8(gltf.text_with_embedded_buffer()).unwrap().replace("777", &text);
        let mesh = TriangleMesh::from_reader(Format::Gltf, bytes.as_bytes()).unwrap();
        prop_assert_eq!(mesh.vertices()[0].z, expected);
    }
}

#[test]
fn nodes_are_placed_in_those_above_them() {
    let gltf = Gltf::triangle().with_value(
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

/// Tests that negative scales along an odd number of axes reverse the triangles, and along an even number do not.
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
    let gltf = gltf.with_value(
        "nodes",
        json!([{"children": [1], "scale": [1, -1, 1]}, {"mesh": 0, "scale": [1, 1, -3]}]),
    );
    assert_eq!(read(&gltf).faces(), [[0, 1, 2]]);
}

#[test]
fn a_mesh_may_be_used_twice() {
    let gltf = Gltf::triangle()
        .with_value("scenes", json!([{"nodes": [0, 1, 2]}]))
        .with_value(
            "nodes",
            json!([
                {"mesh": 0, "name": "left"},
                {"mesh": 0, "translation": [5, 0, 0]},
                {"mesh": 0, "name": "", "translation": [7, 0, 0]},
            ]),
        )
        .with_value(
            "meshes",
            json!([{"name": "tile", "primitives": [{"attributes": {"POSITION": 0}}]}]),
        );
    let file = mesh_file(&gltf);
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
        .with_value("scenes", json!([{}, {"nodes": [1]}, {"nodes": [0]}]))
        .with_value("nodes", json!([{"mesh": 0, "name": "a"}, {"mesh": 0, "name": "b", "children": [2]}, {"mesh": 0, "name": "c"}]));
    let names = |gltf: &Gltf| -> Vec<String> {
        let file = mesh_file(gltf);
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
    let mut gltf = Gltf::triangle().with_value(
        "nodes",
        json!([{"mesh": 0, "children": [1]}, {"scale": [0, 0, 0], "children": [2]}, {"mesh": 0}]),
    );
    assert_eq!(mesh_file(&gltf).part_names().count(), 1);
    // A node scaled to zero along one axis is read.
    gltf.json["nodes"][1]["scale"] = json!([1, 1, 0]);
    assert_eq!(mesh_file(&gltf).part_names().count(), 2);
}
