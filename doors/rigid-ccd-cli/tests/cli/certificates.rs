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
    let both = ["proofs/0-drop.proof", "proofs/1-aside.proof"];
    let text = check(&scene, &[&both[..], &CUBE_AND_SLAB_OPTIONS].concat(), 0);
    assert_contains(
        &text,
        "proofs/0-drop.proof: holds: 1 pair farther apart than 0 until 0.",
    );
    assert_contains(&text, "; pair 0 within 0.001 more at 0.");
    assert_contains(
        &text,
        "proofs/1-aside.proof: holds: 1 pair farther apart than 0 until 1\n",
    );
    // What overlaps at the start has nothing that could be proven.
    assert!(!scene.directory.join("proofs/2-inside.proof").exists());
}

#[test]
fn statements_and_steps_are_shown() {
    let scene = proofs();
    let text = check(&scene, &["proofs/1-aside.proof", "--show", "--steps"], 0);
    for line in [
        "link 1 on 0 position [0.0, 0.0, 4.0] quaternion [0.0, 0.0, 0.0, 1.0] center [0.0, 0.0, 0.0] axes of the parent",
        "velocity [0.0, 0.0, -1.0] axis [3.0, 0.0,",
        "start 0.0 rate 1.0",
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
    let text = check(
        &scene,
        &["proofs/0-drop.proof", "--a", "box:0.5,0.5,0.6"],
        3,
    );
    assert_contains(&text, "proofs/0-drop.proof: other bodies");
    let path = scene.directory.join("proofs/1-aside.proof");
    let mut forged = fs::read(&path).unwrap();
    // The cube falls at 4 instead of 1: four times what is stated, as a link moves by 4 in a second.
    let velocity = 132..140;
    assert_eq!(forged[velocity.clone()], (-0.25f64).to_le_bytes());
    forged[velocity].copy_from_slice(&(-1.0f64).to_le_bytes());
    fs::write(&path, &forged).unwrap();
    let text = check(&scene, &["proofs/1-aside.proof"], 3);
    assert_contains(&text, "1-aside.proof: broken: ");
    fs::write(&path, b"CCDPROF1").unwrap();
    let text = check(&scene, &["proofs/1-aside.proof"], 2);
    assert_contains(&text, "1-aside.proof: this is no proof");
    let text = check(&scene, &["proofs/0-drop.proof", "--bodies", "."], 2);
    assert_contains(&text, "has no file NAME.mesh");
    // A folder without proofs proves nothing.
    fs::remove_file(scene.directory.join("proofs/0-drop.proof")).unwrap();
    fs::remove_file(&path).unwrap();
    let text = check(&scene, &["proofs"], 2);
    assert_contains(&text, "proofs: has no file NAME.proof");
}

#[test]
fn questions_without_a_first_contact_have_no_proofs() {
    let options = ["query", "--motions", "-", "--certificates", "proofs"];
    for (args, words) in [
        (["--question", "distance"], "--question first-contact"),
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
        let args = ["--edges", table, "--question", "first-contact", "-q"];
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
    let expected = ["0-up", "0.0-path", "0.1-path", "2-down", "3-fold"];
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
        "proofs/0-up.proof: holds: shoulder 0 to -0.2; elbow 0 to 0.5; ",
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

/// Ids that are alike once they are cleaned, equal ids, one of a segment's name and one that is longer than a file name may be.
const ODD_IDS: [&str; 6] = ["a/b", "a_b", "a_b", "p-1", "..", ""];

/// Returns a table of cubes that fall beside a slab, each at its own speed.
fn table_of_odd_ids() -> String {
    let mut table = "id,a_px,a_pz,a_vz\n".to_owned();
    let long = "x".repeat(300);
    for (row, id) in ODD_IDS.iter().copied().chain([&*long]).enumerate() {
        table += &format!("{id},20,4,-{}\n", row + 1);
    }
    table
}

#[test]
fn no_proof_is_lost_and_each_row_is_matched_with_its_own() {
    let scene = Scene::new("odd-ids");
    scene.file("motions.csv", &table_of_odd_ids());
    let query = [
        "query",
        "--motions",
        "motions.csv",
        "--certificates",
        "proofs",
    ];
    let call = || {
        let call = CommandCall::with_args(&query).args(&CUBE_AND_SLAB_OPTIONS);
        call.folder(&scene.directory)
    };
    call().args(&["--out", "results.csv"]).run_expecting_code(0);
    let asked = [&CUBE_AND_SLAB_OPTIONS[..], &["--motions", "motions.csv"]].concat();
    let text = check(&scene, &[&["proofs"][..], &asked].concat(), 0);
    assert_eq!(text.matches(": holds: ").count(), 7, "{text}");
    assert_contains(&text, "row 1 (line 3) a_b: to the end: proofs/1-a_b.proof");
    assert_contains(&text, "row 2 (line 4) a_b: to the end: proofs/2-a_b.proof");
    assert_contains(
        &text,
        "rows: 7; proven to the end: 7, until a contact: 0, in part: 0, without a proof: 0; proofs of no row: 0",
    );
    // Files may have any names.
    let from = scene.directory.join("proofs/1-a_b.proof");
    fs::rename(&from, scene.directory.join("proofs/other.proof")).unwrap();
    let text = check(&scene, &[&["proofs"][..], &asked].concat(), 0);
    assert_contains(&text, "row 1 (line 3) a_b: to the end: proofs/other.proof");
    // One is missing, and two rows have been changed.
    fs::remove_file(scene.directory.join("proofs/other.proof")).unwrap();
    let changed = table_of_odd_ids().replace("4,-1\n", "4,-1.0000000000000002\n");
    scene.file("motions.csv", &(changed + "new,20,4,-9\n"));
    let text = check(&scene, &[&["proofs"][..], &asked].concat(), 3);
    assert_contains(&text, "row 0 (line 2) a/b: has no proof\n");
    assert_contains(&text, "row 1 (line 3) a_b: has no proof\n");
    assert_contains(&text, "proofs/0-a_b.proof: is of no row");
    assert_contains(
        &text,
        "rows: 8; proven to the end: 5, until a contact: 0, in part: 0, without a proof: 3; proofs of no row: 1",
    );
    // A bad row has no proof, and is bad input.
    scene.file("motions.csv", "id,a_px,a_pz,a_vz\na,20,4,x\n");
    let text = check(&scene, &[&["proofs"][..], &asked].concat(), 2);
    assert_contains(
        &text,
        "row 0 (line 2): column a_vz: `x` is not a finite number",
    );
}

/// Tests that a row is proven until its contact, in part if a limit was reached, and for no longer than the table asks for.
#[test]
fn a_row_says_how_far_it_is_proven() {
    let scene = proofs();
    let asked = [
        &["proofs"][..],
        &CUBE_AND_SLAB_OPTIONS,
        &["--motions", "motions.csv"],
    ]
    .concat();
    let text = check(&scene, &asked, 3);
    assert_contains(
        &text,
        "row 0 (line 2) drop: until a contact: proofs/0-drop.proof",
    );
    assert_contains(
        &text,
        "row 1 (line 3) aside: to the end: proofs/1-aside.proof",
    );
    assert_contains(&text, "row 2 (line 4) inside: has no proof\n");
    scene.file(
        "motions.csv",
        &MOTIONS
            .replace("id,", "duration,id,")
            .replace("\ndrop", "\n1,drop")
            .replace("\naside", "\n1.5,aside")
            .replace("\ninside", "\n1,inside"),
    );
    let text = check(&scene, &asked, 3);
    assert_contains(&text, "aside: in part, not to 1.5: proofs/1-aside.proof");
    // A margin is kept by no proof without one.
    let text = check(&scene, &[&asked[..], &["--margin", "0.1"]].concat(), 3);
    assert_contains(&text, "proofs/1-aside.proof: smaller margin: 0\n");
}

#[test]
fn proofs_are_kept_apart_from_those_of_other_runs() {
    let scene = proofs();
    // The same command writes the same again; other bodies would take the meshes from the proofs.
    let query = [
        "query",
        "--motions",
        "motions.csv",
        "--certificates",
        "proofs",
    ];
    let call = |bodies: &[&str]| {
        let call = CommandCall::with_args(&query).args(bodies);
        call.folder(&scene.directory)
    };
    call(&CUBE_AND_SLAB_OPTIONS).run_expecting_code(0);
    let other = ["--a", "box:.5,.5,.6", "--b", "box:9,9,1"];
    assert_contains(
        &call(&other).run_for_messages(2),
        "a.mesh is of other bodies, whose proofs need it",
    );
    // A run that is continued, or has ended, is one with its proofs.
    let out = ["--out", "results.csv", "--no-micros"];
    let continued = [&out[..], &["--resume"]].concat();
    call(&CUBE_AND_SLAB_OPTIONS)
        .args(&out)
        .run_expecting_code(0);
    call(&CUBE_AND_SLAB_OPTIONS)
        .args(&continued)
        .run_expecting_code(0);
    fs::remove_dir_all(scene.directory.join("proofs")).unwrap();
    let message = call(&CUBE_AND_SLAB_OPTIONS)
        .args(&continued)
        .run_for_messages(2);
    assert_contains(
        &message,
        "proofs does not have the proofs of the earlier run",
    );
    let without = CommandCall::with_args(&["query", "--motions", "motions.csv"]);
    let without = without.args(&CUBE_AND_SLAB_OPTIONS).args(&continued);
    let message = without.folder(&scene.directory).run_for_messages(2);
    assert_contains(&message, "--certificates was proofs and is now not given");
    // One run at a time writes to a folder.
    let partial = scene.directory.join("proofs/certificates.partial");
    let lock = fs::File::create(&partial).unwrap();
    lock.try_lock().unwrap();
    let message = call(&CUBE_AND_SLAB_OPTIONS).run_for_messages(2);
    assert_contains(&message, "another run is writing it");
    drop(lock);
    fs::remove_dir_all(scene.directory.join("proofs")).unwrap();
    fs::write(scene.directory.join("proofs"), "a file").unwrap();
    call(&CUBE_AND_SLAB_OPTIONS).run_expecting_code(1);
}

/// A robot with two fingers, of which the second one follows the first one by a factor.
fn gripper(factor: &str) -> String {
    let link = |name: &str| {
        format!(
            "<link name='{name}'><collision><geometry><box size='0.01 0.01 0.04'/></geometry></collision></link>"
        )
    };
    let finger = |name: &str, y: f64, more: &str| {
        format!(
            "<joint name='{name}' type='prismatic'><origin xyz='0 {y} 0.1'/><parent link='palm'/><child link='{name}_finger'/>\
             <axis xyz='0 1 0'/><limit lower='-0.05' upper='0.05' effort='1' velocity='1'/>{more}</joint>"
        )
    };
    let mimic = format!("<mimic joint='grip' multiplier='{factor}'/>");
    let links = ["palm", "grip_finger", "grip2_finger"].map(link).concat();
    let joints = finger("grip", 0.1, "") + &finger("grip2", -0.1, &mimic);
    format!("<robot name='gripper'>{links}{joints}</robot>")
}

#[test]
fn a_proof_of_positions_that_a_robot_cannot_have_is_refused() {
    let scene = Scene::new("gripper");
    scene.file("own.urdf", &gripper("-1"));
    scene.file("other.urdf", &gripper("1"));
    let tight = gripper("1").replace("lower='-0.05' upper='0.05'", "lower='0' upper='0.03'");
    scene.file("tight.urdf", &tight);
    scene.file("moves.csv", "id,from_grip,to_grip\nopen,0.01,0.05\n");
    let edges = [
        "edges",
        "other.urdf",
        "--edges",
        "moves.csv",
        "--certificates",
        "proofs",
    ];
    let call = CommandCall::with_args(&edges).folder(&scene.directory);
    call.run_expecting_code(0);
    let of = |robot: &str, code| {
        check(
            &scene,
            &["proofs", "--robot", robot, "--edges", "moves.csv"],
            code,
        )
    };
    assert_contains(&of("other.urdf", 0), "rows: 1; proven to the end: 1,");
    let text = of("own.urdf", 3);
    assert_contains(
        &text,
        "impossible: joint grip2 is at 0.01, but by its mimic rule for grip it would be at -0.01",
    );
    assert_contains(&text, "row 0 (line 2) open: has no proof");
    let text = of("tight.urdf", 3);
    assert_contains(
        &text,
        "impossible: joint grip is at 0.05, beyond its limits 0 to 0.03",
    );
}

/// Tests that edges and the segments of paths are matched, one at rest and one that touches among them.
#[test]
fn edges_and_paths_of_a_table_are_matched_with_their_proofs() {
    let scene = Scene::new("certificates");
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    for name in ["arm.urdf", "cell.toml", "moves.csv"] {
        fs::copy(examples.join(name), scene.directory.join(name)).unwrap();
    }
    let path = "id,t,shoulder\nfree,0,0\nfree,1,-0.2\nfree,5,0\nrests,0,-0.1\ndown,0,0\ndown,1,-0.1\ndown,2,1.5\ndown,3,0\n";
    scene.file("path.csv", path);
    let robot = ["--cell", "cell.toml", "--joint", "elbow=0.1"];
    let edges = [
        "edges",
        "arm.urdf",
        "--edges",
        "path.csv",
        "--certificates",
        "proofs",
    ];
    let call = CommandCall::with_args(&edges)
        .args(&robot)
        .folder(&scene.directory);
    call.run_expecting_code(0);
    let checked = ["proofs", "--robot", "arm.urdf", "--edges", "path.csv"];
    let text = check(&scene, &[&checked[..], &robot].concat(), 0);
    for line in [
        "row 0 (line 2) free: to the end: proofs/0.0-free.proof proofs/0.1-free.proof\n",
        "row 3 (line 5) rests: to the end: proofs/3-rests.proof\n",
        "row 4 (line 6) down: segment 1 until a contact: proofs/4.0-down.proof proofs/4.1-down.proof\n",
    ] {
        assert_contains(&text, line);
    }
    fs::remove_file(scene.directory.join("proofs/0.1-free.proof")).unwrap();
    let text = check(&scene, &[&checked[..], &robot].concat(), 3);
    assert_contains(
        &text,
        "row 0 (line 2) free: segment 1 has no proof: proofs/0.0-free.proof\n",
    );
    assert_contains(
        &text,
        "rows: 3; proven to the end: 1, until a contact: 1, in part: 1, without a proof: 0",
    );
    // The same motion of another joint position, and another robot's cell.
    let moved = ["--cell", "cell.toml", "--joint", "elbow=0.2"];
    let text = check(&scene, &[&checked[..], &moved].concat(), 3);
    assert_contains(&text, "without a proof: 3; proofs of no row: 4");
}
