//! Tests files of several parts: scenes in glTF, parts by name, and units.

use crate::command::{CommandCall, Scene, assert_contains, stderr};
use serde_json::{Value, json};
use std::path::Path;

/// Returns the corners of the cube from −1 to 1 along each axis; the bits of a corner's index give its coordinates.
fn corners() -> impl Iterator<Item = [f32; 3]> {
    (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2].map(|bit| 2.0 * bit as f32 - 1.0))
}

#[rustfmt::skip]
const CUBE_TRIANGLE_INDICES: [u16; 36] = [
    0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
    2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6,
];

/// Returns a glTF file of two nodes with one cube each: `base`, a metre wide, and `lid`, flat and two metres above it.
fn gltf() -> (Value, Vec<u8>) {
    let mut bytes: Vec<u8> = corners().flatten().flat_map(f32::to_le_bytes).collect();
    bytes.extend(
        CUBE_TRIANGLE_INDICES
            .iter()
            .flat_map(|corner| corner.to_le_bytes()),
    );
    let json = json!({
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [
            {"name": "base", "mesh": 0, "scale": [0.5, 0.5, 0.5]},
            {"name": "lid", "mesh": 0, "scale": [0.5, 0.5, 0.125], "translation": [0, 0, 2]},
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 96},
            {"buffer": 0, "byteOffset": 96, "byteLength": 72},
        ],
        "buffers": [{"byteLength": bytes.len()}],
    });
    (json, bytes)
}

fn glb() -> Vec<u8> {
    let (json, binary) = gltf();
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((28 + text.len() as u32 + binary.len() as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &binary)] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}

/// Returns an OBJ with a cube of length 20 about the origin.
fn large_cube_obj() -> String {
    let vertices = corners().map(|[x, y, z]| format!("v {} {} {}\n", 10.0 * x, 10.0 * y, 10.0 * z));
    let faces = CUBE_TRIANGLE_INDICES
        .chunks(3)
        .map(|f| format!("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1));
    vertices.chain(faces).collect()
}

fn name(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// Returns the argument of the command line that names a part of a file.
fn part(path: &Path, part: &str) -> String {
    format!("{}#{part}", name(path))
}

/// A table of motions in which a small ball falls at speed 1 from the height 4.
const FALLING_BALL_MOTION: &str = "b_pz,b_vz,duration\n4,-1,4\n";
const BALL_SPEC: &str = "sphere:0.1";

#[test]
fn a_part_is_chosen_by_name_or_number() {
    let scene = Scene::new("parts");
    let file = scene.write_bytes("scene.glb", &glb());
    let top = |body: &str| {
        let rows = CommandCall::query(&["--a", body, "--b", BALL_SPEC])
            .stdin(FALLING_BALL_MOTION)
            .run_for_rows();
        assert_eq!(rows[0].text("status"), "contact", "{body}");
        3.9 - rows[0].number("time")
    };
    // The lid is above the base, and both are the whole.
    for (body, height) in [
        (part(&file, "base"), 0.5),
        (part(&file, "lid"), 2.125),
        (part(&file, "0"), 0.5),
        (name(&file).to_owned(), 2.125),
    ] {
        let early = top(&body) - height;
        assert!((0.0..=1.001e-3).contains(&early), "{body}: {early}");
    }
}

#[test]
fn features_are_numbered_in_the_part_and_go_on_in_the_whole() {
    let scene = Scene::new("parts-features");
    let file = scene.write_bytes("scene.glb", &glb());
    // The ball falls onto a corner.
    let corner = "b_px,b_py,b_pz,b_vz,duration\n0.5,0.5,4,-1,4\n";
    let feature = |body: &str| {
        let rows = CommandCall::query(&["--a", body, "--b", BALL_SPEC])
            .stdin(corner)
            .run_for_rows();
        rows[0].text("feature_a").to_owned()
    };
    assert_eq!(feature(&part(&file, "lid")), "v7");
    assert_eq!(feature(name(&file)), "v15");
}

#[test]
fn an_unknown_part_lists_those_there_are() {
    let scene = Scene::new("parts-unknown");
    let file = scene.write_bytes("scene.glb", &glb());
    for missing in ["top", "", "2"] {
        let body = part(&file, missing);
        for run in [
            CommandCall::query(&["--a", BALL_SPEC, "--b", &body]).stdin(FALLING_BALL_MOTION),
            CommandCall::with_args(&["decompose", &body]),
        ] {
            let output = run.run_expecting_code(2);
            let expected =
                format!("scene.glb: has no part {missing:?}; its parts are 0 \"base\", 1 \"lid\"");
            assert_contains(&stderr(&output), &expected);
        }
    }
    let plain = scene.file("plain.obj", crate::TETRAHEDRON_OBJ);
    let output = CommandCall::with_args(&["decompose", &part(&plain, "lid")]).output();
    assert_contains(&stderr(&output), "it has one, without a name: 0");
}

/// Tests that a `#` in the name of a file does not separate a part's name.
#[test]
fn a_mark_in_the_name_of_a_file_is_kept() {
    let scene = Scene::new("parts-marks");
    for file in ["part#1.obj", "#.obj", "scene.glb#lid.obj"] {
        let path = scene.file(file, crate::TETRAHEDRON_OBJ);
        let rows = CommandCall::query(&["--a", name(&path), "--b", BALL_SPEC])
            .stdin("b_pz\n9\n")
            .run_for_rows();
        assert_eq!(rows[0].text("status"), "free", "{file}");
    }
}

/// Tests that a mesh is scaled, mirrored and converted by words after its file's name and by options. It is seen from
/// the time at which a ball falls onto the corner at (0, 0, 1) of a tetrahedron.
#[test]
fn files_are_adjusted_by_words_after_their_names_and_by_options() {
    let scene = Scene::new("adjusted");
    let path = scene.file("part.obj", crate::TETRAHEDRON_OBJ);
    for (words, options, top) in [
        ("", &[][..], 1.0),
        ("@scale=2", &[], 2.0),
        ("", &["--scale", "2"], 2.0),
        ("@scale=2", &["--scale", "0.5"], 1.0),
        ("@mm", &["--unit", "cm"], 0.1),
        ("@in@scale=2", &["--unit", "ft"], 1.0 / 6.0),
        ("@mirror=z", &[], 0.0),
        ("", &["--mirror", "z"], 0.0),
        ("@mirror=x", &["--surface"], 1.0),
        ("#0@scale=3@surface", &[], 3.0),
    ] {
        let body = format!("{}{words}", name(&path));
        let rows = CommandCall::query(&["--a", &body, "--b", BALL_SPEC])
            .args(options)
            .stdin(FALLING_BALL_MOTION)
            .run_for_rows();
        let early = 4.0 - (top + 0.1) - rows[0].number("time");
        assert!(
            (-1e-9..=1.001e-3).contains(&early),
            "{words} {options:?}: {early}"
        );
    }
    for (word, option) in [("@scale=-1", "--scale=-1"), ("@mirror=w", "--mirror=w")] {
        let body = format!("{}{word}", name(&path));
        for run in [
            CommandCall::query(&["--a", &body, "--b", BALL_SPEC]).stdin(FALLING_BALL_MOTION),
            CommandCall::query(&["--a", name(&path), "--b", BALL_SPEC, option])
                .stdin(FALLING_BALL_MOTION),
            CommandCall::with_args(&["decompose", &body]),
            CommandCall::with_args(&["decompose", name(&path), option]),
        ] {
            run.run_expecting_code(2);
        }
    }
}

#[test]
fn a_body_inside_a_hollow_surface_touches_nothing() {
    let scene = Scene::new("hollow");
    let path = scene.file("part.obj", crate::TETRAHEDRON_OBJ);
    let hollow = format!("{}@surface", name(&path));
    let inside = "b_px,b_py,b_pz\n.1,.1,.1\n";
    for (body, option, status) in [
        (name(&path), &[][..], "overlapping"),
        (&hollow, &[], "free"),
        (name(&path), &["--surface"], "free"),
    ] {
        let run = CommandCall::query(&["--a", body, "--b", "sphere:.01"]).args(option);
        assert_eq!(
            run.stdin(inside).run_for_rows()[0].text("status"),
            status,
            "{body}"
        );
    }
    let out = scene.directory.join("hollow.ccd");
    CommandCall::with_args(&["decompose", &hollow, "--out", name(&out)]).run_expecting_code(0);
    let rows = CommandCall::query(&["--a", name(&out), "--b", "sphere:.01"]).stdin(inside);
    assert_eq!(rows.run_for_rows()[0].text("status"), "free");
    // A prepared body is not adjusted.
    let output = CommandCall::query(&["--a", name(&out), "--b", BALL_SPEC, "--scale", "2"])
        .stdin(FALLING_BALL_MOTION);
    assert!(stderr(&output.output()).contains("a prepared body has its unit"));
}

/// Tests that a ball hits a cylinder and a cone not later than their true shapes, and early by at most their excess. A
/// message states the excess.
#[test]
fn cylinders_and_cones_are_bodies() {
    for (body, side) in [("cylinder:.5,.25", 0.5), ("cone:.5,.25,1e-6", 0.25)] {
        let run = CommandCall::query(&["--a", BALL_SPEC, "--b", body, "--tolerance", "1e-7"]);
        let output = run
            .stdin("a_px,a_vx,duration\n-4,1,4\n")
            .run_expecting_code(0);
        assert_contains(&stderr(&output), "sticking out by up to");
        let rows = crate::parse(&output.stdout);
        // The cone's radius equals its height, so that the slant is at 45 degrees.
        let reach = if side == 0.5 {
            0.6
        } else {
            side + 0.1 * 2f64.sqrt()
        };
        let early = 4.0 - reach - rows[0].number("time");
        let most = if side == 0.5 { 0.5 / 4096.0 } else { 2e-6 } + 1e-6;
        assert!((0.0..=most).contains(&early), "{body}: {early}");
    }
}

#[test]
fn units_are_converted() {
    let scene = Scene::new("units");
    let cube = scene.write_bytes("cube.glb", &glb());
    let die = scene.file("die.obj", &large_cube_obj());
    let (cube, die) = (part(&cube, "base"), format!("{}@mm", name(&die)));
    // The die, of 20 mm, stands on the cube, of 1000 mm, with a gap of 30 mm.
    let above = |unit: f64| {
        let (height, speed) = (0.54 / unit, -0.03 / unit);
        format!("b_pz,b_vz,duration\n{height},{speed},2\n")
    };
    for (unit, metres) in [("m", 1.0), ("mm", 1e-3), ("um", 1e-6), ("in", 0.0254)] {
        let output =
            CommandCall::query(&["--a", &cube, "--b", &die, "--unit", unit, "--tolerance"])
                .args(&[&(1e-4 / metres).to_string()])
                .stdin(&above(metres))
                .run_expecting_code(0);
        let message = stderr(&output);
        let rows = crate::parse(&output.stdout);
        assert_eq!(rows[0].text("status"), "contact", "{unit}: {message}");
        let early = 1.0 - rows[0].number("time");
        assert!(
            (-1e-9..=1.001e-4 / 0.03).contains(&early),
            "{unit}: {early}"
        );
        assert_contains(&message, &format!(" {unit}\n"));
        assert!(!message.contains("give --unit"), "{message}");
    }
}

#[test]
fn without_a_unit_the_numbers_are_kept_and_a_difference_is_reported() {
    let scene = Scene::new("units-kept");
    let cube = part(&scene.write_bytes("cube.glb", &glb()), "base");
    let die = scene.file("die.obj", &large_cube_obj());
    let query = |a: &str, b: &str| {
        CommandCall::query(&["--a", a, "--b", b])
            .stdin("b_pz\n50\n")
            .output()
    };
    let message = stderr(&query(&cube, &format!("{}@mm", name(&die))));
    assert_contains(&message, "size 1 × 1 × 1 m\n");
    assert_contains(&message, "size 20 × 20 × 20 mm\n");
    let expected =
        "--a is in m, --b in mm, and the numbers of both are kept: give --unit m or --unit mm";
    assert_contains(&message, expected);
    // A primitive is in the user's unit; a file is in an unknown one.
    let plain = scene.file("plain.obj", crate::TETRAHEDRON_OBJ);
    for (other, is_told) in [(BALL_SPEC, false), (name(&plain), true)] {
        let message = stderr(&query(&cube, other));
        assert_eq!(message.contains("give --unit"), is_told, "{message}");
    }
    let output = CommandCall::query(&["--a", BALL_SPEC, "--b", BALL_SPEC, "--unit", "mile"])
        .stdin(FALLING_BALL_MOTION)
        .output();
    let message = stderr(&output);
    assert_contains(&message, "um, mm, cm, m, in, ft");
}

#[test]
fn a_part_is_prepared_and_stored() {
    let scene = Scene::new("parts-stored");
    let file = scene.write_bytes("scene.glb", &glb());
    let stored = scene.directory.join("lid.ccd");
    let output =
        CommandCall::with_args(&["decompose", &part(&file, "lid"), "--unit", "mm", "--out"])
            .args(&[name(&stored), "--format", "json"])
            .run_expecting_code(0);
    let statistics: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(statistics["mesh"], part(&file, "lid"));
    assert_eq!(statistics["unit"], "mm");
    assert_eq!(statistics["triangles"], 12);
    // The lid is a slab from 1875 to 2125 mm.
    let rows = CommandCall::query(&["--a", name(&stored), "--b", "sphere:100", "--unit", "mm"])
        .stdin("b_pz,b_vz,duration\n4000,-1000,4\n")
        .run_for_rows();
    let early = 1.775 - rows[0].number("time");
    assert!((0.0..=1.001e-6).contains(&early), "{early}");
    let text = CommandCall::with_args(&["decompose", &part(&file, "lid")]).output();
    let text = String::from_utf8(text.stdout).unwrap();
    assert_contains(&text, "\nunit          m\n");
}

/// Tests that a run is not resumed with another unit, or after a change of the buffer file of a glTF mesh.
#[test]
fn runs_know_their_unit_and_all_their_files() {
    let scene = Scene::new("parts-resume");
    let (mut json, binary) = gltf();
    json["buffers"][0]["uri"] = json!("scene.bin");
    let file = scene.file("scene.gltf", &json.to_string());
    let data = scene.write_bytes("scene.bin", &binary);
    let motions = scene.file("motions.csv", FALLING_BALL_MOTION);
    let results = scene.directory.join("results.csv");
    let run = |unit: &str| {
        CommandCall::with_args(&[
            "query",
            "--a",
            name(&file),
            "--b",
            BALL_SPEC,
            "--unit",
            unit,
        ])
        .args(&[
            "--motions",
            name(&motions),
            "--out",
            name(&results),
            "--resume",
        ])
        .output()
    };
    let first = run("m");
    assert!(first.status.success(), "{}", stderr(&first));
    assert!(run("m").status.success());
    let other = run("mm");
    assert_eq!(other.status.code(), Some(2));
    assert_contains(&stderr(&other), "--unit");
    let mut changed = binary;
    changed[0] ^= 1;
    std::fs::write(&data, changed).unwrap();
    let other = run("m");
    assert_eq!(other.status.code(), Some(2));
    assert_contains(&stderr(&other), "--a");
    // Results must not replace a buffer either.
    let output = CommandCall::with_args(&["query", "--a", name(&file), "--b", BALL_SPEC])
        .args(&["--motions", name(&motions), "--out", name(&data)])
        .output();
    assert_contains(&stderr(&output), "--out would overwrite the file of --a");
}
