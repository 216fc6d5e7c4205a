//! Tests COLLADA documents: all kinds of primitives, transforms and units, and what is refused.

use super::*;
use crate::mesh::format::Format;
use crate::{MeshFile, TriangleMesh};
use ccd_core::glam::DVec3;

const HEAD: &str = r##"<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">"##;

/// A source of the corners of a tetrahedron, with a weight before each, and its vertices.
const VERTICES: &str = r##"<source id="points"><float_array id="numbers" count="17">9 5 0 0 0 5 1 0 0 5 0 1 0 5 0 0 1</float_array>
<technique_common><accessor source="#numbers" offset="1" count="4" stride="4"><param type="float"/><param name="X"/>
<param name="Y"/><param name="Z"/></accessor></technique_common></source>
<vertices id="corners"><input semantic="POSITION" source="#points"/></vertices>"##;

const INPUTS: &str = r##"<input semantic="NORMAL" source="#none" offset="0"/><input semantic="VERTEX" source="#corners" offset="1"/>"##;

fn document(asset: &str, primitives: &str, scene: &str) -> String {
    format!(
        r##"{HEAD}<asset>{asset}</asset><library_geometries><geometry id="shape" name="block"><mesh>{VERTICES}{primitives}</mesh>
        </geometry></library_geometries>{scene}</COLLADA>"##
    )
}

/// Returns a primitive of a kind with its text after the inputs.
fn primitive(kind: &str, text: &str) -> String {
    format!("<{kind}>{INPUTS}{text}</{kind}>")
}

fn read(text: &str) -> Result<TriangleMesh, String> {
    let file = MeshFile::from_reader(Format::Collada, text.as_bytes());
    file.and_then(MeshFile::into_mesh)
        .map_err(|error| error.to_string())
}

const TRIANGLES: &str = "<p>7 0 7 2 7 1 7 0 7 1 7 3 7 1 7 2 7 3 7 2 7 0 7 3</p>";

#[test]
fn all_kinds_of_primitives_have_the_same_faces() {
    let expected = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let polylist = format!("<vcount>3 3 3 3</vcount>{TRIANGLES}");
    let polygons =
        "<p>7 0 7 2 7 1</p><p>7 0 7 1 7 3</p><p>7 1 7 2 7 3</p><p>7 2 7 0 7 3</p>".to_owned();
    for (kind, text) in [
        ("triangles", TRIANGLES.to_owned()),
        ("polylist", polylist),
        ("polygons", polygons),
    ] {
        let mesh = read(&document("", &primitive(kind, &text), "")).unwrap();
        assert_eq!(mesh.faces(), expected, "{kind}");
        assert_eq!(mesh.vertices()[3], DVec3::Z);
    }
    // A comment parts a text in two.
    let parted = TRIANGLES.replace("7 1 7 2", "7 1<!-- 7 7 -->7 2");
    let mesh = read(&document("", &primitive("triangles", &parted), "")).unwrap();
    assert_eq!(mesh.faces(), expected);
    let fan = "<p>7 3 7 0 7 1 7 2 7 0</p>";
    let mesh = read(&document("", &primitive("trifans", fan), "")).unwrap();
    assert_eq!(mesh.faces(), [[3, 0, 1], [3, 1, 2], [3, 2, 0]]);
    let strip = "<p>7 0 7 1 7 2 7 3</p>";
    let mesh = read(&document("", &primitive("tristrips", strip), "")).unwrap();
    assert_eq!(mesh.faces(), [[0, 1, 2], [2, 1, 3]]);
}

#[test]
fn nodes_place_geometries_in_the_unit_of_the_document() {
    let scene = r##"<library_nodes><node id="shared"><scale>2 2 2</scale><instance_geometry url="#shape"/></node></library_nodes>
        <library_visual_scenes><visual_scene id="other"/><visual_scene id="shown"><node name="top">
        <translate>0 0 5</translate><rotate>0 0 1 90</rotate><node><matrix>1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
        <instance_geometry url="#shape"/></node><instance_node url="#shared"/></node></visual_scene></library_visual_scenes>
        <scene><instance_visual_scene url="#shown"/></scene>"##;
    let text = document(
        r#"<unit name="inch" meter="0.0254"/>"#,
        &primitive("triangles", TRIANGLES),
        scene,
    );
    let file = MeshFile::from_reader(Format::Collada, text.as_bytes()).unwrap();
    assert_eq!(file.unit(), Some(Unit::Inch));
    assert_eq!(
        file.part_names().collect::<Vec<_>>(),
        [Some("block"), Some("block")]
    );
    let mesh = file.into_mesh().unwrap();
    // The point (1, 0, 0): shifted by 1 along x, turned, and lifted; and doubled, turned, and lifted.
    for (found, expected) in [
        (1, [0.0, 2.0, 5.0]),
        (5, [0.0, 2.0, 5.0]),
        (7, [0.0, 0.0, 7.0]),
    ] {
        let off = mesh.vertices()[found].distance(expected.into());
        assert!(off < 1e-15, "{found}: {off}");
    }
    // As SketchUp writes it.
    let text = text.replace("0.0254", "0.02539999969303608");
    let file = MeshFile::from_reader(Format::Collada, text.as_bytes()).unwrap();
    assert_eq!(file.unit(), Some(Unit::Inch));
}

#[test]
fn what_is_wrong_is_named_with_its_line() {
    let triangles =
        |text: &str| read(&document("", &primitive("triangles", text), "")).unwrap_err();
    let scene = |text: &str| {
        let shown = format!(
            r#"<library_visual_scenes><visual_scene>{text}</visual_scene></library_visual_scenes>"#
        );
        read(&document("", &primitive("triangles", TRIANGLES), &shown)).unwrap_err()
    };
    for (error, expected) in [
        (read("<COLLADA").unwrap_err(), "is no XML"),
        (read("<svg/>").unwrap_err(), "is no COLLADA document"),
        (
            read(&format!("{HEAD}</COLLADA>")).unwrap_err(),
            "has no vertices",
        ),
        (
            triangles("<p>7 0 7 1</p>"),
            "has corners that make no triangle",
        ),
        (
            triangles("<p>7 0 7 1 7</p>"),
            "has 5 numbers, no multiple of 2",
        ),
        (
            triangles("<p>7 0 7 one 7 2</p>"),
            r#"has "one" instead of a number"#,
        ),
        (triangles("<p>7 0 7 1 7 4</p>"), "vertex 4"),
        (
            scene(r##"<node><instance_geometry url="#numbers"/></node>"##),
            "is no geometry",
        ),
        (
            scene(r#"<node><instance_geometry url="file.dae"/></node>"#),
            "in another file",
        ),
        (scene("<node><skew>1 2 3 4 5 6 7</skew></node>"), "<skew>"),
        (
            scene("<node><translate>1 2</translate></node>"),
            "has 2 numbers instead of 3",
        ),
        (
            scene(r##"<node id="loop"><instance_node url="#loop"/></node>"##),
            "is below itself",
        ),
        (
            read(&document(r#"<unit meter="-1"/>"#, "", "")).unwrap_err(),
            r#"is "-1" metres"#,
        ),
        (
            triangles("<p>7 0 7 1 <q>7</q> 7 3</p>"),
            "has elements among its numbers",
        ),
        (
            read(&document(
                "",
                &primitive("polylist", "<vcount>3 3</vcount>"),
                "",
            ))
            .unwrap_err(),
            "has 0 of the 2 that it says",
        ),
        (
            read(&document(
                "",
                &primitive("trifans", "<p>7 0 7 1 7 2</p><p>7 0 7 1</p>"),
                "",
            ))
            .unwrap_err(),
            "has 2 corners",
        ),
        (
            read(&document(
                "",
                &format!("<tristrips count='2'>{INPUTS}<p>7 0 7 1 7 2</p></tristrips>"),
                "",
            ))
            .unwrap_err(),
            "has 1 of the 2 that it says",
        ),
        (
            read(&document("", &primitive("Triangles", TRIANGLES), "")).unwrap_err(),
            "<Triangles>",
        ),
        (
            read(&document("", "<polygons><ph/></polygons>", "")).unwrap_err(),
            "<ph>",
        ),
        (
            scene(r##"<node id="shape"><instance_geometry url="#shape"/></node>"##),
            "which several elements are",
        ),
        (scene("<node><instance_geometry/></node>"), "has no url"),
        (
            scene(r#"<asset><unit meter="0.001"/></asset>"#),
            "is of a single element",
        ),
    ] {
        assert!(error.contains(expected), "{error} instead of {expected}");
    }
    let error = triangles("\n\n<p>7 0 7 one 7 2</p>");
    assert!(error.contains("line 7"), "{error}");
}

/// Tests that nodes which name others twice each, which name others twice, end.
#[test]
fn a_small_file_makes_no_endless_scene() {
    let mut nodes = r##"<node id="n0"><instance_geometry url="#shape"/></node>"##.to_owned();
    for k in 1..100 {
        let below = format!(r##"<instance_node url="#n{}"/>"##, k - 1).repeat(2);
        nodes += &format!(r#"<node id="n{k}">{below}</node>"#);
    }
    let scene = format!(
        r##"<library_nodes>{nodes}</library_nodes><library_visual_scenes><visual_scene>
        <node><instance_node url="#n99"/></node></visual_scene></library_visual_scenes>"##
    );
    let error = read(&document("", &primitive("triangles", TRIANGLES), &scene)).unwrap_err();
    assert!(error.contains("more than"), "{error}");
}

/// Tests that elements nested ever deeper are an error or read, and overflow no stack.
#[test]
fn deep_nesting_overflows_no_stack() {
    for depth in [100, 1_000, 100_000] {
        let (open, close) = ("<node>".repeat(depth), "</node>".repeat(depth));
        let scene = format!(
            "<library_visual_scenes><visual_scene>{open}{close}</visual_scene></library_visual_scenes>"
        );
        let read = read(&document("", &primitive("triangles", TRIANGLES), &scene));
        assert!(read.is_err(), "{depth}");
    }
}

/// Tests that coordinates go by their names, that a skin is taken at rest, and that the first scene may be in a second library.
#[test]
fn coordinates_skins_and_scenes_are_found() {
    let triangles = primitive("triangles", TRIANGLES);
    let text = document("", &triangles, "");
    let swapped = text
        .replace(r#"name="X""#, r#"name="?""#)
        .replace(r#"name="Z""#, r#"name="X""#);
    let swapped = swapped.replace(r#"name="?""#, r#"name="Z""#);
    assert_eq!(read(&swapped).unwrap().vertices()[1], DVec3::Z);
    let scene = r##"<library_controllers><controller id="bend"><skin source="#shape">
        <bind_shape_matrix>1 0 0 7 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix></skin></controller>
        <controller id="again"><morph source="#bend"/></controller></library_controllers><library_visual_scenes/>
        <library_visual_scenes><visual_scene><node><translate>0 5 0</translate><instance_controller url="#again"/></node>
        </visual_scene></library_visual_scenes>"##;
    let mesh = read(&document("", &triangles, scene)).unwrap();
    assert_eq!(mesh.vertices()[0].to_array(), [7.0, 5.0, 0.0]);
    let remark = format!("{:?}", mesh.repairs());
    assert!(
        remark.contains("skins and morphs taken at rest"),
        "{remark}"
    );
    let loops = scene.replace("#shape", "#again");
    let error = read(&document("", &triangles, &loops)).unwrap_err();
    assert!(error.contains("bends itself"), "{error}");
}
