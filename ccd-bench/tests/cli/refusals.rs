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
            let (row, line) = (k + 1, k + 2);
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
    assert!(stderr(&output).contains("results.csv"));
}
