//! Walks all readers of files with an unknown element, an unknown attribute or key, a value too many and a value too few. Each is
//! refused with a message that names it, or remarked upon: none is passed over without a word.

use crate::command::{CommandCall, Scene, stderr};
use crate::{FALLING_CUBE_MOTION, TETRAHEDRON_OBJ};
use std::fs;
use std::path::Path;

/// A file of one kind, and a call of the command that reads it.
struct Reader {
    file: &'static str,
    text: String,
    call: Vec<&'static str>,
}

/// How a changed file is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Verdict {
    /// The command refuses the file, or a row of it.
    Refused,
    /// The command reads it, and says more than about the file as it was.
    Remarked,
}
use Verdict::{Refused, Remarked};

/// A change of a file: what stands there, what stands there instead, how it is taken, and what the message has in it.
type Change = (&'static str, &'static str, Verdict, &'static str);

fn example(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    fs::read_to_string(folder.join(name)).unwrap()
}

const EDGES: [&str; 6] = [
    "edges",
    "arm.urdf",
    "--cell",
    "cell.toml",
    "--edges",
    "moves.csv",
];

fn edges(more: &[&'static str]) -> Vec<&'static str> {
    [&EDGES[..], more].concat()
}

fn query(body: &'static str) -> Vec<&'static str> {
    vec![
        "query",
        "--a",
        body,
        "--b",
        "box:9,9,1",
        "--motions",
        "motions.csv",
    ]
}

/// Runs the call of a reader on its file as it is, and after each change.
fn check(reader: &Reader, changes: &[Change]) {
    let scene = Scene::new("readers");
    for name in ["arm.urdf", "cell.toml", "moves.csv"] {
        scene.file(name, &example(name));
    }
    scene.file("motions.csv", FALLING_CUBE_MOTION);
    scene.file("part.obj", TETRAHEDRON_OBJ);
    let run = |text: &str| {
        scene.file(reader.file, text);
        let output = CommandCall::with_args(&reader.call)
            .folder(&scene.directory)
            .output();
        (output.status.code(), stderr(&output))
    };
    let (code, plain) = run(&reader.text);
    assert_eq!(code, Some(0), "{}: {plain}", reader.file);
    for (given, instead, verdict, expected) in changes {
        assert!(
            reader.text.contains(given),
            "{} has no {given:?}",
            reader.file
        );
        let (code, message) = run(&reader.text.replacen(given, instead, 1));
        let said = message
            .lines()
            .find(|line| line.contains(expected) && !plain.contains(line));
        let wanted = if *verdict == Refused {
            Some(2)
        } else {
            Some(0)
        };
        assert!(
            code == wanted && said.is_some(),
            "{}: {instead:?} in place of {given:?} ends with {code:?}, and not with {expected:?}:\n{message}",
            reader.file
        );
    }
}

#[test]
fn urdf() {
    let reader = Reader {
        file: "arm.urdf",
        text: example("arm.urdf"),
        call: edges(&[]),
    };
    check(
        &reader,
        &[
            (
                "<link name=\"hand\">",
                "<link name=\"hand\"><colision/>",
                Refused,
                "`colision` in `link`",
            ),
            (
                "xyz=\"0.25 0 0\"",
                "xyz=\"0.25 0 0\" rypy=\"0 0 1\"",
                Refused,
                "link `upper`: an element `origin` has no attribute `rypy`",
            ),
            (
                "xyz=\"0.25 0 0\"",
                "xyz=\"0.25 0 0 1\"",
                Refused,
                "link `upper`: xyz=\"0.25 0 0 1\"",
            ),
            (
                "xyz=\"0.25 0 0\"",
                "xyz=\"0.25 0\"",
                Refused,
                "link `upper`: xyz=\"0.25 0\"",
            ),
            (
                "radius=\"0.06\"",
                "",
                Refused,
                "link `hand`: an element `sphere` needs an attribute `radius`",
            ),
            ("<sphere radius=\"0.06\"/>", "", Refused, "link `hand`: "),
            (
                "<robot name=\"arm\">",
                "<robot name=\"arm\" version=\"9.9\">",
                Refused,
                "version=\"9.9\"",
            ),
            (
                "xyz=\"0.25 0 0\"",
                "xyz=\"0.25 0 0\" rpy=\"90 0 0\"",
                Remarked,
                "link upper: roll, pitch or yaw",
            ),
            (
                "<link name=\"hand\">",
                "<link name=\"hand\"><self_filter/>",
                Remarked,
                "self_filter in link hand",
            ),
        ],
    );
}

#[test]
fn mjcf() {
    let reader = Reader {
        file: "model.xml",
        text: r#"<mujoco model="arm"><compiler angle="radian"/><default><geom type="sphere"/></default><worldbody>
            <body name="arm"><joint name="shoulder" range="-3 3"/><geom name="hand" size="0.1" pos="1 0 0"/></body>
            <body name="elbow"><joint name="elbow"/><geom size="0.1" pos="0 0 3"/></body></worldbody>
            <contact><exclude body1="world" body2="arm"/></contact></mujoco>"#
            .to_owned(),
        call: vec!["edges", "model.xml", "--edges", "moves.csv"],
    };
    check(
        &reader,
        &[
            (
                "<joint name=\"elbow\"/>",
                "<joint name=\"elbow\"/><jiont/>",
                Refused,
                "`jiont` in `body`",
            ),
            (
                "pos=\"1 0 0\"",
                "pos=\"1 0 0\" eulr=\"0 0 1\"",
                Refused,
                "`geom hand` has no attribute `eulr`",
            ),
            (
                "pos=\"1 0 0\"",
                "pos=\"1 0 0 0\"",
                Refused,
                "pos=\"1 0 0 0\" of an element `geom hand`",
            ),
            (
                "pos=\"1 0 0\"",
                "pos=\"1 0\"",
                Refused,
                "pos=\"1 0\" of an element `geom hand`",
            ),
            (
                "pos=\"1 0 0\"",
                "quat=\"0 0 0 0\"",
                Refused,
                "quat=\"0 0 0 0\" of an element `geom hand`",
            ),
            (
                "size=\"0.1\" pos=\"1 0 0\"",
                "size=\"0.1 1 1 1\"",
                Refused,
                "size=\"0.1 1 1 1\"",
            ),
            ("size=\"0.1\" pos=\"1 0 0\"", "", Refused, "size=\"\""),
            (
                "angle=\"radian\"",
                "anlge=\"radian\"",
                Refused,
                "`compiler` has no attribute `anlge`",
            ),
            (
                "<geom type=\"sphere\"/>",
                "<geom typ=\"sphere\"/>",
                Refused,
                "`geom` has no attribute `typ`",
            ),
            (
                "<geom type=\"sphere\"/>",
                "<body/>",
                Refused,
                "`body` in `default`",
            ),
            (
                "<exclude body1=\"world\"",
                "<exclude body=\"world\"",
                Refused,
                "`exclude` has no attribute `body`",
            ),
            ("<exclude", "<exclud", Refused, "`exclud` in `contact`"),
            (
                "<worldbody>",
                "<worldbody pos=\"0 0 1\">",
                Refused,
                "`worldbody` has no attribute `pos`",
            ),
        ],
    );
}

#[test]
fn srdf() {
    let reader = Reader {
        file: "arm.srdf",
        text: example("arm.srdf"),
        call: edges(&["--srdf", "arm.srdf"]),
    };
    check(
        &reader,
        &[
            (
                "<disable_collisions",
                "<disable_colisions",
                Refused,
                "`disable_colisions`",
            ),
            (
                "link2=\"hand\"",
                "link2=\"hand\" link3=\"fore\"",
                Refused,
                "`link3`",
            ),
            ("link2=\"hand\"", "", Refused, "`link2`"),
            ("link2=\"hand\"", "link2=\"tail\"", Remarked, "tail"),
            (
                "<robot name=\"arm\">",
                "<robot name=\"leg\">",
                Remarked,
                "`leg`",
            ),
        ],
    );
}

#[test]
fn cells() {
    let reader = Reader {
        file: "cell.toml",
        text: example("cell.toml"),
        call: edges(&[]),
    };
    check(
        &reader,
        &[
            ("[[clearance]]", "[[clearence]]", Refused, "clearence"),
            (
                "position = [0, 0, -0.12]",
                "positon = [0, 0, -0.12]",
                Refused,
                "positon",
            ),
            (
                "[0, 0, -0.12]",
                "[0, 0, -0.12, 1]",
                Refused,
                "obstacle table: position has 4 values",
            ),
            (
                "[0, 0, -0.12]",
                "[0, -0.12]",
                Refused,
                "obstacle table: position has 2 values",
            ),
            (
                "[\"hand\", \"post\"]",
                "[\"hand\", \"post\", \"table\"]",
                Refused,
                "between has 3 values",
            ),
            (
                "[\"hand\", \"post\"]",
                "[\"hand\"]",
                Refused,
                "between has 1 values",
            ),
            ("box:1,1,0.02", "box:1,1,0.02,1", Refused, "obstacle table"),
            ("distance = 0.01", "", Refused, "distance"),
            (
                "position = [0, 0, -0.12]",
                "position = [0, 0, -0.12]\nrpy = [0, 0, 90]",
                Remarked,
                "obstacle table: roll, pitch or yaw",
            ),
            ("box:1,1,0.02", "box:900,900,2", Remarked, "table is 1800"),
            (
                "[[clearance]]",
                "[[plane]]\nname = \"floor\"\nposition = [0, 0, -9]\nrpy = [0, 0, 90]\n[[clearance]]",
                Remarked,
                "plane floor: roll, pitch or yaw",
            ),
        ],
    );
}

#[test]
fn tables_of_robots() {
    let reader = Reader {
        file: "moves.csv",
        text: example("moves.csv"),
        call: edges(&[]),
    };
    check(
        &reader,
        &[
            ("id,", "ident,", Refused, "`ident`"),
            (",to_elbow", ",to_elbow,speed", Refused, "`speed`"),
            (
                "up,0,0,-0.2,0.5",
                "up,0,0,-0.2,0.5,7",
                Refused,
                "has 6 cells",
            ),
            ("up,0,0,-0.2,0.5", "up,0,0,-0.2", Refused, "has 4 cells"),
        ],
    );
    let reader = Reader {
        file: "path.csv",
        text: example("path.csv"),
        call: vec!["edges", "arm.urdf", "--edges", "path.csv"],
    };
    check(
        &reader,
        &[
            ("shoulder,elbow", "shoulder,elbow,speed", Refused, "`speed`"),
            (
                "shoulder,elbow",
                "shoulder,elbo",
                Refused,
                "no column elbow",
            ),
            ("sweep,1,0,1", "sweep,1,0,1,4", Refused, "has 5 cells"),
            ("sweep,1,0,1", "sweep,1,0", Refused, "has 3 cells"),
        ],
    );
}

#[test]
fn tables_of_bodies() {
    let motions = Reader {
        file: "motions.csv",
        text: FALLING_CUBE_MOTION.to_owned(),
        call: query("box:1,1,1"),
    };
    check(
        &motions,
        &[
            ("a_vz", "a_vzz", Refused, "`a_vzz`"),
            ("drop,4,-4", "drop,4,-4,1", Refused, "has 4 cells"),
            ("drop,4,-4", "drop,4", Refused, "has 2 cells"),
        ],
    );
    let paths = Reader {
        text: "id,t,a_pz\nr,0,4\nr,1,3\n".to_owned(),
        ..motions
    };
    check(
        &paths,
        &[
            ("a_pz", "a_ppz", Refused, "`a_ppz`"),
            ("r,1,3", "r,1,3,0", Refused, "has 4 cells"),
            ("r,1,3", "r,1", Refused, "has 2 cells"),
        ],
    );
    let scene = Reader {
        file: "scene.csv",
        text: "id,body,px,vx\na,\"box:1,1,1\",0,0\nb,sphere:1,5,-5\n".to_owned(),
        call: vec!["scene", "scene.csv", "--duration", "1"],
    };
    check(
        &scene,
        &[
            ("vx", "vvx", Refused, "`vvx`"),
            ("5,-5", "5,-5,9", Refused, "has 5 cells"),
            ("5,-5", "5", Refused, "has 3 cells"),
            ("box:1,1,1", "box:1,1,1,1", Refused, "takes 3 lengths"),
            ("sphere:1", "spher:1", Refused, "spher"),
            ("sphere:1", "part.obj@scael=2", Refused, "@scael=2"),
        ],
    );
}

#[test]
fn records() {
    let reader = Reader {
        file: "stop.json",
        text: example("stop.json"),
        call: vec![
            "replay",
            "arm.urdf",
            "--cell",
            "cell.toml",
            "--record",
            "stop.json",
        ],
    };
    check(
        &reader,
        &[
            ("\"tolerance\"", "\"tolerence\"", Refused, "`tolerence`"),
            ("\"margin\": 0.0,", "", Refused, "`margin`"),
            (
                "\"hand\",",
                "\"hand\", \"hand\",",
                Refused,
                "stop.json: not a record",
            ),
            (
                "\"segment\": 0",
                "\"segment\": 0, \"step\": 1",
                Refused,
                "`step`",
            ),
        ],
    );
}

#[test]
fn stored_bodies() {
    let scene = Scene::new("stored");
    scene.file("part.obj", TETRAHEDRON_OBJ);
    let stored = ["decompose", "part.obj", "--out", "part.ccd"];
    let call = |args: &[&str]| CommandCall::with_args(args).folder(&scene.directory);
    call(&stored).run_expecting_code(0);
    let path = scene.directory.join("part.ccd");
    let bytes = fs::read(&path).unwrap();
    let read = call(&query("part.ccd")).stdin("");
    scene.file("motions.csv", FALLING_CUBE_MOTION);
    read.run_expecting_code(0);
    for changed in [
        [&bytes[..], b"\0"].concat(),
        bytes[..bytes.len() - 1].to_vec(),
        b"<!doctype html>".to_vec(),
    ] {
        fs::write(&path, changed).unwrap();
        read.run_expecting_code(2);
    }
}

#[test]
fn meshes_of_text() {
    let reader = |file: &'static str, text: &str| Reader {
        file,
        text: text.to_owned(),
        call: query(file),
    };
    let page = "<!doctype html><html>";
    let html: Change = ("", page, Refused, "is a page of HTML");
    check(
        &reader("t.obj", TETRAHEDRON_OBJ),
        &[
            (
                "f 1 3 2",
                "fo 1 3 2",
                Remarked,
                "statements \"fo\" passed over",
            ),
            ("v 0 0 1", "v 0 0 1 1 1 1 1 1", Refused, "line 4"),
            ("v 0 0 1", "v 0 0", Refused, "line 4"),
            ("f 1 3 2", "f 1 3 2 x", Refused, "line 5"),
            ("f 1 3 2", "f 1 3", Refused, "line 5"),
            html,
        ],
    );
    let facets = [
        [[0, 0, 0], [0, 1, 0], [1, 0, 0]],
        [[0, 0, 0], [1, 0, 0], [0, 0, 1]],
        [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
        [[0, 1, 0], [0, 0, 0], [0, 0, 1]],
    ];
    let facets = facets.map(|corners| {
        let corners = corners
            .map(|[x, y, z]| format!("vertex {x} {y} {z}\n"))
            .concat();
        format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    });
    check(
        &reader(
            "t.stl",
            &format!("solid t\n{}endsolid t\n", facets.concat()),
        ),
        &[
            ("vertex 0 1 0", "vertx 0 1 0", Refused, "line 5"),
            ("vertex 0 1 0", "vertex 0 1 0 5", Refused, "line 5"),
            ("vertex 0 1 0", "vertex 0 1", Refused, "line 5"),
            html,
        ],
    );
    let ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n\
        property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
    check(
        &reader("t.ply", ply),
        &[
            ("ascii 1.0", "ascii 9.0", Refused, "format ascii 9.0"),
            ("element face", "element fase", Refused, "has no faces"),
            (
                "property float z",
                "property float w",
                Refused,
                "lacks the property z",
            ),
            ("0 0 1\n", "0 0 1 4\n", Refused, "line 13"),
            ("0 0 1\n", "0 0\n", Refused, "line 13"),
            html,
        ],
    );
    let off = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
    check(
        &reader("t.off", off),
        &[
            ("OFF", "OFX", Refused, "line 1"),
            ("4 4 6", "4 4 6 7", Refused, "line 2"),
            ("0 0 1\n", "0 0 1 5\n", Refused, "line 6"),
            ("0 0 1\n", "0 0\n", Refused, "line 6"),
            ("4 4 6", "4 3 6", Refused, "line 10"),
            html,
        ],
    );
}

#[test]
fn scenes_of_meshes() {
    let gltf = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}"#;
    let reader = |file: &'static str, text: &str| Reader {
        file,
        text: text.to_owned(),
        call: query(file),
    };
    check(
        &reader("t.gltf", gltf),
        &[
            (
                "{\"mesh\": 0}",
                "{\"mesh\": 0, \"translasion\": [1, 2, 3]}",
                Refused,
                "`translasion`",
            ),
            (
                "{\"mesh\": 0}",
                "{\"mesh\": 0, \"translation\": [1, 2, 3, 4]}",
                Refused,
                "t.gltf",
            ),
            (
                "{\"mesh\": 0}",
                "{\"mesh\": 0, \"scale\": [1, 2]}",
                Refused,
                "t.gltf",
            ),
            ("\"scene\": 0", "\"scnee\": 0", Refused, "`scnee`"),
            (
                "\"bufferView\": 0",
                "\"bufferVeiw\": 0",
                Refused,
                "`bufferVeiw`",
            ),
            (
                "\"version\": \"2.0\"",
                "\"version\": \"9.0\"",
                Refused,
                "9.0",
            ),
            ("", "<!doctype html>", Refused, "is a page of HTML"),
        ],
    );
    let dae = r##"<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit meter="1"/></asset>
        <library_geometries><geometry id="g"><mesh><source id="p"><float_array id="n" count="9">0 0 0 1 0 0 0 1 0</float_array>
        <technique_common><accessor source="#n" count="3" stride="3"/></technique_common></source>
        <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
        <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>
        <library_visual_scenes><visual_scene id="s"><node id="n0"><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
        <scene><instance_visual_scene url="#s"/></scene></COLLADA>"##;
    check(
        &reader("t.dae", dae),
        &[
            (
                "<instance_geometry",
                "<trasnlate>1 2 3</trasnlate><instance_geometry",
                Refused,
                "<trasnlate>",
            ),
            (
                "<instance_geometry",
                "<translate>1 2 3 4</translate><instance_geometry",
                Refused,
                "<translate> has 4 numbers",
            ),
            (
                "<instance_geometry",
                "<translate>1 2</translate><instance_geometry",
                Refused,
                "<translate> has 2 numbers",
            ),
            (
                "0 1 0</float",
                "0 1 0 7</float",
                Refused,
                "<float_array> has 10 numbers",
            ),
            ("stride=\"3\"", "strid=\"3\"", Refused, "stride"),
            ("0 1 2</p>", "0 1 2 0</p>", Refused, "<p>"),
            (
                "version=\"1.4.1\"",
                "version=\"9\"",
                Refused,
                "COLLADA of version \"9\"",
            ),
            ("", "<!doctype html>", Refused, "is a page of HTML"),
        ],
    );
}
