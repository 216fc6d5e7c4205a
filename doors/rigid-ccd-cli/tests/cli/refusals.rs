//! Tests invalid rows, bodies, files and options, and their messages.

use crate::command::{CommandCall, Scene, assert_contains, parse, stderr};
use crate::{CUBE_AND_SLAB_OPTIONS, FALLING_CUBE_MOTION};

#[test]
fn bad_rows_keep_their_place_and_are_reported() {
    let motions = "id,a_pz,a_vz,b_qw,b_qx,b_qy,b_qz,b_end_px,b_end_py,b_end_pz,b_wx,duration\n\
                   good,4,-4,1,0,0,0,,,,0,1\n\
                   text,4,abc,1,0,0,0,,,,0,1\n\
                   partial,4,-4,1,0,0,,,,,0,1\n\
                   zero,4,-4,0,0,0,0,,,,0,1\n\
                   both,4,-4,1,0,0,0,1,1,1,0,1\n\
                   infinite,inf,-4,1,0,0,0,,,,0,1\n\
                   backwards,4,-4,1,0,0,0,,,,0,-1\n\
                   short,4\n\
                   also good,4,-4,1,0,0,0,,,,0,1\n";
    let output = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .stdin(motions)
        .run_expecting_code(2);
    let rows = parse(&output.stdout);
    let message = stderr(&output);
    for (k, (id, reason)) in [
        ("good", ""),
        ("text", "column a_vz: `abc`"),
        (
            "partial",
            "column b_qz: no value, and an empty cell has no default",
        ),
        ("zero", "columns b_qw b_qx b_qy b_qz: (0 0 0 0)"),
        ("both", "columns b_end_px and b_wx"),
        ("infinite", "column a_pz: `inf`"),
        ("backwards", "column duration: -1"),
        ("short", "has 2 cells, but the header has 12"),
        ("also good", ""),
    ]
    .into_iter()
    .enumerate()
    {
        assert_eq!(rows[k].text("id"), id);
        assert!(rows[k].text("reason").starts_with(reason), "{id}");
        let status = if reason.is_empty() {
            "contact"
        } else {
            "error"
        };
        assert_eq!(rows[k].text("status"), status);
        if status == "error" {
            assert_eq!([rows[k].text("time"), rows[k].text("micros")], ["", ""]);
            // The first few are reported at once.
            let (row, line) = (k, k + 2);
            let expected = format!("standard input, row {row} (line {line}): {reason}");
            assert_eq!(
                message.contains(&expected),
                k <= 5,
                "{expected:?} in\n{message}"
            );
        }
    }
    assert_eq!(rows.len(), 9);
    assert_contains(&message, "ccd: standard input: 7 bad rows in all");
    assert_eq!(message.matches("ccd: ").count(), 6, "{message}");
    assert_contains(&message, "9 rows: 2 contact, 7 error; median");
}

#[test]
fn an_unknown_column_is_reported_with_the_most_similar_one() {
    let output = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .stdin("id,a_pw\n1,2\n")
        .run_expecting_code(2);
    assert_eq!(output.stdout, b"");
    let message = stderr(&output);
    assert_contains(&message, "standard input: header: unknown column `a_pw`");
    assert_contains(&message, "did you mean `a_p");
}

#[test]
fn messages_name_the_bad_body_or_file() {
    let scene = Scene::new("bad");
    let broken = scene.file("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    let broken = broken.to_str().unwrap();
    for (bodies, expected) in [
        (
            ["--a", "missing.obj", "--b", "sphere:1"],
            "--a: missing.obj",
        ),
        (
            ["--a", "sphere:1", "--b", broken],
            "broken.obj: line 4: face 0 names vertex 9",
        ),
        (["--a", "ball:1", "--b", "sphere:1"], "sphere:0.5"),
        (["--a", "sphere:-1", "--b", "sphere:1"], "\"-1\""),
        (
            ["--a", "sphere:1e13", "--b", "sphere:1"],
            "too large a length of \"sphere\": lengths are from 0 to 1e12",
        ),
        (
            ["--a", "box:1,1,1e308", "--b", "sphere:1"],
            "\"1e308\" is too large a length of \"box\"",
        ),
    ] {
        let message = CommandCall::query(&bodies)
            .stdin(FALLING_CUBE_MOTION)
            .run_for_messages(2);
        assert_contains(&message, expected);
    }
    let message = CommandCall::with_args(&["query", "--a", "sphere:1", "--b", "sphere:1"])
        .args(&["--motions", "nowhere.csv"])
        .stdin("")
        .run_for_messages(2);
    assert_contains(&message, "nowhere.csv");
}

#[test]
fn bad_options_are_refused() {
    for options in [
        ["--tolerance", "0"],
        ["--tolerance", "-1e-3"],
        ["--tolerance", "NaN"],
        ["--margin", "-1"],
        ["--margin", "1e13"],
        ["--tolerance", "1e13"],
        ["--threads", "0"],
        ["--repeat", "0"],
        ["--budget", "0"],
        ["--deadline", "-1"],
        ["--deadline", "1e30"],
        ["--oracle", "lin-canny"],
        ["--schedule", "fastest"],
        ["--bound", "published"],
        ["--pieces", "hulls"],
    ] {
        let message = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
            .args(&options)
            .stdin(FALLING_CUBE_MOTION)
            .run_for_messages(2);
        assert_contains(&message, options[1]);
    }
}

#[test]
fn unwritable_results_have_exit_code_1() {
    let options = ["--out", "/no/such/directory/results.csv"];
    let message = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .args(&options)
        .stdin(FALLING_CUBE_MOTION)
        .run_for_messages(1);
    let folder = "/no/such/directory";
    assert_eq!(
        message.matches("is a folder that does not exist").count(),
        1,
        "{message}"
    );
    assert_contains(
        &message,
        &format!("cannot write {folder}/results.csv: {folder} is"),
    );
}

/// Tests that an unclosed quote is an error with its line, and that the rows before it are answered.
#[test]
fn an_unclosed_quote_is_an_error() {
    for (motions, rows, expected) in [
        ("a_pz,id\n4,x\n5,\"y\n6,z\n", 1, "row 1 (line 3): a quote"),
        ("id,a_pz\n\"a\nb\",4\n\"c,5\n", 1, "row 1 (line 4): a quote"),
        ("a_pz,\"id\n4,x\n", 0, "header (line 1): a quote"),
    ] {
        let output = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
            .stdin(motions)
            .run_expecting_code(2);
        let message = stderr(&output);
        let expected = format!("standard input: {expected} opens a cell here");
        assert_contains(&message, &expected);
        if rows > 0 {
            assert_eq!(parse(&output.stdout).len(), rows, "{motions}");
        }
    }
    let closed = CommandCall::query(&CUBE_AND_SLAB_OPTIONS).stdin("id,a_pz\n\"a\nb\",4\n");
    assert_eq!(closed.run_for_rows()[0].text("id"), "a\nb");
}

/// Tests that a Git LFS pointer in place of a file is reported, with the advice to fetch the file.
#[test]
fn git_lfs_pointers_are_recognised() {
    let scene = Scene::new("lfs");
    let pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n";
    let advice = "is a Git LFS pointer";
    for name in ["p.obj", "p.stl", "p.ply", "p.off", "p.ccd"] {
        let mesh = scene.file(name, pointer);
        let message = CommandCall::query(&["--a", mesh.to_str().unwrap(), "--b", "sphere:1"])
            .stdin(FALLING_CUBE_MOTION)
            .run_for_messages(2);
        assert!(
            message.contains(advice) && message.contains("git lfs pull"),
            "{message}"
        );
    }
    let message = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .stdin(pointer)
        .run_for_messages(2);
    assert_contains(&message, advice);
}

/// Tests that a long cell is refused at once, and not repeated in the message.
#[test]
fn long_cells_are_refused_and_not_repeated() {
    let digits = "7".repeat(8 << 20);
    let long = format!("a_pz\n{digits}\n");
    let table = CommandCall::query(&CUBE_AND_SLAB_OPTIONS).stdin(&long);
    let output = table.run_expecting_code(2);
    assert_contains(
        &stderr(&output),
        "column a_pz: a cell of 8388608 bytes; 65536 are the most",
    );
    assert!(output.stdout.len() + output.stderr.len() < 2000);
    // Shorter ones are quoted up to 60 characters.
    let digits = "7".repeat(1000) + "x";
    let names = format!("{digits},{digits}\n1\n");
    for (table, words) in [
        (
            format!("a_pz\n{digits}\n"),
            "… (1001 bytes)` is not a finite number",
        ),
        (names, "… (1001 bytes)"),
    ] {
        let output = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
            .stdin(&table)
            .run_expecting_code(2);
        let message = stderr(&output);
        assert_contains(&message, words);
        assert!(message.len() < 1000, "{message}");
    }
}

/// Tests that a table that never ends is refused before it fills the memory.
#[cfg(target_os = "linux")]
#[test]
fn a_device_is_no_table() {
    for args in [
        &[
            "query",
            "--motions",
            "/dev/zero",
            "--a",
            "box:1,1,1",
            "--b",
            "box:1,1,1",
        ][..],
        &["view", "--scene", "/dev/zero"],
        &["scene", "/dev/zero"],
    ] {
        let message = CommandCall::with_args(args).run_for_messages(2);
        assert_contains(&message, "does not end within 16 MB");
    }
}
