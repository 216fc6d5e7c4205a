//! Tests the error message for every kind of invalid glTF.

use super::{error, gltf_with_square_points, read};
use crate::test_files::Gltf;
use crate::{Format, MeshFault, TriangleMesh};
use rstest::rstest;
use serde_json::{Value, json};

/// Returns a valid triangle as glTF, with the JSON value at `path` replaced.
fn triangle_with_value_at(path: &str, value: Value) -> Gltf {
    let mut gltf = Gltf::triangle();
    gltf.json["buffers"] = json!([{"byteLength": 36}]);
    let (parent, key) = path.rsplit_once('/').expect("a path");
    let parent = gltf.json.pointer_mut(parent).expect("a parent");
    match key.parse::<usize>() {
        Ok(k) => parent[k] = value,
        Err(_) => parent[key] = value,
    }
    gltf
}

#[rstest]
#[case::version("/asset", json!({"version": "1.0"}), "holds glTF of version \"1.0\"")]
#[case::no_version("/asset", json!({}), "missing field `version`")]
#[case::scene("/scene", json!(1), "names scene 1, but there are 1, numbered from 0")]
#[case::node("/scenes/0/nodes", json!([7]), "names node 7, but there are 1")]
#[case::child("/nodes/0/children", json!([2]), "names node 2, but there are 1")]
#[case::mesh("/nodes/0/mesh", json!(3), "node 0: names mesh 3, but there are 1")]
#[case::accessor("/meshes/0/primitives/0/attributes/POSITION", json!(9), "mesh 0: primitive 0: names accessor 9, but there are 1")]
#[case::indices("/meshes/0/primitives/0/indices", json!(4), "mesh 0: primitive 0: names accessor 4")]
#[case::mode("/meshes/0/primitives/0/mode", json!(7), "primitive 0: is of mode 7")]
#[case::attributes("/meshes/0/primitives/0", json!({}), "missing field `attributes`")]
#[case::view("/accessors/0/bufferView", json!(1), "accessor 0: names buffer view 1, but there are 1")]
#[case::offset("/accessors/0/byteOffset", json!(4), "accessor 0: ends before all 3 elements of 12 bytes in buffer view 0")]
#[case::far_offset("/accessors/0/byteOffset", json!(u64::MAX), "buffer view 0: reaches beyond buffer 0")]
#[case::component("/accessors/0/componentType", json!(5130), "accessor 0: has components of type 5130, which there is not")]
#[case::kind("/accessors/0/type", json!("VEC2"), "accessor 0: is of type \"VEC2\" instead of VEC3")]
#[case::count("/accessors/0/count", json!(4), "ends before all 4 elements")]
#[case::many("/accessors/0/count", json!(u64::MAX), "ends before all 18446744073709551615 elements")]
#[case::huge("/accessors/0/count", json!(1_u64 << 62), "ends before all 4611686018427387904 elements")]
#[case::negative("/accessors/0/count", json!(-1), "invalid value: integer `-1`")]
#[case::no_view("/accessors/0", json!({"componentType": 5126, "count": 3, "type": "VEC3"}), "accessor 0: has no buffer view")]
#[case::stride("/bufferViews/0/byteStride", json!(8), "has elements of 12 bytes every 8 bytes")]
#[case::wide("/bufferViews/0/byteStride", json!(u64::MAX), "ends before all 3 elements")]
#[case::buffer("/bufferViews/0/buffer", json!(1), "buffer view 0: names buffer 1, but there are 1")]
#[case::length("/bufferViews/0/byteLength", json!(37), "buffer view 0: reaches beyond buffer 0, which has 36 bytes")]
#[case::overflow("/bufferViews/0", json!({"buffer": 0, "byteOffset": u64::MAX, "byteLength": u64::MAX}), "reaches beyond buffer 0")]
#[case::short("/buffers/0/byteLength", json!(40), "buffer 0: ends before byte 36 of 40")]
#[case::data("/buffers/0/uri", json!("data:,abc"), "buffer 0: its data is not in base64")]
#[case::base64("/buffers/0/uri", json!("data:;base64,&"), "buffer 0: its base64 is not valid")]
#[case::matrix("/nodes/0/matrix", json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2]), "node 0: has a matrix that is not affine")]
#[case::matrix_and_more("/nodes/0", json!({"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], "translation": [1, 0, 0]}), "node 0: has a matrix beside a translation")]
#[case::misspelt("/meshes/0/primitives/0/attributes", json!({"Position": 0}), "mesh 0: primitive 0: has an attribute \"Position\", which there is not")]
#[case::unnumbered("/meshes/0/primitives/0/attributes", json!({"POSITION": 0, "COLOR": 0}), "has an attribute \"COLOR\"")]
#[case::short_matrix("/nodes/0/matrix", json!([1, 2, 3]), "invalid length 3")]
#[case::rotation("/nodes/0/rotation", json!([0, 0, 0, 0]), "node 0: has a rotation or translation that is none")]
#[case::far("/nodes/0/translation", json!([1e300, 0, 0]), "vertex 0 has a coordinate beyond")]
#[case::zero("/nodes/0/scale", json!([0, 0, 0]), "has no ")]
#[case::draco_fault("/extensionsRequired", json!(["KHR_draco_mesh_compression"]), "compressed by Draco (KHR_draco_mesh_compression), which is not supported; export it as glTF without compression")]
#[case::meshopt_fault("/extensionsRequired", json!(["EXT_meshopt_compression"]), "compressed by meshopt (EXT_meshopt_compression)")]
#[case::newer_meshopt("/extensionsRequired", json!(["KHR_meshopt_compression"]), "compressed by meshopt")]
#[case::unknown("/extensionsRequired", json!(["ACME_fractal"]), "what the extension \"ACME_fractal\" says, which is not supported")]
#[case::instances("/nodes/0/extensions", json!({"EXT_mesh_gpu_instancing": {}}), "node 0: holds instances in a buffer")]
fn faults_name_the_bad_value(#[case] path: &str, #[case] value: Value, #[case] expected: &str) {
    let message = error(&triangle_with_value_at(path, value)).to_string();
    assert!(message.contains(expected), "{message}");
}

#[test]
fn compressed_data_alone_is_refused() {
    let mut gltf = triangle_with_value_at(
        "/accessors/0",
        json!({"componentType": 5126, "count": 3, "type": "VEC3"}),
    );
    gltf.json["meshes"][0]["primitives"][0]["extensions"] =
        json!({"KHR_draco_mesh_compression": {}});
    let draco = error(&gltf).to_string();
    assert!(
        draco.contains("primitive 0: holds meshes compressed by Draco"),
        "{draco}"
    );
    let mut gltf =
        triangle_with_value_at("/buffers", json!([{"byteLength": 36}, {"byteLength": 36}]));
    gltf.json["bufferViews"][0] =
        json!({"buffer": 1, "byteLength": 36, "extensions": {"EXT_meshopt_compression": {}}});
    let meshopt = error(&gltf).to_string();
    assert!(meshopt.contains("compressed by meshopt"), "{meshopt}");
    gltf.json["bufferViews"][0] = json!({"buffer": 1, "byteLength": 36});
    let empty = error(&gltf).to_string();
    assert!(
        empty.contains("buffer 1 has neither bytes nor a file"),
        "{empty}"
    );
}

#[test]
fn names_of_nodes_and_meshes_are_in_messages() {
    let mut gltf = triangle_with_value_at("/accessors/0/type", json!("VEC4"));
    gltf.json["nodes"][0]["name"] = json!("lid\n");
    gltf.json["meshes"][0]["name"] = json!("x".repeat(1000));
    let message = error(&gltf).to_string();
    assert!(
        message.starts_with(r#"node 0 "lid\n": mesh 0 "xxx"#),
        "{message}"
    );
    assert!(message.len() < 300, "{message}");
}

#[test]
fn corners_must_be_vertices() {
    let mut gltf = gltf_with_square_points();
    let indices = gltf.add_index_accessor(&[0, 1, 2, 0, 4, 2]);
    gltf.add_primitive(json!({"attributes": {"POSITION": 0}, "indices": indices}));
    let expected =
        "node 0: mesh 0: primitive 0: face 1 names vertex 4, but there are 4, numbered from 0";
    assert_eq!(error(&gltf).to_string(), expected);
    // A primitive must not reach the vertices of another one.
    let other = gltf.add_vec3_accessor(&[[0.0; 3]; 4]);
    gltf.json["meshes"][0]["primitives"] = json!([
        {"attributes": {"POSITION": 0}, "mode": 5},
        {"attributes": {"POSITION": other}, "indices": indices},
    ]);
    assert!(
        error(&gltf)
            .to_string()
            .contains("primitive 1: face 1 names vertex 4")
    );
}

#[test]
fn triangles_have_three_corners() {
    let mut gltf = gltf_with_square_points();
    gltf.add_primitive(json!({"attributes": {"POSITION": 0}}));
    let message = error(&gltf).to_string();
    assert!(
        message.contains("primitive 0: has 4 corners, which make no whole triangles"),
        "{message}"
    );
    for mode in [5, 6] {
        let mut gltf = gltf_with_square_points();
        let few = gltf.add_index_accessor(&[0, 1]);
        gltf.add_primitive(json!({"attributes": {"POSITION": 0}, "indices": few, "mode": mode}));
        assert!(matches!(
            error(&gltf).fault,
            MeshFault::NoVertices | MeshFault::NoFaces
        ));
    }
}

#[test]
fn coordinates_must_be_finite() {
    let mut gltf = Gltf::new();
    gltf.add_vec3_accessor(&[[0., 0., 0.], [1., f32::NAN, 0.], [0., 1., 0.]]);
    gltf.add_primitive(json!({"attributes": {"POSITION": 0}}));
    let message = error(&gltf).to_string();
    assert!(
        message.contains("primitive 0: vertex 1 is NaN or infinite"),
        "{message}"
    );
}

#[test]
fn sparse_accessors_stay_within_their_list() {
    let mut gltf = Gltf::triangle();
    let places = gltf.add_buffer_view(&[2, 3]);
    gltf.json["bufferViews"][places]["byteLength"] = json!(1);
    gltf.json["accessors"][0]["sparse"] = json!({
        "count": 1, "indices": {"bufferView": places, "componentType": 5121}, "values": {"bufferView": 0},
    });
    assert_eq!(read(&gltf).vertices()[2], ccd_core::glam::DVec3::ZERO);
    gltf.json["bufferViews"][places]["byteOffset"] = json!(37);
    let message = error(&gltf).to_string();
    assert!(
        message.contains("accessor 0: replaces element 3 of 3"),
        "{message}"
    );
    gltf.json["bufferViews"][places]["byteOffset"] = json!(36);
    for (key, value, expected) in [
        ("count", json!(2), "ends before all 2 elements of 1 bytes"),
        (
            "count",
            json!(u64::MAX),
            "ends before all 18446744073709551615 elements",
        ),
        (
            "values",
            json!({"bufferView": places}),
            "ends before all 1 elements of 12 bytes",
        ),
        (
            "indices",
            json!({"bufferView": places, "componentType": 5126}),
            "of type 5126 instead of whole numbers",
        ),
        (
            "indices",
            json!({"bufferView": 9, "componentType": 5121}),
            "names buffer view 9",
        ),
    ] {
        let mut gltf = Gltf {
            json: gltf.json.clone(),
            buffer: gltf.buffer.clone(),
        };
        gltf.json["accessors"][0]["sparse"][key] = value;
        let message = error(&gltf).to_string();
        assert!(message.contains(expected), "{message}");
    }
}

#[rstest]
#[case::itself(json!([{"mesh": 0, "children": [0]}]))]
#[case::two(json!([{"children": [1]}, {"mesh": 0, "children": [0]}]))]
#[case::two_parents(json!([{"children": [1, 2]}, {"children": [3]}, {"children": [3]}, {"mesh": 0}]))]
#[case::twice(json!([{"children": [1, 1]}, {"mesh": 0}]))]
fn nodes_that_form_no_tree_are_errors(#[case] nodes: Value) {
    let mut gltf = Gltf::triangle().with_value("nodes", nodes);
    let message = error(&gltf).to_string();
    assert!(
        message.contains("is below itself, or below two others"),
        "{message}"
    );
    gltf.json.as_object_mut().unwrap().remove("scenes");
    let message = error(&gltf).to_string();
    assert!(message.contains("is below"), "{message}");
}

/// Tests that a chain of 200,000 nested nodes is read without a stack overflow.
#[test]
fn nodes_may_be_deep() {
    let count = 200_000;
    let mut nodes: Vec<Value> = (1..count).map(|k| json!({"children": [k]})).collect();
    nodes.push(json!({"mesh": 0, "translation": [1, 0, 0]}));
    let gltf = Gltf::triangle().with_value("nodes", json!(nodes));
    assert_eq!(read(&gltf).vertices()[0].x, 1.0);
}

/// Tests that JSON arrays nested a million deep do not overflow the stack. They are skipped in an unused field, and an
/// error in the list of nodes.
#[test]
fn deep_json_is_no_deep_call() {
    let deep = |count| format!("{}{}", "[".repeat(count), "]".repeat(count));
    let text = String::from_utf8(Gltf::triangle().text_with_embedded_buffer()).unwrap();
    let with = |key: &str| text.replacen('{', &format!("{{\"{key}\":{},", deep(1_000_000)), 1);
    let read = |text: &str| TriangleMesh::from_reader(Format::Gltf, text.as_bytes());
    assert!(read(&with("extras")).is_ok());
    let nodes = read(&with("cameras").replacen("cameras", "nodes", 1));
    let message = nodes.unwrap_err().to_string();
    assert!(
        message.contains("its JSON is not that of a glTF"),
        "{message}"
    );
}

/// Tests that an accessor of 2³⁰ implicit zero vertices, which takes no bytes in the file, is an error.
#[test]
fn zeros_are_limited() {
    let mut gltf = Gltf::triangle();
    gltf.json["accessors"][0] = json!({
        "componentType": 5126, "count": 1 << 30, "type": "VEC3", "sparse": {
            "count": 1, "indices": {"bufferView": 0, "componentType": 5121}, "values": {"bufferView": 0},
        },
    });
    let message = error(&gltf).to_string();
    assert!(
        message.contains("accessor 0: repeats the same vertices"),
        "{message}"
    );
}

/// Tests that a small file that repeats a mesh 10,000 times is refused, while a single part of it can be read.
#[test]
fn instances_are_limited() {
    const INSTANCE_COUNT: usize = 10_000;
    let mut gltf = Gltf::new();
    gltf.add_vec3_accessor(&vec![[1.0; 3]; 9999]);
    gltf.add_primitive(json!({"attributes": {"POSITION": 0}}));
    let nodes = vec![json!({"mesh": 0}); INSTANCE_COUNT];
    let tops: Vec<usize> = (0..INSTANCE_COUNT).collect();
    let gltf = gltf
        .with_value("nodes", json!(nodes))
        .with_value("scenes", json!([{"nodes": tops}]));
    let error = error(&gltf);
    assert!(
        matches!(error.fault, MeshFault::TooManyRepeats { .. }),
        "{error}"
    );
    // A single part can be read.
    let file = super::mesh_file(&gltf);
    assert_eq!(file.part("9999").unwrap().vertices().len(), 9999);
    let parts = file.into_parts().map_err(|error| error.fault);
    assert!(matches!(parts, Err(MeshFault::TooManyRepeats { .. })));
    // Meshes that read the same bytes repeatedly are refused, too.
    let mut gltf = Gltf::new();
    gltf.add_vec3_accessor(&vec![[1.0; 3]; 9999]);
    let meshes = vec![json!({"primitives": [{"attributes": {"POSITION": 0}}]}); INSTANCE_COUNT];
    gltf.json.as_object_mut().unwrap().remove("nodes");
    gltf.json.as_object_mut().unwrap().remove("scenes");
    let gltf = gltf.with_value("meshes", json!(meshes));
    let message = super::error(&gltf).to_string();
    assert!(message.contains("too often for its size"), "{message}");
}

#[test]
fn a_container_is_whole() {
    let whole = Gltf::triangle().glb();
    let message = |bytes: &[u8]| {
        TriangleMesh::from_reader(Format::Gltf, bytes)
            .unwrap_err()
            .to_string()
    };
    for end in 0..whole.len() {
        assert!(!message(&whole[..end]).is_empty());
    }
    assert!(message(&whole[..100]).contains("ends before byte 100 of the"));
    let changed = |at: usize, byte: u8| {
        let mut bytes = whole.clone();
        bytes[at] = byte;
        message(&bytes)
    };
    assert!(changed(4, 1).contains("binary glTF of version 1"));
    assert!(changed(16, b'X').contains("its first chunk is not JSON"));
    assert!(changed(15, 0xff).contains("ends before a chunk"));
    assert!(
        changed(0, b'G')
            .contains("its JSON is not that of a glTF: expected value at line 1 column 1")
    );
    // Bytes after the announced length are ignored.
    let longer = [&whole[..], b"anything"].concat();
    assert!(TriangleMesh::from_reader(Format::Gltf, &longer[..]).is_ok());
    assert!(message(b"").contains("has no vertices"));
    assert!(message(b"{}").contains("missing field `asset`"));
    assert!(message(b"{\"asset\"").contains("ends before its JSON"));
}
