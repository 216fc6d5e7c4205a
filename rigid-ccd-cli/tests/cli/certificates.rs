//! Tests `--certificates` and `ccd check`: proofs of answers hold; forged ones, and those of other bodies, do not.

use crate::CUBE_AND_SLAB_OPTIONS;
use crate::command::{CommandCall, Scene, assert_contains, stderr};
use std::fs;
use std::path::Path;

const MOTIONS: &str = "id,a_pz,a_vz,a_wx\ndrop,4,-4,1\naside,4,-1,3\ninside,0,0,0\n";

/// Returns a folder with the proofs of the answers about a cube above a slab.
fn proofs() -> Scene {
    let scene = Scene::new("certificates");
    scene.file("motions.csv", MOTIONS);
    let args = [
        "query",
        "--motions",
        "motions.csv",
        "--certificates",
        "proofs",
    ];
    let call = CommandCall::with_args(&args).args(&CUBE_AND_SLAB_OPTIONS);
    let rows = call.folder(&scene.directory).run_for_rows();
    let statuses: Vec<&str> = rows.iter().map(|row| row.text("status")).collect();
    assert_eq!(statuses, ["contact", "free", "overlapping"]);
    scene
}

/// Runs `ccd check` in a folder, and returns what it prints.
#[track_caller]
fn check(scene: &Scene, args: &[&str], code: i32) -> String {
    let call = CommandCall::with_args(&["check"]).args(args);
    let output = call.folder(&scene.directory).run_expecting_code(code);
    String::from_utf8(output.stdout.clone()).unwrap() + &stderr(&output)
}

#[test]
fn proofs_of_a_contact_and_of_a_free_row_hold() {
    let scene = proofs();
    let both = ["proofs/drop.proof", "proofs/aside.proof"];
    let text = check(&scene, &[&both[..], &CUBE_AND_SLAB_OPTIONS].concat(), 0);
    assert_contains(
        &text,
        "proofs/drop.proof: holds: 1 pair farther apart than 0 until 0.",
    );
    assert_contains(&text, "; pair 0 within 0.001 more at 0.");
    assert_contains(
        &text,
        "proofs/aside.proof: holds: 1 pair farther apart than 0 until 1\n",
    );
    // What overlaps at the start has nothing that could be proven.
    assert!(!scene.directory.join("proofs/inside.proof").exists());
}

#[test]
fn statements_and_steps_are_shown() {
    let scene = proofs();
    let text = check(&scene, &["proofs/aside.proof", "--show", "--steps"], 0);
    for line in [
        "link 1 on 0 position [0.0, 0.0, 4.0] quaternion [0.0, 0.0, 0.0, 1.0] centre [0.0, 0.0, 0.0] axes of the parent",
        "velocity [0.0, 0.0, -0.25] axis [0.75, 0.0,",
        "start 0.0 rate 4.0",
        "body 0 ",
        "pair 0 of 0 and 1 margin 0.0",
        "until 1.0",
        "ball around ",
    ] {
        assert_contains(&text, line);
    }
}

#[test]
fn forged_proofs_and_those_of_other_bodies_are_refused() {
    let scene = proofs();
    let text = check(&scene, &["proofs/drop.proof", "--a", "box:0.5,0.5,0.6"], 3);
    assert_contains(&text, "proofs/drop.proof: other bodies");
    let path = scene.directory.join("proofs/aside.proof");
    let mut forged = fs::read(&path).unwrap();
    // The cube falls at 4 instead of 1: four times what is stated, as a link moves by 4 in a second.
    let velocity = 132..140;
    assert_eq!(forged[velocity.clone()], (-0.25f64).to_le_bytes());
    forged[velocity].copy_from_slice(&(-1.0f64).to_le_bytes());
    fs::write(&path, &forged).unwrap();
    let text = check(&scene, &["proofs/aside.proof"], 3);
    assert_contains(&text, "aside.proof: broken: ");
    fs::write(&path, b"CCDPROF1").unwrap();
    let text = check(&scene, &["proofs/aside.proof"], 2);
    assert_contains(&text, "aside.proof: this is no proof");
    let text = check(&scene, &["proofs/drop.proof", "--bodies", "."], 2);
    assert_contains(&text, "has no file NAME.mesh");
}

#[test]
fn questions_without_a_first_contact_have_no_proofs() {
    let options = ["query", "--motions", "-", "--certificates", "proofs"];
    for (args, words) in [
        (["--ask", "distance"], "--ask first-contact"),
        (["--start", "leave"], "--start report"),
    ] {
        let call = CommandCall::with_args(&options).args(&args);
        let call = call.args(&CUBE_AND_SLAB_OPTIONS).stdin(MOTIONS);
        assert_contains(&call.run_for_messages(2), words);
    }
}

/// Each pair of the cell is in the proof of an edge; a path has a proof for each segment until it touches.
#[test]
fn proofs_of_edges_and_paths_of_a_robot_hold() {
    let scene = Scene::new("certificates");
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    // The cylinder of the cell exceeds its shape, but is a polytope as the engine sees it.
    for name in ["arm.urdf", "cell.toml", "moves.csv"] {
        fs::copy(examples.join(name), scene.directory.join(name)).unwrap();
    }
    let path = "id,shoulder,elbow\npath,0,0\npath,-0.2,0.5\npath,0,1\n";
    scene.file("path.csv", path);
    let options = [
        "edges",
        "arm.urdf",
        "--cell",
        "cell.toml",
        "--certificates",
        "proofs",
    ];
    for table in ["moves.csv", "path.csv"] {
        let args = ["--edges", table, "--ask", "first-contact", "-q"];
        let call = CommandCall::with_args(&options).args(&args);
        call.folder(&scene.directory).run_expecting_code(0);
    }
    let mut names: Vec<String> = fs::read_dir(scene.directory.join("proofs"))
        .unwrap()
        .map(|entry| format!("proofs/{}", entry.unwrap().file_name().display()))
        .filter(|name| name.ends_with(".proof"))
        .collect();
    names.sort();
    // The edge into the table begins in contact.
    let expected = ["down", "fold", "path-0", "path-1", "up"];
    assert_eq!(names, expected.map(|name| format!("proofs/{name}.proof")));
    let args: Vec<&str> = names.iter().map(String::as_str).collect();
    let text = check(&scene, &args, 0);
    assert_eq!(text.matches(": holds: ").count(), names.len(), "{text}");
    assert_contains(&text, " pairs farther apart than 0 until ");
    assert_contains(&text, "; pair ");
    // They are about this cell, and about no other one.
    let of_cell = ["--robot", "arm.urdf", "--cell", "cell.toml"];
    let text = check(&scene, &[&args[..], &of_cell[..]].concat(), 0);
    assert_contains(
        &text,
        "proofs/up.proof: holds: shoulder 0 to -0.2; elbow 0 to 0.5; ",
    );
    let cell = fs::read_to_string(scene.directory.join("cell.toml")).unwrap();
    let moved = cell.replace(
        "position = [0.8, 0, 0.9]",
        "position = [0.8, 0, 0.9000000001]",
    );
    assert_ne!(moved, cell);
    scene.file("moved.toml", &moved);
    for other in [
        &["--robot", "arm.urdf", "--cell", "moved.toml"][..],
        &["--robot", "arm.urdf"],
        &[&of_cell[..], &["--clearance", "1mm"]].concat(),
    ] {
        let text = check(&scene, &[&args[..], other].concat(), 3);
        assert_eq!(text.matches(": other cell").count(), names.len(), "{text}");
    }
}
