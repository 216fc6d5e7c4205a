//! Tests `ccd decompose`, and queries on prepared bodies.

use crate::command::{CommandCall, Row, Scene, assert_contains, stderr};
use ccd_decomp::{Format, TriangleMesh};
use rstest::rstest;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Output;

const TETRAHEDRON: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
/// The OBJ text of a tetrahedron without its last face.
const OPEN_TETRAHEDRON_OBJ: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n";

/// Writes the mesh of a trefoil knot with 216 triangles, which is not convex.
fn knot(scene: &Scene) -> PathBuf {
    scene.file(
        "knot.obj",
        include_str!("../../../../rigid-ccd/tests/data/knot216.obj"),
    )
}

fn name(path: &Path) -> &str {
    path.to_str().unwrap()
}

fn decompose(mesh: &Path, options: &[&str]) -> Output {
    CommandCall::with_args(&["decompose", name(mesh)])
        .args(options)
        .output()
}

/// Returns the JSON object that `--format json` prints for a mesh.
fn run_for_statistics(mesh: &Path, options: &[&str]) -> Value {
    let output = decompose(mesh, &[options, &["--format", "json"]].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(stderr(&output), "");
    assert_eq!(output.stdout.iter().filter(|&&b| b == b'\n').count(), 1);
    serde_json::from_slice(&output.stdout).unwrap()
}

#[rstest]
#[case("triangles", 216)]
#[case("patches", 108)]
fn a_knot_is_exact_in_every_kind_of_piece(#[case] kind: &str, #[case] most: u64) {
    let scene = Scene::new(&format!("decompose-{kind}"));
    let mesh = knot(&scene);
    let statistics = run_for_statistics(&mesh, &["--pieces", kind]);
    assert_eq!(statistics["mesh"], name(&mesh));
    assert_eq!(statistics["pieces_kind"], kind);
    assert_eq!(statistics["triangles"], 216);
    let pieces = statistics["pieces"].as_u64().unwrap();
    assert!((1..=most).contains(&pieces), "{pieces}");
    assert_eq!(statistics["tree_nodes"], 2 * pieces - 1);
    assert_eq!(statistics["exact"], true);
    assert_eq!(statistics["excess"], 0.0);
    assert_eq!(statistics["volume"], "solid");
    assert!(statistics["build_ms"].as_f64().unwrap() > 0.0);
    // A point has 24 bytes.
    assert!(statistics["bytes"].as_u64().unwrap() > 24 * pieces);
    let hidden = statistics["virtual_faces"].as_u64().unwrap();
    assert_eq!(hidden > 0, kind == "patches");
}

#[test]
fn statistics_are_aligned_lines() {
    let scene = Scene::new("decompose-text");
    let output = decompose(&knot(&scene), &["--pieces", "patches"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    assert_contains(&text, "knot.obj: 216 triangles\n");
    assert_contains(&text, " patches, solid\n");
    for line in [
        "pieces",
        "why",
        "virtual faces",
        "tree nodes",
        "build",
        "memory",
        "error",
    ] {
        let starts = |l: &str| l.starts_with(line) && l.chars().nth(13) == Some(' ');
        assert!(text.lines().any(starts), "{line}: {text}");
    }
    assert!(text.ends_with("none: the pieces are exact\n"), "{text}");
}

#[test]
fn a_convex_mesh_is_one_hull() {
    let scene = Scene::new("decompose-hull");
    let mesh = scene.file("tetrahedron.obj", TETRAHEDRON);
    for kind in ["auto", "hull"] {
        let statistics = run_for_statistics(&mesh, &["--pieces", kind]);
        assert_eq!(
            (&statistics["pieces_kind"], &statistics["pieces"]),
            (&"hull".into(), &1.into())
        );
        assert_eq!(statistics["exact"], true);
    }
}

#[rstest]
#[case("cresting")]
#[case("breadth-first")]
#[case("depth-first")]
fn every_order_covers_the_mesh(#[case] order: &str) {
    let scene = Scene::new(&format!("decompose-{order}"));
    let mesh = knot(&scene);
    let statistics = run_for_statistics(&mesh, &["--pieces", "patches", "--order", order]);
    assert_eq!(statistics["pieces_kind"], "patches");
    assert!(statistics["pieces"].as_u64().unwrap() < 216 / 2);
}

#[test]
fn an_outer_hull_reports_its_excess() {
    let scene = Scene::new("decompose-outer-hull");
    let mesh = knot(&scene);
    let statistics = run_for_statistics(&mesh, &["--pieces", "outer-hull"]);
    assert_eq!(statistics["pieces_kind"], "outer-hull");
    assert_eq!(statistics["pieces"], 1);
    assert_eq!(statistics["exact"], false);
    assert!(statistics["excess"].as_f64().unwrap() > 0.0);
    let text = decompose(&mesh, &["--pieces", "outer-hull"]);
    let text = String::from_utf8(text.stdout).unwrap();
    assert_contains(&text, "stick out by at most");
}

#[test]
fn pieces_are_written_as_groups() {
    let scene = Scene::new("decompose-obj");
    let mesh = knot(&scene);
    let out = scene.directory.join("pieces.obj");
    let statistics = run_for_statistics(&mesh, &["--pieces", "patches", "--out", name(&out)]);
    let text = std::fs::read_to_string(&out).unwrap();
    let groups = text.lines().filter(|line| line.starts_with("g piece_"));
    assert_eq!(
        groups.count() as u64,
        statistics["pieces"].as_u64().unwrap()
    );
    let again = TriangleMesh::from_reader(Format::Obj, text.as_bytes()).unwrap();
    assert!(again.faces().len() >= 216);
}

const MOTIONS_TABLE: &str = "id,a_px,a_py,a_pz,a_vx,a_vy,a_vz,a_wx,a_wz\n\
    straight,4,0.1,0.2,-4,0,0,0,0\nturning,4,-0.3,0.1,-4,0,0,3,2\n\
    past,4,9,0,-4,0,0,1,1\nacross,0.2,4,1,0,-4,-0.5,0,5\n";

fn query_with_itself(body: &Path, options: &[&str]) -> Vec<Row> {
    let run = CommandCall::query(&["--a", name(body), "--b", name(body)]).args(options);
    run.stdin(MOTIONS_TABLE).run_for_rows()
}

#[rstest]
#[case("triangles")]
#[case("patches")]
#[case("outer-hull")]
fn a_stored_body_answers_as_its_mesh_does(#[case] kind: &str) {
    let scene = Scene::new(&format!("stored-{kind}"));
    let mesh = knot(&scene);
    let out = scene.directory.join("knot.ccd");
    run_for_statistics(&mesh, &["--pieces", kind, "--out", name(&out)]);
    let all =
        |rows: Vec<Row>| -> Vec<_> { rows.into_iter().map(Row::cells_without_micros).collect() };
    let from_mesh = all(query_with_itself(&mesh, &["--pieces", kind]));
    assert!(from_mesh.iter().any(|row| row[1] == "contact"));
    assert_eq!(all(query_with_itself(&out, &[])), from_mesh);
}

#[test]
fn patches_and_triangles_hit_at_the_same_time() {
    let scene = Scene::new("patches-triangles");
    let mesh = knot(&scene);
    let with = |kind| query_with_itself(&mesh, &["--pieces", kind, "--tolerance", "1e-6"]);
    let (triangles, patches) = (with("triangles"), with("patches"));
    assert_eq!(patches[0].text("status"), "contact");
    for (one, other) in triangles.iter().zip(&patches) {
        assert_eq!(one.text("status"), other.text("status"));
    }
    // The first row flies along x at speed 4.
    let closing_speed = 4.0 * triangles[0].number("normal_x").abs();
    let apart = (triangles[0].number("time") - patches[0].number("time")).abs();
    assert!(apart <= 2e-6 / closing_speed, "{apart}");
}

#[test]
fn hull_trees_are_stored_and_used() {
    let scene = Scene::new("hull-tree");
    let mesh = knot(&scene);
    let out = scene.directory.join("knot.ccd");
    let options = ["--pieces", "patches", "--hull-tree", "--out", name(&out)];
    let statistics = run_for_statistics(&mesh, &options);
    assert_eq!(statistics["hulls"], statistics["tree_nodes"]);
    let tree = query_with_itself(&out, &["--schedule", "fast"]);
    let boxes = query_with_itself(&out, &["--schedule", "best-first"]);
    for (one, other) in tree.iter().zip(&boxes) {
        assert_eq!(one.text("status"), other.text("status"));
    }
}

#[test]
fn early_contacts_of_approximate_bodies_are_reported() {
    let scene = Scene::new("outer-hull-warning");
    let mesh = knot(&scene);
    let run = |options: &[&str]| {
        let run = CommandCall::query(&["--a", name(&mesh), "--b", name(&mesh)]).args(options);
        run.stdin(MOTIONS_TABLE).output()
    };
    let output = run(&["--pieces", "outer-hull"]);
    assert!(output.status.success());
    assert_contains(&stderr(&output), "early");
    let output = run(&["--pieces", "patches"]);
    assert!(!stderr(&output).contains("early"), "{}", stderr(&output));
}

#[test]
fn meshes_without_pieces_are_reported() {
    let scene = Scene::new("decompose-bad");
    let open = scene.file("open.obj", OPEN_TETRAHEDRON_OBJ);
    for (mesh, kind, expected) in [
        (open.clone(), "patches", "e0-2"),
        (open.clone(), "hull", "open.obj"),
        (knot(&scene), "hull", "convex"),
        (scene.directory.join("missing.obj"), "auto", "missing.obj"),
        (scene.file("part.txt", ""), "auto", ".obj"),
    ] {
        let output = decompose(&mesh, &["--pieces", kind]);
        assert_eq!(output.status.code(), Some(2), "{mesh:?} {kind}");
        assert_eq!(output.stdout, b"");
        let message = stderr(&output);
        assert_contains(&message, expected);
    }
    let statistics = run_for_statistics(&open, &["--pieces", "auto"]);
    assert_eq!(statistics["pieces_kind"], "triangles");
    assert_eq!(statistics["volume"], "surface");
    assert!(statistics["remarks"].as_str().unwrap().contains("open"));
}

#[rstest]
#[case(&["--out", "knot.txt"], ".ccd")]
#[case(&["--pieces", "triangles", "--order", "cresting"], "--order")]
#[case(&["--pieces", "pieces"], "patches")]
fn options_that_do_not_go_together_are_refused(#[case] options: &[&str], #[case] expected: &str) {
    let scene = Scene::new("decompose-options");
    let output = decompose(&scene.file("part.obj", TETRAHEDRON), options);
    assert_eq!(output.status.code(), Some(2), "{options:?}");
    assert_contains(&stderr(&output), expected);
}

#[test]
fn a_mesh_is_never_overwritten() {
    let scene = Scene::new("decompose-overwrite");
    let mesh = scene.file("part.obj", TETRAHEDRON);
    let same = scene.directory.join(".").join("part.obj");
    let output = decompose(&mesh, &["--out", name(&same)]);
    assert_eq!(output.status.code(), Some(2));
    assert_contains(&stderr(&output), "overwrite");
    assert_eq!(std::fs::read_to_string(&mesh).unwrap(), TETRAHEDRON);
}

#[rstest]
#[case("pieces.obj")]
#[case("body.ccd")]
fn an_unwritable_result_has_exit_code_1(#[case] file: &str) {
    let scene = Scene::new("decompose-unwritable");
    let mesh = scene.file("part.obj", TETRAHEDRON);
    let out = format!("/no/such/directory/{file}");
    let output = decompose(&mesh, &["--out", &out]);
    assert_eq!(output.status.code(), Some(1));
    assert_contains(&stderr(&output), file);
}

#[test]
fn unreadable_stored_bodies_are_reported() {
    let scene = Scene::new("stored-bad");
    let mesh = scene.file("part.obj", TETRAHEDRON);
    let out = scene.directory.join("part.ccd");
    run_for_statistics(&mesh, &["--out", name(&out)]);
    let bytes = std::fs::read(&out).unwrap();
    let mut damaged = bytes.clone();
    damaged[30] ^= 1;
    for (bytes, expected) in [
        (&damaged[..], "part.ccd: is damaged"),
        (&bytes[..50], "part.ccd: is cut short"),
        (b"v 0 0 0", "part.ccd: holds no stored body"),
    ] {
        std::fs::write(&out, bytes).unwrap();
        let message = CommandCall::query(&["--a", name(&out), "--b", "sphere:1"])
            .stdin("id\n")
            .run_for_messages(2);
        assert!(
            message.contains("--a: ") && message.contains(expected),
            "{message}"
        );
        assert_contains(&message, "ccd decompose");
    }
}

#[test]
fn help_lists_the_statistics() {
    for (option, expected) in [("-h", "--out knot.ccd"), ("--help", "excess")] {
        let output = CommandCall::with_args(&["decompose", option]).run_expecting_code(0);
        let text = String::from_utf8(output.stdout).unwrap();
        assert_contains(&text, expected);
    }
}

#[test]
fn a_missing_folder_is_reported_before_the_work() {
    let scene = Scene::new("decompose-no-folder");
    let mesh = scene.file("t.obj", crate::TETRAHEDRON_OBJ);
    for name in ["t.obj", "t.ccd"] {
        let out = scene.directory.join("gone").join(name);
        let run = CommandCall::with_args(&["decompose", mesh.to_str().unwrap()]);
        let message = run
            .args(&["--out", out.to_str().unwrap()])
            .stdin("")
            .run_for_messages(1);
        assert_contains(&message, "gone is a folder that does not exist");
    }
}
