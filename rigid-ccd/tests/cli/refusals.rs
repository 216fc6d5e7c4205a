//! Rows, bodies, files and options that cannot be taken, and what is said of them.

use crate::command::{Run, Scene, parse, stderr};
use crate::{DROP, FALLING_CUBE};

#[test]
fn bad_rows_keep_their_place_and_are_told() {
    let motions = "id,a_pz,a_vz,b_qw,b_qx,b_qy,b_qz,b_end_px,b_end_py,b_end_pz,b_wx,duration\n\
                   good,4,-4,,,,,,,,,\n\
                   text,4,abc,,,,,,,,,\n\
                   partial,4,-4,1,0,0,,,,,,\n\
                   zero,4,-4,0,0,0,0,,,,,\n\
                   both,4,-4,,,,,1,1,1,0,\n\
                   infinite,inf,-4,,,,,,,,,\n\
                   backwards,4,-4,,,,,,,,,-1\n\
                   short,4\n\
                   also good,4,-4,,,,,,,,,\n";
    let output = Run::query(&FALLING_CUBE).stdin(motions).output();
    assert_eq!(output.status.code(), Some(2));
    let rows = parse(&output.stdout);
    let told = stderr(&output);
    for (k, (id, reason)) in [
        ("good", ""),
        ("text", "column a_vz: `abc`"),
        ("partial", "column b_qz: no value, but b_qw"),
        ("zero", "columns b_qw b_qx b_qy b_qz: (0 0 0 0)"),
        ("both", "columns b_end_px and b_wx"),
        ("infinite", "column a_pz: `inf`"),
        ("backwards", "column duration: -1"),
        ("short", "has 2 cells where the header names 12"),
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
            // The first few are told at once.
            let (row, line) = (k, k + 2);
            let message = format!("standard input, row {row} (line {line}): {reason}");
            assert_eq!(told.contains(&message), k <= 5, "{message:?} in\n{told}");
        }
    }
    assert_eq!(rows.len(), 9);
    assert!(
        told.contains("ccd: standard input: 7 rows in all"),
        "{told}"
    );
    assert_eq!(told.matches("ccd: ").count(), 6, "{told}");
    assert!(
        told.contains("9 rows: 2 contact, 7 error; median"),
        "{told}"
    );
}

#[test]
fn unknown_columns_are_told_with_the_one_that_is_meant() {
    let output = Run::query(&FALLING_CUBE).stdin("id,a_pw\n1,2\n").output();
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(output.stdout, b"");
    let told = stderr(&output);
    assert!(
        told.contains("standard input: header: unknown column `a_pw`"),
        "{told}"
    );
    assert!(told.contains("did you mean `a_p"), "{told}");
}

#[test]
fn bad_bodies_and_files_are_told_by_name() {
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
        let output = Run::query(&bodies).stdin(DROP).output();
        assert_eq!(output.status.code(), Some(2), "{bodies:?}");
        assert!(
            stderr(&output).contains(expected),
            "{expected:?}: {}",
            stderr(&output)
        );
    }
    let no_motions = Run::bare(&["query", "--a", "sphere:1", "--b", "sphere:1"])
        .args(&["--motions", "nowhere.csv"])
        .stdin("")
        .output();
    assert_eq!(no_motions.status.code(), Some(2));
    assert!(stderr(&no_motions).contains("nowhere.csv"));
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
        let output = Run::query(&FALLING_CUBE)
            .args(&options)
            .stdin(DROP)
            .output();
        assert_eq!(output.status.code(), Some(2), "{options:?}");
        assert!(stderr(&output).contains(options[1]), "{}", stderr(&output));
    }
}

#[test]
fn results_that_cannot_be_written_are_another_failure() {
    let options = ["--out", "/no/such/directory/results.csv"];
    let output = Run::query(&FALLING_CUBE)
        .args(&options)
        .stdin(DROP)
        .output();
    assert_eq!(output.status.code(), Some(1));
    let told = stderr(&output);
    let folder = "/no/such/directory";
    assert_eq!(
        told.matches("is a folder that is not there").count(),
        1,
        "{told}"
    );
    assert!(
        told.contains(&format!("cannot write {folder}/results.csv: {folder} is")),
        "{told}"
    );
}

/// The rows before it are answered, and those behind it are not taken for its cell.
#[test]
fn a_quote_that_nobody_closes_is_an_error() {
    for (motions, rows, expected) in [
        ("a_pz,id\n4,x\n5,\"y\n6,z\n", 1, "row 1 (line 3): a quote"),
        ("id,a_pz\n\"a\nb\",4\n\"c,5\n", 1, "row 1 (line 4): a quote"),
        ("a_pz,\"id\n4,x\n", 0, "header (line 1): a quote"),
    ] {
        let output = Run::query(&FALLING_CUBE).stdin(motions).output();
        assert_eq!(output.status.code(), Some(2), "{motions}");
        let told = stderr(&output);
        let expected = format!("standard input: {expected} opens a cell here");
        assert!(told.contains(&expected), "{expected}: {told}");
        if rows > 0 {
            assert_eq!(parse(&output.stdout).len(), rows, "{motions}");
        }
    }
    let closed = Run::query(&FALLING_CUBE).stdin("id,a_pz\n\"a\nb\",4\n");
    assert_eq!(closed.succeeds()[0].text("id"), "a\nb");
}

#[test]
fn large_numbers_are_told_in_few_digits() {
    let output = Run::query(&FALLING_CUBE)
        .stdin("a_pz,duration\n1e308,1\n4,-1e308\n")
        .output();
    assert_eq!(output.status.code(), Some(2));
    let told = stderr(&output);
    assert!(
        told.contains("row 0 (line 2): position is 1e308, but"),
        "{told}"
    );
    assert!(
        told.contains("row 1 (line 3): column duration: -1e308 is"),
        "{told}"
    );
    assert!(!told.contains("00000"), "{told}");
}

/// Git stands for large files with a few lines until they are fetched.
#[test]
fn pointers_of_git_lfs_are_told_for_what_they_are() {
    let scene = Scene::new("lfs");
    let pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n";
    let advice = "is a Git LFS pointer";
    for name in ["p.obj", "p.stl", "p.ply", "p.off", "p.ccd"] {
        let mesh = scene.file(name, pointer);
        let output = Run::query(&["--a", mesh.to_str().unwrap(), "--b", "sphere:1"])
            .stdin(DROP)
            .output();
        assert_eq!(output.status.code(), Some(2), "{name}");
        let told = stderr(&output);
        assert!(
            told.contains(advice) && told.contains("git lfs pull"),
            "{told}"
        );
    }
    let output = Run::query(&FALLING_CUBE).stdin(pointer).output();
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains(advice), "{}", stderr(&output));
}
