//! Tests `ccd replay`: records hold, are refuted, and are refused for another cell.

use crate::command::{CommandCall, Scene, assert_contains};
use rigid_ccd::{Body, Pose, Settings};
use rigid_ccd_robot::evidence::{Evidence, RecordedAnswer, RecordedPath};
use rigid_ccd_robot::{Cell, Item, RobotFile};
use std::fs;
use std::path::{Path, PathBuf};

fn example(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    folder.join(name)
}

/// Returns the record of the edge `down` of the examples, in the cell of the examples.
fn record() -> Evidence {
    let file = RobotFile::from_path(example("arm.urdf"));
    let robot = file.read().unwrap();
    let pairs = file.link_pairs(&robot, None).unwrap();
    let mut cell = Cell::new(robot, pairs);
    let table = Body::cuboid([1.0, 1.0, 0.02]).unwrap();
    let post = Body::cylinder(0.05, 0.5).unwrap();
    for (name, body, at) in [
        ("table", table, [0.0, 0.0, -0.12]),
        ("post", post, [0.8, 0.0, 0.9]),
    ] {
        cell.add_obstacle(name, body, Pose::at(at).unwrap())
            .unwrap();
    }
    let pair = [Item::Link("hand"), Item::Obstacle("post")];
    cell.set_clearance(pair, 0.01).unwrap();
    let path = [[0.0, 0.0], [1.5, 0.0]];
    let answer = RecordedAnswer::try_from(&cell.solver().first_contact(&path).unwrap()).unwrap();
    let path = RecordedPath::configurations(&path);
    Evidence::new(&cell, &Settings::DEFAULT, path, answer).unwrap()
}

/// Returns a folder with the examples and a record.
fn folder(record: &Evidence) -> Scene {
    let scene = Scene::new("replay");
    for name in ["arm.urdf", "cell.toml", "stop.json"] {
        fs::copy(example(name), scene.directory.join(name)).unwrap();
    }
    fs::write(
        scene.directory.join("record.json"),
        record.to_json().unwrap(),
    )
    .unwrap();
    scene
}

fn replay(scene: &Scene, record: &str) -> CommandCall {
    let args = [
        "replay",
        "arm.urdf",
        "--cell",
        "cell.toml",
        "--record",
        record,
    ];
    CommandCall::with_args(&args).folder(&scene.directory)
}

#[track_caller]
fn printed(call: &CommandCall, code: i32) -> String {
    String::from_utf8(call.run_expecting_code(code).stdout).unwrap()
}

#[test]
fn a_true_record_has_the_same_answer() {
    let scene = folder(&record());
    let text = printed(&replay(&scene, "record.json"), 0);
    assert_contains(
        &text,
        "record.json: contact of hand and table in segment 0 at 0.",
    );
    assert_contains(&text, "same answer");
}

/// Tests that the record of the examples holds. If bodies have changed since it was written, the message says where a new one is.
#[test]
fn the_record_of_the_examples_holds() {
    let scene = folder(&record());
    let output = replay(&scene, "stop.json").output();
    let fresh = Path::new(env!("CARGO_TARGET_TMPDIR")).join("stop.json");
    fs::copy(scene.directory.join("record.json"), &fresh).unwrap();
    assert!(
        output.status.success(),
        "{}\nreplace examples/stop.json by {}",
        String::from_utf8_lossy(&output.stderr),
        fresh.display()
    );
}

#[test]
fn a_false_record_is_refuted() {
    let answer = RecordedAnswer::Unresolved {
        limit: "deadline".to_owned(),
        segment: 0,
        fraction: 0.5,
    };
    let scene = folder(&Evidence { answer, ..record() });
    let text = printed(&replay(&scene, "record.json"), 3);
    assert_contains(&text, "unresolved (deadline), free until segment 0 at 0.5");
    assert_contains(&text, "refuted: touches in segment 0 at 0.1");
}

#[test]
fn what_a_limit_left_free_holds() {
    let answer = RecordedAnswer::Unresolved {
        limit: "deadline".to_owned(),
        segment: 0,
        fraction: 0.125,
    };
    let scene = folder(&Evidence { answer, ..record() });
    let text = printed(&replay(&scene, "record.json"), 0);
    assert_contains(&text, "holds; without the limit: contact of hand and table");
}

#[test]
fn another_cell_and_what_is_no_record_are_bad_input() {
    let scene = folder(&record());
    fs::write(scene.directory.join("nothing.json"), "{").unwrap();
    let both = replay(&scene, "nothing.json").args(&["--record", "record.json"]);
    let output = both.run_expecting_code(2);
    assert_contains(&crate::stderr(&output), "nothing.json: not a record");
    assert_contains(&String::from_utf8(output.stdout).unwrap(), "same answer");
    let cell = fs::read_to_string(scene.directory.join("cell.toml")).unwrap();
    let moved = cell.replace("-0.12", "-0.13");
    assert_ne!(cell, moved);
    fs::write(scene.directory.join("cell.toml"), moved).unwrap();
    let message = replay(&scene, "record.json").run_for_messages(2);
    assert_contains(&message, "`table` is elsewhere");
    let missing = replay(&scene, "missing.json").run_for_messages(2);
    assert_contains(&missing, "missing.json: cannot read it");
}
