//! Tests that valid glTF files are read as the glTF specification says. `shapes` tests meshes, `nodes` tests the nodes
//! that place them, and `faults` tests invalid files.

mod faults;
mod nodes;
mod shapes;

use crate::test_files::Gltf;
use crate::{Format, MeshError, MeshFile, TriangleMesh, Unit};
use ccd_core::glam::DVec3;
use serde_json::json;

fn mesh_file(gltf: &Gltf) -> MeshFile {
    MeshFile::from_reader(Format::Gltf, &gltf.glb()[..]).unwrap()
}

fn read(gltf: &Gltf) -> TriangleMesh {
    mesh_file(gltf).into_mesh().unwrap()
}

fn error(gltf: &Gltf) -> MeshError {
    let read = TriangleMesh::from_reader(Format::Gltf, &gltf.glb()[..]);
    // The mesh may be too long to print.
    match read {
        Ok(_) => panic!("it has no fault"),
        Err(error) => error,
    }
}

fn second_vertex(gltf: &Gltf) -> DVec3 {
    read(gltf).vertices()[1]
}

/// Returns a glTF with an accessor of the four corners of a unit square, and no primitives yet.
fn gltf_with_square_points() -> Gltf {
    let mut gltf = Gltf::new();
    gltf.add_vec3_accessor(&[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]]);
    gltf
}

#[test]
fn text_and_binary_are_the_same() {
    let gltf = Gltf::triangle();
    for bytes in [
        gltf.glb(),
        gltf.text_with_embedded_buffer(),
        [b"\xef\xbb\xbf", &gltf.text_with_embedded_buffer()[..]].concat(),
    ] {
        let mesh = TriangleMesh::from_reader(Format::Gltf, &bytes[..]).unwrap();
        assert_eq!(mesh.vertices(), [DVec3::ZERO, DVec3::X, DVec3::Y]);
        assert_eq!(mesh.faces(), [[0, 1, 2]]);
        assert!(mesh.repairs().is_empty());
    }
}

#[test]
fn metres_are_converted() {
    let mut gltf = Gltf::new();
    gltf.add_vec3_accessor(&[[0., 0., 0.], [0.1, 0., 0.], [0., 1., 0.]]);
    gltf.add_primitive(json!({"attributes": {"POSITION": 0}}));
    assert_eq!(mesh_file(&gltf).unit(), Some(Unit::Metre));
    assert_eq!(second_vertex(&gltf).x, f64::from(0.1_f32));
    let file = mesh_file(&gltf).converted_to_unit(Unit::Millimetre);
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
        .with_value("extensionsRequired", required)
        .with_value(
            "materials",
            json!([{"pbrMetallicRoughness": {"baseColorFactor": [1, 1]}}]),
        )
        .with_value("skins", json!("anything"));
    assert_eq!(read(&gltf).faces().len(), 1);
}

/// Tests that the uncompressed data are read if a glTF holds its data also in Draco or meshopt compression.
#[test]
fn data_beside_a_compression_is_read() {
    let mut gltf = Gltf::triangle().with_value(
        "extensionsUsed",
        json!(["KHR_draco_mesh_compression", "EXT_meshopt_compression"]),
    );
    gltf.json["meshes"][0]["primitives"][0]["extensions"] =
        json!({"KHR_draco_mesh_compression": {"bufferView": 9}});
    gltf.json["bufferViews"][0]["extensions"] = json!({"EXT_meshopt_compression": {"buffer": 1}});
    assert_eq!(read(&gltf).faces().len(), 1);
}

/// Tests that a glTF with whole numbers written as floats, such as 1.0, gives the same faces as with integers. Numbers
/// that are fractional, negative, too large or quoted are errors.
#[test]
fn whole_numbers_may_have_a_fraction_of_zero() {
    fn convert_numbers_to_floats(value: &mut serde_json::Value) {
        match value {
            serde_json::Value::Number(number) => {
                *value = json!(number.as_f64().expect("a number"));
            }
            serde_json::Value::Array(list) => list.iter_mut().for_each(convert_numbers_to_floats),
            serde_json::Value::Object(fields) => {
                fields.values_mut().for_each(convert_numbers_to_floats);
            }
            _ => {}
        }
    }
    let mut gltf = gltf_with_square_points();
    let indices = gltf.add_index_accessor(&[0, 1, 2, 3]);
    gltf.add_primitive(json!({"attributes": {"POSITION": 0}, "indices": indices, "mode": 6}));
    let mut gltf = gltf.with_value("scene", json!(0));
    let plain = read(&gltf);
    gltf.json["buffers"] = json!([{"byteLength": gltf.buffer.len()}]);
    convert_numbers_to_floats(&mut gltf.json);
    assert!(
        gltf.json.to_string().contains("\"mode\":6.0"),
        "{}",
        gltf.json
    );
    assert_eq!(read(&gltf).faces(), plain.faces());
    for (bad, expected) in [
        (json!(0.5), "0.5"),
        (json!(-1), "-1"),
        (json!(1e300), "1e+300"),
        (json!("0"), "\"0\""),
        (json!(4294967296_u64), "4294967296"),
    ] {
        let mut gltf = Gltf::triangle();
        gltf.json["meshes"][0]["primitives"][0]["mode"] = bad;
        let message = error(&gltf).to_string();
        assert!(
            message.contains(expected) && message.contains("a whole number"),
            "{message}"
        );
    }
}

#[test]
fn what_is_not_read_is_remarked_upon() {
    let mut gltf = Gltf::triangle();
    gltf.add_primitive(json!({"attributes": {"POSITION": 0}, "mode": 1}));
    gltf.add_primitive(json!({"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}]}));
    gltf.json["nodes"] = json!([{"mesh": 0, "skin": 0}, {"mesh": 0}]);
    let expected = "nodes that the scene does not show passed over: 1; \
        primitives of points or lines passed over: 1; nodes taken without their skin: 1; \
        primitives with morph targets taken at rest: 1";
    assert_eq!(read(&gltf).repairs().remarks.to_string(), expected);
    let part = mesh_file(&gltf).part("0").unwrap();
    assert_eq!(part.repairs().remarks.to_string(), expected);
}
