//! Tests that valid 3MF files are read as specified. Invalid files are in `faults`.

mod faults;

use crate::test_files::{Entry, model, object, package, zip_archive};
use crate::{Format, MeshError, MeshFile, TriangleMesh, Unit};
use ccd_core::glam::{DVec3, dvec3};
use rawzip::CompressionMethod;
use rstest::rstest;

const POINTS: [[f64; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];
const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

fn tetrahedron(attributes: &str) -> String {
    object(attributes, &POINTS, &FACES)
}

fn package_of_model(model: &str) -> Vec<u8> {
    package(&[("3D/3dmodel.model", model)])
}

fn file(bytes: &[u8]) -> MeshFile {
    MeshFile::from_reader(Format::ThreeMf, bytes).unwrap()
}

fn read(bytes: &[u8]) -> TriangleMesh {
    file(bytes).into_mesh().unwrap()
}

fn error(bytes: &[u8]) -> MeshError {
    let read = TriangleMesh::from_reader(Format::ThreeMf, bytes);
    // The mesh may be too long to print.
    match read {
        Ok(_) => panic!("it has no fault"),
        Err(error) => error,
    }
}

fn points() -> Vec<DVec3> {
    POINTS.iter().map(|&point| point.into()).collect()
}

#[test]
fn a_model_is_read() {
    let model = model("", &tetrahedron(r#"id="1""#), r#"<item objectid="1"/>"#);
    let mesh = read(&package_of_model(&model));
    assert_eq!(mesh.vertices(), points());
    assert_eq!(mesh.faces(), FACES);
    assert!(mesh.repairs().is_empty());
}

#[rstest]
#[case("", Unit::Millimetre, 1.0)]
#[case("unit=\"micron\"", Unit::Micrometre, 0.001)]
#[case("unit=\"millimeter\"", Unit::Millimetre, 1.0)]
#[case("unit=\"centimeter\"", Unit::Centimetre, 10.0)]
#[case("unit=\"inch\"", Unit::Inch, 25.4)]
#[case("unit=\"foot\"", Unit::Foot, 304.8)]
#[case("unit=\"meter\"", Unit::Metre, 1000.0)]
fn the_stated_unit_is_read(#[case] attribute: &str, #[case] unit: Unit, #[case] millimetres: f64) {
    let bytes = package_of_model(&model(
        attribute,
        &tetrahedron(r#"id="1""#),
        r#"<item objectid="1"/>"#,
    ));
    assert_eq!(file(&bytes).unit(), Some(unit));
    assert_eq!(read(&bytes).vertices()[1], DVec3::X);
    let mesh = file(&bytes).in_unit(Unit::Millimetre).into_mesh().unwrap();
    assert_eq!(mesh.vertices()[1], dvec3(millimetres, 0.0, 0.0));
}

/// Tests that the unit of a model also applies to the translations of transforms.
#[test]
fn translations_are_in_the_unit() {
    let item = r#"<item objectid="1" transform="1 0 0 0 1 0 0 0 1 3 0 0"/>"#;
    let bytes = package_of_model(&model("unit=\"meter\"", &tetrahedron(r#"id="1""#), item));
    let mesh = file(&bytes).in_unit(Unit::Centimetre).into_mesh().unwrap();
    assert_eq!(mesh.vertices()[1], dvec3(400.0, 0.0, 0.0));
}

/// Tests transforms of items and components. Their numbers are the rows of a matrix that is applied from the right.
#[test]
fn items_and_components_are_placed() {
    let objects = tetrahedron(r#"id="1" name="tip""#)
        + r#"<object id="2" name="pair"><components>
            <component objectid="1"/>
            <component objectid="1" transform="0 2 0 -1 0 0 0 0 1 5 0 0"/>
        </components></object>"#;
    let items = r#"<item objectid="2" transform="1 0 0 0 1 0 0 0 1 0 0 7"/><item objectid="1" partnumber="A7"/>"#;
    let bytes = package_of_model(&model("", &objects, items));
    let mesh = read(&bytes);
    assert_eq!(mesh.vertices().len(), 12);
    assert_eq!(mesh.vertices()[..2], [dvec3(0., 0., 7.), dvec3(1., 0., 7.)]);
    // x is mapped to 2 y, y to -x, and then x is moved by 5.
    assert_eq!(
        mesh.vertices()[4..8],
        [
            dvec3(5., 0., 7.),
            dvec3(5., 2., 7.),
            dvec3(4., 0., 7.),
            dvec3(5., 0., 8.)
        ]
    );
    assert_eq!(mesh.vertices()[8..], points());
    let file = file(&bytes);
    assert_eq!(
        file.part_names().collect::<Vec<_>>(),
        [Some("pair"), Some("tip")]
    );
    assert_eq!(file.part("pair").unwrap().faces().len(), 8);
}

#[test]
fn mirrored_components_turn_the_faces_round() {
    let objects = tetrahedron(r#"id="1""#)
        + r#"<object id="2"><components><component objectid="1" transform="-1 0 0 0 1 0 0 0 1 0 0 0"/></components></object>"#;
    let once = read(&package_of_model(&model(
        "",
        &objects,
        r#"<item objectid="2"/>"#,
    )));
    assert_eq!(once.faces()[0], [0, 1, 2]);
    let twice = r#"<item objectid="2" transform="1 0 0 0 -2 0 0 0 1 0 0 0"/>"#;
    assert_eq!(
        read(&package_of_model(&model("", &objects, twice))).faces()[0],
        FACES[0]
    );
}

#[test]
fn parts_have_the_names_of_objects_or_their_part_numbers() {
    let objects = tetrahedron(r#"id="1" name="a &lt; b" partnumber="7""#)
        + &tetrahedron(r#"id="2" partnumber="8""#)
        + &tetrahedron(r#"id="3" name="""#);
    let items = r#"<item objectid="1" partnumber="X"/><item objectid="2" partnumber="Y"/><item objectid="3" partnumber="Z"/><item objectid="3"/>"#;
    let file = file(&package_of_model(&model("", &objects, items)));
    let names: Vec<_> = file.part_names().collect();
    assert_eq!(names, [Some("a < b"), Some("8"), Some("Z"), None]);
}

/// Tests that objects without a build item are skipped.
#[test]
fn only_the_build_is_read() {
    let beams = r#"<object id="3"><mesh><vertices/><triangles/><b:beamlattice/></mesh></object>"#;
    let objects = tetrahedron(r#"id="1""#) + &tetrahedron(r#"id="2" type="other""#) + beams;
    let mesh = read(&package_of_model(&model(
        "",
        &objects,
        r#"<item objectid="1"/>"#,
    )));
    assert_eq!(mesh.faces().len(), 4);
}

/// Tests the production extension: objects in separate models, here with other capitals and an absolute path.
#[test]
fn models_of_the_package_are_read() {
    let parts = model(
        "",
        &tetrahedron(r#"id="1" name="deep""#),
        r#"<item objectid="1"/>"#,
    );
    let root = model(
        r#"unit="inch" requiredextensions="p""#,
        r#"<object id="1" name="top"><components><component p:path="/3D/Objects/Parts.model" objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0 1"/></components></object>"#,
        r#"<item objectid="1"/><item objectid="1" p:path="/3D/objects/parts.model"/>"#,
    );
    let bytes = package(&[
        ("3D/3dmodel.model", &root),
        ("3D/Objects/parts.model", &parts),
    ]);
    let file = file(&bytes);
    assert_eq!(
        file.part_names().collect::<Vec<_>>(),
        [Some("top"), Some("deep")]
    );
    assert_eq!(file.unit(), Some(Unit::Inch));
    assert_eq!(file.part("top").unwrap().vertices()[0], DVec3::Z);
    assert_eq!(file.part("deep").unwrap().vertices(), points());
}

/// Tests that vertices after triangles, whitespace, comments, and elements of other namespaces are read or skipped
/// correctly.
#[test]
fn the_order_and_other_elements_do_not_matter() {
    let model = model(
        r#"requiredextensions=" ""#,
        r#"<basematerials id="9"><base name="red" displaycolor="red"/></basematerials>
        <object id="1" p:UUID="x"><metadatagroup><metadata name="vertex">x</metadata></metadatagroup><!-- a mesh -->
        <mesh><triangles><triangle v1="0" v2=" 1 " v3="2"/></triangles>
        <trianglesets><triangleset><ref index="0"/></triangleset></trianglesets>
        <vertices><vertex x=" 0 " y="-0" z="0" b:x="7"/><vertex z="0" y="1e0" x="1"></vertex><vertex x="0" y="+2." z="0"/></vertices>
        </mesh></object>"#,
        r#"<item objectid=" 1 " transform=" 1 0 0  0 1 0 0 0 1 0 0 0 " printable="1"><metadatagroup/></item>"#,
    );
    let mesh = read(&package_of_model(&model));
    assert_eq!(
        mesh.vertices(),
        [DVec3::ZERO, dvec3(1., 1., 0.), dvec3(0., 2., 0.)]
    );
    assert_eq!(mesh.faces(), [[0, 1, 2]]);
}

/// Tests that elements of optional extensions with the names of core elements are skipped.
#[test]
fn elements_of_other_namespaces_are_passed_over() {
    let model = model(
        r#"xmlns:q="http://example.com/q""#,
        r#"<q:object id="1"/><object id="1"><q:before/><mesh><vertices><vertex x="0" y="0" z="0"/><q:vertex x="9" y="9" z="9"/>
        <vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/></vertices>
        <triangles><q:triangle v1="7" v2="8" v3="9"/><triangle v1="0" v2="1" v3="2"/></triangles></mesh><q:mesh/></object>"#,
        r#"<q:item objectid="77"/><item objectid="1"/>"#,
    );
    let mesh = read(&package_of_model(&model));
    assert_eq!(mesh.vertices(), [DVec3::ZERO, DVec3::X, DVec3::Y]);
    assert_eq!(mesh.faces(), [[0, 1, 2]]);
}

#[test]
fn a_package_without_relationships_has_the_usual_model() {
    let model = model("", &tetrahedron(r#"id="1""#), r#"<item objectid="1"/>"#);
    for path in ["3D/3dmodel.model", "3d/3DModel.model"] {
        let entry = Entry {
            path,
            content: model.as_bytes(),
            method: CompressionMethod::STORE,
        };
        assert_eq!(read(&zip_archive(&[entry])).faces().len(), 4);
    }
    // A model at another path must be named.
    let bytes = package(&[("elsewhere.model", &model)]);
    assert_eq!(read(&bytes).faces().len(), 4);
}

#[test]
fn what_is_not_read_is_remarked_upon() {
    let objects = tetrahedron(r#"id="1""#) + &tetrahedron(r#"id="2""#);
    let objects = objects.replacen("<triangles>", "<quads/><triangles>", 1);
    let model = model("", &objects, r#"<item objectid="1"/>"#);
    let mesh = read(&package_of_model(&model));
    assert_eq!(mesh.faces(), FACES);
    assert_eq!(
        mesh.repairs().remarks.to_string(),
        "elements \"quads\" passed over: 1; objects that the build does not place passed over: 1"
    );
}
