//! Tests `--contacts`, `--counters`, and messages about times that are not certified.

use crate::command::{CommandCall, Row, Scene, assert_contains, parse, stderr};
use std::path::Path;

/// The options for a cube and a slab as bodies A and B.
const CUBE_AND_SLAB_OPTIONS: [&str; 4] = ["--a", "box:.5,.5,.5", "--b", "box:9,9,1"];
/// A table of motions of a cube onto the face of a slab, past its side, and away from it.
const CUBE_MOTIONS: &str = "id,a_px,a_pz,a_vz\nface,0,4,-4\nside,9,4,-4\nfree,0,4,4\n";

fn rows_and_contacts(run: CommandCall, table: &Path) -> (Vec<Row>, Vec<Row>) {
    let output = run
        .args(&["--contacts", table.to_str().unwrap()])
        .run_expecting_code(0);
    (parse(&output.stdout), parse(&std::fs::read(table).unwrap()))
}

#[test]
fn every_contact_of_every_row_is_listed() {
    let scene = Scene::new("contacts");
    let table = scene.directory.join("contacts.csv");
    let (results, contacts) = rows_and_contacts(
        CommandCall::query(&CUBE_AND_SLAB_OPTIONS).stdin(CUBE_MOTIONS),
        &table,
    );
    let ids: Vec<&str> = contacts.iter().map(|row| row.text("id")).collect();
    assert_eq!(ids, [["face"; 4], ["side"; 4]].concat());
    for row in &contacts {
        let result = results
            .iter()
            .find(|it| it.text("id") == row.text("id"))
            .unwrap();
        assert_eq!(row.text("time"), result.text("time"));
        let (lower, upper) = (row.number("distance_lower"), row.number("distance_upper"));
        assert!(lower <= upper && upper <= 1e-3, "{lower} {upper}");
        assert!(row.number("normal_z") < -0.999);
        assert!((row.number("witness_b_z") - 1.0).abs() < 1e-12);
        let gap = row.number("witness_a_z") - row.number("witness_b_z");
        assert!((lower..=upper).contains(&gap), "{gap}");
    }
    let names = |id: &str| -> Vec<String> {
        let of_row = contacts.iter().filter(|row| row.text("id") == id);
        let name = |row: &Row| format!("{} {}", row.text("feature_a"), row.text("feature_b"));
        let mut names: Vec<String> = of_row.map(name).collect();
        names.sort();
        names
    };
    assert_eq!(names("face"), ["v0 f5", "v1 f5", "v2 f5", "v3 f5"]);
    assert_eq!(names("side"), ["e0-1 e5-7", "e2-3 e5-7", "v0 f5", "v2 f5"]);
}

#[test]
fn contacts_at_the_start_and_on_standard_output() {
    let scene = Scene::new("contacts_at_the_start");
    let results = scene.directory.join("results.csv");
    let output = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .args(&["--out", results.to_str().unwrap(), "--contacts", "-"])
        .stdin("id,a_pz,a_vz\ntouching,1.5005,-4\noverlapping,1,0\n")
        .run_expecting_code(0);
    let contacts = parse(&output.stdout);
    assert_eq!(contacts.len(), 4);
    for row in &contacts {
        assert_eq!((row.text("id"), row.number("time")), ("touching", 0.0));
    }
    let statuses = parse(&std::fs::read(&results).unwrap());
    assert_eq!(statuses[0].text("status"), "touching");
}

#[test]
fn a_table_without_contacts_has_its_header() {
    let scene = Scene::new("no_contacts");
    let table = scene.directory.join("contacts.csv");
    let (_, contacts) = rows_and_contacts(
        CommandCall::query(&CUBE_AND_SLAB_OPTIONS).stdin("a_pz\n4\n"),
        &table,
    );
    assert!(contacts.is_empty());
    let text = std::fs::read_to_string(&table).unwrap();
    assert!(
        text.starts_with("id,time,feature_a,feature_b,distance_lower,"),
        "{text}"
    );
}

#[test]
fn contacts_overwrite_nothing() {
    let scene = Scene::new("contacts_overwrite_nothing");
    let motions = scene.file("motions.csv", CUBE_MOTIONS);
    let (motions, dot) = (motions.to_str().unwrap(), scene.directory.join("."));
    let out = scene.directory.join("out.csv");
    let same = dot.join("out.csv");
    for (options, code, expected) in [
        (vec!["--contacts", motions], 2, "--motions"),
        (vec!["--contacts", "-"], 2, "--out -"),
        (
            vec![
                "--out",
                out.to_str().unwrap(),
                "--contacts",
                same.to_str().unwrap(),
            ],
            2,
            "--out",
        ),
        (vec!["--contacts", "/no/such/directory/c.csv"], 1, "c.csv"),
    ] {
        let output = CommandCall::with_args(&["query", "--motions", motions])
            .args(&CUBE_AND_SLAB_OPTIONS)
            .args(&options)
            .output();
        assert_eq!(output.status.code(), Some(code), "{options:?}");
        let message = stderr(&output);
        assert!(
            message.contains(expected) && message.contains(options[0]) || code == 1,
            "{message}"
        );
        assert_contains(&message, expected);
    }
    assert_eq!(std::fs::read_to_string(motions).unwrap(), CUBE_MOTIONS);
}

#[test]
fn a_row_with_too_many_contacts_is_reported() {
    let scene = Scene::new("too_many_contacts");
    let table = scene.directory.join("contacts.csv");
    let output = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .args(&["--budget", "3", "--contacts", table.to_str().unwrap()])
        .stdin("id,a_pz,a_vz\nfirst,1.5005,-4\n")
        .run_expecting_code(2);
    assert_eq!(parse(&output.stdout)[0].text("status"), "touching");
    let message = stderr(&output);
    assert_contains(&message, "row 0 (line 2): contacts: ");
    assert_contains(&message, "--budget");
}

#[test]
fn counters_are_more_columns_and_a_line_of_means() {
    let plain = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .stdin(CUBE_MOTIONS)
        .output();
    assert!(!stderr(&plain).contains("means"));
    let header = |output: &[u8]| {
        let text = String::from_utf8(output.to_vec()).unwrap();
        text.lines().next().unwrap().to_owned()
    };
    assert!(header(&plain.stdout).ends_with("iterations,oracle_calls,micros,reason"));
    for (schedule, steps) in [("best-first", false), ("naive", true)] {
        let run = CommandCall::query(&CUBE_AND_SLAB_OPTIONS).args(&[
            "--counters",
            "--schedule",
            schedule,
        ]);
        let output = run.stdin(CUBE_MOTIONS).run_expecting_code(0);
        assert_eq!(
            header(&output.stdout),
            header(&plain.stdout) + ",advancements,oracle_steps,cycles,fallbacks,front"
        );
        let rows = parse(&output.stdout);
        for row in &rows {
            assert_eq!(row.number("advancements") > 0.0, steps, "{schedule}");
            assert!(row.number("front") >= 1.0);
            assert!(row.number("cycles") >= 0.0 && row.number("oracle_steps") >= 0.0);
        }
        let total: f64 = rows.iter().map(|row| row.number("oracle_calls")).sum();
        let mean = format!("{:.1} oracle calls", total / 3.0);
        let message = stderr(&output);
        assert!(
            message.contains("means: ") && message.contains(&mean),
            "{message}"
        );
    }
}

#[test]
fn times_without_certificate_are_reported_once() {
    let published = ["--schedule", "naive", "--bound", "published"];
    let message = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .args(&published)
        .stdin(CUBE_MOTIONS)
        .run_for_messages(0);
    assert_eq!(
        message.matches("times are not certified").count(),
        1,
        "{message}"
    );
    assert_contains(&message, "\nnot certified: 3 rows");
    for sound in [
        &published[..2],
        &["--schedule", "naive", "--bound", "sound"],
    ] {
        let output = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
            .args(sound)
            .stdin(CUBE_MOTIONS)
            .output();
        assert!(
            !stderr(&output).contains("not certified"),
            "{}",
            stderr(&output)
        );
    }
}
