//! Tests what the commands of robots say to those who use them for the first time.

use crate::command::{CommandCall, assert_contains, stderr};
use crate::robots::{EDGES, call, folder};
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};

/// Tests that a check of no row fails, here and in `ccd query`, and that the reason is named.
#[test]
fn no_row_is_no_proof() {
    let scene = folder();
    let selects_none = "and --rows 50..90 selects none of them";
    let none = || call(&scene, &EDGES).args(&["--rows", "50..90"]);
    let message = none().args(&["--check"]).run_for_messages(2);
    assert_contains(&message, selects_none);
    assert_contains(&message, "--check: no row is answered");
    assert_contains(&none().run_for_messages(0), selects_none);
    let query = [
        "query",
        "--a",
        "sphere:1",
        "--b",
        "sphere:1",
        "--motions",
        "-",
    ];
    for (table, rows) in [("a_px\n", "0.."), ("a_px\n3\n", "5..9")] {
        let query = || {
            CommandCall::with_args(&query)
                .args(&["--rows", rows])
                .stdin(table)
        };
        query().run_expecting_code(0);
        let message = query().args(&["--check"]).run_for_messages(2);
        assert_contains(&message, "--check: no row is answered");
    }
}

/// A carriage that slides on a rail without a gap, and at its end into a block: no number of boxes decides about both.
#[cfg(unix)]
const ON_RAIL: &str = r#"<robot name="rail">
    <link name="rail">
        <collision><origin xyz="0 0 -0.5"/><geometry><box size="8 2 1"/></geometry></collision>
        <collision><origin xyz="2 0 0.4"/><geometry><box size="1 1 1"/></geometry></collision>
    </link>
    <link name="carriage"><collision><origin xyz="0 0 0.25"/><geometry><box size="0.5 0.5 0.5"/></geometry></collision></link>
    <link name="lamp"><collision><origin xyz="0 0 5"/><geometry><box size="0.5 0.5 0.5"/></geometry></collision></link>
    <joint name="slide" type="prismatic"><parent link="rail"/><child link="carriage"/><axis xyz="1 0 0"/>
        <limit lower="0" upper="2" effort="1" velocity="1"/></joint>
    <joint name="lift" type="prismatic"><parent link="carriage"/><child link="lamp"/><axis xyz="0 0 1"/>
        <limit lower="0" upper="2" effort="1" velocity="1"/></joint>
</robot>"#;

/// Tests that an interrupted search writes what it has decided, and leaves no unfinished file.
#[test]
#[cfg(unix)]
fn an_interrupted_search_writes_what_is_decided() {
    let scene = folder();
    scene.file("rail.urdf", ON_RAIL);
    let mut child = Command::new(crate::PROGRAM_PATH)
        .args(["acm", "rail.urdf", "--boxes", "4000000000"])
        .args(["--out", "rail.srdf", "--report", "pairs.csv"])
        .current_dir(&scene.directory)
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut messages = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    while !line.contains("bodies") {
        line.clear();
        assert_ne!(messages.read_line(&mut line).unwrap(), 0);
    }
    let id = child.id().to_string();
    let sent = Command::new("kill").args(["-INT", &id]).status().unwrap();
    assert!(sent.success());
    let mut rest = String::new();
    messages.read_to_string(&mut rest).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(3), "{rest}");
    assert_contains(&rest, "interrupted: ");
    let pairs = fs::read_to_string(scene.directory.join("pairs.csv")).unwrap();
    assert_eq!(pairs.lines().count(), 4, "{pairs}");
    assert_contains(&pairs, "rail,carriage,undecided");
    let names: Vec<_> = fs::read_dir(&scene.directory).unwrap().collect();
    let is_partial = |name: &str| name.ends_with(".partial");
    assert!(names.iter().all(|entry| {
        let name = entry.as_ref().unwrap().file_name();
        !is_partial(&name.to_string_lossy())
    }));
    let srdf = fs::read_to_string(scene.directory.join("rail.srdf")).unwrap();
    assert_contains(&srdf, "</robot>");
}

/// Tests that `ccd clearance` compares the distance that it measures, as `ccd edges` does, and says that others do not count.
#[test]
fn a_required_clearance_is_that_of_the_least_distance() {
    let scene = folder();
    let cell = "[[obstacle]]\nname = 'wall'\nbody = 'box:0.1,0.1,0.1'\nposition = [0, 0, -0.2]\n";
    scene.file(
        "rail.urdf",
        r#"<robot name="rail"><link name="rail"/>
            <link name="ball"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
            <joint name="slide" type="prismatic"><parent link="rail"/><child link="ball"/><axis xyz="1 0 0"/>
            <limit lower="0" upper="0.05" effort="1" velocity="1"/></joint></robot>"#,
    );
    // The ball is 0.03 above the wall, and keeps 0.02.
    let distances =
        "[padding]\nball = 0.05\n[[clearance]]\nbetween = ['ball', 'post']\ndistance = 0.5\n";
    let post = "[[obstacle]]\nname = 'post'\nbody = 'box:0.1,0.1,0.1'\nposition = [0, 0, 0.4]\n";
    let cell = cell.replace("-0.2]", "-0.23]");
    scene.file("cell.toml", &format!("{cell}{post}{distances}"));
    let clearance = ["clearance", "rail.urdf", "--cell", "cell.toml", "--require"];
    let output = call(&scene, &clearance)
        .args(&["20mm"])
        .run_expecting_code(0);
    let messages = String::from_utf8(output.stderr).unwrap();
    assert_contains(&messages, "[padding] and [[clearance]] do not count");
    call(&scene, &clearance)
        .args(&["31mm"])
        .run_expecting_code(3);
    scene.file("moves.csv", "from_slide,to_slide\n0,0.05\n");
    for (clearance, code) in [("20mm", 0), ("31mm", 3)] {
        call(
            &scene,
            &[
                "edges",
                "rail.urdf",
                "--cell",
                "cell.toml",
                "--edges",
                "moves.csv",
            ],
        )
        .args(&[
            "--question",
            "closest-approach",
            "--check",
            "--clearance",
            clearance,
        ])
        .run_expecting_code(code);
    }
    // Without any there is nothing to say.
    scene.file("cell.toml", &format!("{cell}{post}"));
    let message = call(&scene, &clearance).args(&["20mm"]).run_for_messages(0);
    assert!(!message.contains("do not count"), "{message}");
}

/// Tests the messages about files that are not what an argument takes.
#[test]
fn files_of_another_kind_are_named() {
    let scene = folder();
    let edges = call(&scene, &["edges", "cell.toml", "--edges", "moves.csv"]);
    assert_contains(
        &edges.run_for_messages(2),
        "ROBOT is a URDF or MJCF file; --cell takes its surroundings",
    );
    for (file, expected) in [
        ("nix", "nix: no such file or folder"),
        ("moves.csv", "moves.csv: this is no proof"),
        (".", ".: has no file NAME.proof"),
    ] {
        let message = call(&scene, &["check", file]).run_for_messages(2);
        assert_contains(&message, expected);
        assert!(!message.contains("NAME.mesh"), "{message}");
    }
}

/// Tests that a scene is read from standard input.
#[test]
fn a_scene_is_read_from_standard_input() {
    let table = "body,id,px,vx\nsphere:.5,ball,-3,4\n\"box:.5,1,1\",wall,0,0\n";
    let rows = CommandCall::with_args(&["scene", "-"])
        .stdin(table)
        .run_for_rows();
    assert_eq!(rows.len(), 1);
    assert_eq!(rows[0].text("status"), "contact");
}

/// Tests that `ccd check` asks about the rows that are named, and that proofs of other rows are of a row.
#[test]
fn rows_of_a_table_are_checked_that_are_asked_for() {
    let scene = folder();
    let edges = ["--edges", "moves.csv", "--cell", "cell.toml"];
    call(&scene, &["edges", "arm.urdf"])
        .args(&edges)
        .args(&["--rows", "0..1", "--certificates", "proofs"])
        .run_expecting_code(0);
    let check = || call(&scene, &["check", "proofs", "--robot", "arm.urdf"]).args(&edges);
    check().run_expecting_code(3);
    let rows = |range: &str, code: i32| {
        let output = check().args(&["--rows", range]).run_expecting_code(code);
        String::from_utf8(output.stdout).unwrap()
    };
    let text = rows("0..1", 0);
    assert_contains(&text, "rows: 1; proven to the end: 1");
    let text = rows("1..2", 3);
    assert_contains(&text, "rows: 1; proven to the end: 0");
    assert_contains(&text, "proofs of no row: 0");
    rows("50..", 2);
}

/// Tests that a position in degrees where radians are meant gives one warning, of a joint that no limit refuses.
#[test]
fn positions_in_degrees_are_remarked_upon() {
    let scene = folder();
    let wheel = r#"<robot name="wheel">
        <link name="axle"><collision><origin xyz="5 0 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
        <link name="fork"/>
        <link name="rim"><collision><origin xyz="1 0 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
        <joint name="fork" type="fixed"><parent link="axle"/><child link="fork"/></joint>
        <joint name="turn" type="continuous"><parent link="fork"/><child link="rim"/><axis xyz="0 0 1"/></joint>
    </robot>"#;
    scene.file("wheel.urdf", wheel);
    let warning = "joint turn: a joint's position is a round number of degrees";
    for (last, expected) in [("90", 1), ("1.5", 0)] {
        scene.file(
            "turns.csv",
            &format!("id,turn\na,0\na,{last}\nb,0\nb,{last}\n"),
        );
        for table in [["edges", "--edges"], ["clearance", "--path"]] {
            let [command, option] = table;
            let args = [command, "wheel.urdf", option, "turns.csv"];
            let message = stderr(&call(&scene, &args).output());
            assert_eq!(
                message.matches(warning).count(),
                expected,
                "{args:?}: {message}"
            );
        }
    }
}
