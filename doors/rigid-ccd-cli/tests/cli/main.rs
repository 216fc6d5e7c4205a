//! Tests the command `ccd` as a process.

mod certificates;
mod command;
mod contacts;
mod decompose;
mod formats;
mod manual;
mod messages;
mod outputs;
#[cfg(feature = "parquet")]
#[cfg(feature = "zstd")]
mod parquet_tables;
mod questions;
mod readers;
mod refusals;
mod replay;
mod resume;
mod robot_use;
mod robots;
mod scene;
mod view;

use command::{CommandCall, Row, Scene, assert_contains, parse, stderr};

/// The path of the command under test.
const PROGRAM_PATH: &str = env!("CARGO_BIN_EXE_ccd");

/// The options for a cube that falls at speed 4 onto a slab whose top is 2.5 below the cube.
const CUBE_AND_SLAB_OPTIONS: [&str; 4] = ["--a", "box:.5,.5,.5", "--b", "box:9,9,1"];
const FALLING_CUBE_MOTION: &str = "id,a_pz,a_vz\ndrop,4,-4\n";
const DROP_CONTACT_TIME: f64 = 2.5 / 4.0;

const TETRAHEDRON_OBJ: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

impl CommandCall {
    /// Returns a call of `ccd query` whose motions come from standard input.
    pub(crate) fn query(bodies: &[&str]) -> Self {
        CommandCall::with_args(&["query", "--motions", "-"]).args(bodies)
    }
}

impl Row {
    /// Checks that the time of contact is not late, and early by at most the time to cross the tolerance.
    pub(crate) fn assert_time_within_tolerance(&self, exact: f64, closing_speed: f64) {
        let early = exact - self.number("time");
        assert!(
            (-1e-12..=1e-3 / closing_speed).contains(&early),
            "{early} early"
        );
    }

    pub(crate) fn cells_without_micros(self) -> Vec<String> {
        let cells = self.0.into_iter().filter(|(name, _)| name != "micros");
        cells.map(|(_, value)| value).collect()
    }
}

#[test]
fn a_box_falls_onto_a_box() {
    let run = CommandCall::query(&CUBE_AND_SLAB_OPTIONS).stdin(FALLING_CUBE_MOTION);
    let rows = run.run_for_rows();
    assert_eq!(rows.len(), 1);
    let row = &rows[0];
    assert_eq!((row.text("id"), row.text("status")), ("drop", "contact"));
    row.assert_time_within_tolerance(DROP_CONTACT_TIME, 4.0);
    assert!(row.number("distance_upper") <= 1e-3);
    assert!(row.number("distance_lower") <= row.number("distance_upper"));
    assert!(row.number("normal_z") < -0.999);
    assert!(
        (row.number("witness_b_z") - 1.0).abs() < 1e-12,
        "the slab's top"
    );
    assert!(row.number("iterations") >= 1.0 && row.number("micros") > 0.0);
}

#[test]
fn every_schedule_and_oracle_gives_the_answer() {
    for schedule in ["best-first", "fast", "naive"] {
        for oracle in ["direct", "gjk", "vmarch"] {
            let options = [
                "--schedule",
                schedule,
                "--oracle",
                oracle,
                "--tolerance",
                "1e-6",
            ];
            let rows = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
                .args(&options)
                .stdin(FALLING_CUBE_MOTION)
                .run_for_rows();
            assert_eq!(rows[0].text("status"), "contact", "{schedule} {oracle}");
            let late = rows[0].number("time") - DROP_CONTACT_TIME;
            assert!(
                (-1e-6..=1e-12).contains(&late),
                "{schedule} {oracle}: {late}"
            );
        }
    }
}

#[test]
fn every_status_occurs() {
    let motions = "id,a_pz,a_vz,duration\n\
                   free,4,-4,0.25\ncontact,4,-4,1\ntouching,1.5005,-4,1\noverlapping,1,0,1\n";
    let rows = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .stdin(motions)
        .run_for_rows();
    for row in &rows {
        assert_eq!(row.text("id"), row.text("status"));
    }
    assert_eq!(rows.len(), 4);
    assert_eq!(rows[0].number("time"), 0.25);
    assert_eq!(rows[0].text("distance_lower"), "");
    assert_eq!(rows[0].text("normal_x"), "");
    assert_eq!(rows[2].number("time"), 0.0);
}

#[test]
fn an_unresolved_row_is_a_result() {
    let scene = Scene::new("unresolved");
    let mesh = scene.file("tetrahedron.obj", TETRAHEDRON_OBJ);
    let mesh = mesh.to_str().unwrap();
    let motions = "a_px,a_vx,a_wz\n5,-5,9\n";
    let rows = CommandCall::query(&["--a", mesh, "--b", mesh, "--budget", "1"])
        .stdin(motions)
        .run_for_rows();
    assert_eq!(rows[0].text("status"), "unresolved");
    assert_eq!(rows[0].text("reason"), "budget");
    assert!((0.0..0.9).contains(&rows[0].number("time")));
}

#[test]
fn a_deadline_leaves_a_row_unresolved() {
    let message = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .args(&["--deadline", "0"])
        .stdin(FALLING_CUBE_MOTION)
        .run_for_messages(0);
    assert!(
        message.contains("1 unresolved") && message.contains("--deadline"),
        "{message}"
    );
    // A long deadline has no effect.
    let rows = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .args(&["--deadline", "3600"])
        .stdin(FALLING_CUBE_MOTION)
        .run_for_rows();
    assert_eq!(rows[0].text("status"), "contact");
}

#[test]
fn margins_are_kept_and_leave_ignores_contacts_at_the_start() {
    let with_margin = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .args(&["--margin", "0.5"])
        .stdin(FALLING_CUBE_MOTION)
        .run_for_rows();
    with_margin[0].assert_time_within_tolerance(2.0 / 4.0, 4.0);
    let parting = "a_pz,a_vz\n1.5,1\n";
    let reported = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .stdin(parting)
        .run_for_rows();
    assert_eq!(reported[0].text("status"), "touching");
    let left = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .args(&["--start", "leave"])
        .stdin(parting)
        .run_for_rows();
    assert_eq!(left[0].text("status"), "free");
}

#[test]
fn files_are_read_and_written() {
    let scene = Scene::new("files");
    let motions = scene.file("motions.csv", FALLING_CUBE_MOTION);
    let results = scene.directory.join("results.csv");
    let mesh = scene.file("tetrahedron.obj", TETRAHEDRON_OBJ);
    let run =
        CommandCall::with_args(&["query", "--a", mesh.to_str().unwrap(), "--b", "sphere:0.5"])
            .args(&[
                "--motions",
                motions.to_str().unwrap(),
                "--out",
                results.to_str().unwrap(),
            ])
            .stdin("");
    let output = run.run_expecting_code(0);
    assert_eq!(output.stdout, b"");
    let rows = parse(&std::fs::read(&results).unwrap());
    assert_eq!(rows[0].text("status"), "contact");
    // From z = 4 its base comes down to the ball's top at 0.5.
    rows[0].assert_time_within_tolerance(3.5 / 4.0, 4.0);
    assert_eq!(rows[0].text("feature_b"), "v0");
}

#[test]
fn the_same_file_twice_is_loaded_once() {
    let scene = Scene::new("once");
    let mesh = scene.file("tetrahedron.obj", TETRAHEDRON_OBJ);
    let other_name = scene.directory.join(".").join("tetrahedron.obj");
    let bodies = [
        "--a",
        mesh.to_str().unwrap(),
        "--b",
        other_name.to_str().unwrap(),
    ];
    let output = CommandCall::query(&bodies)
        .stdin("a_px,a_vx\n3,-3\n")
        .run_expecting_code(0);
    assert_eq!(stderr(&output).matches(", solid").count(), 1);
}

#[test]
fn threads_and_repetitions_change_no_bit() {
    let scene = Scene::new("threads");
    let mesh = scene.file("tetrahedron.obj", TETRAHEDRON_OBJ);
    let bodies = ["--a", mesh.to_str().unwrap(), "--b", "capsule:0.2,0.7"];
    let mut motions = "a_px,a_py,a_vx,a_wx,a_wy,b_wz\n".to_owned();
    for k in 0..64 {
        let k = f64::from(k);
        motions += &format!("3,{},-6,{k},2,{}\n", 0.06 * k - 1.9, 0.1 * k);
    }
    let answers = |options: &[&str]| -> Vec<Vec<String>> {
        let rows = CommandCall::query(&bodies)
            .args(options)
            .stdin(&motions)
            .run_for_rows();
        rows.into_iter().map(Row::cells_without_micros).collect()
    };
    let one = answers(&[]);
    assert_eq!(one.len(), 64);
    assert_eq!(one, answers(&["--threads", "1"]));
    let contacts = one.iter().filter(|row| row[1] == "contact").count();
    assert!((10..60).contains(&contacts), "{contacts} of 64 hit");
    assert_eq!(one, answers(&["--threads", "2"]));
    assert_eq!(one, answers(&["--repeat", "3"]));
}

#[test]
fn raised_tolerances_are_reported() {
    let far = "a_px,b_px,a_pz,a_vz\n1e9,1e9,4,-4\n";
    let output = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .args(&["--tolerance", "1e-12"])
        .stdin(far)
        .run_expecting_code(0);
    assert_contains(&stderr(&output), "--tolerance 1e-12 cannot be certified");
}

#[test]
fn results_never_overwrite_their_motions() {
    let folder = std::env::temp_dir().join(format!("ccd-out-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let named = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    // The results, their temporary file and their journal.
    for [motions, option, target] in [
        ["m.csv", "--out", "m.csv"],
        ["m.csv.partial", "--out", "m.csv"],
        ["m.csv.resume", "--out", "m.csv"],
        ["m.csv.partial", "--contacts", "m.csv"],
    ] {
        let (motions, target) = (named(motions), named(target));
        std::fs::write(&motions, FALLING_CUBE_MOTION).unwrap();
        for more in [&[][..], &["--resume"]] {
            let output = std::process::Command::new(PROGRAM_PATH)
                .args(["query", "--a", "box:1,1,1", "--b", "box:1,1,1"])
                .args(["--motions", &motions, option, &target])
                .args(more)
                .output()
                .unwrap();
            assert_eq!(output.status.code(), Some(2), "{motions} {target}");
            let message = stderr(&output);
            assert_contains(&message, "another file");
            assert_eq!(
                std::fs::read_to_string(&motions).unwrap(),
                FALLING_CUBE_MOTION
            );
        }
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn tables_do_not_overwrite_each_other_by_any_spelling() {
    let scene = Scene::new("spellings");
    for [results, contacts] in [
        ["new.csv", "./new.csv"],
        ["./new.csv", "new.csv"],
        ["new.csv", "../{}/new.csv"],
        ["new.csv", "./new.csv.partial"],
    ] {
        let folder = scene.directory.file_name().unwrap().to_str().unwrap();
        let contacts = contacts.replace("{}", folder);
        let output = std::process::Command::new(PROGRAM_PATH)
            .current_dir(&scene.directory)
            .args([
                "query",
                "--a",
                "box:1,1,1",
                "--b",
                "box:1,1,1",
                "--motions",
                "-",
            ])
            .args(["--out", results, "--contacts", &contacts])
            .stdin(std::process::Stdio::null())
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2), "{results} {contacts}");
        let message = stderr(&output);
        assert_contains(&message, "another file");
    }
}

#[test]
fn tolerances_that_no_row_accepts_are_refused_at_once() {
    for tolerance in ["1e-300", "0", "-1", "1e13", "nan"] {
        let output = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
            .args(&["--tolerance", tolerance])
            .stdin(FALLING_CUBE_MOTION)
            .output();
        let message = stderr(&output);
        assert_contains(&message, "give a number from 1e-100 to 1e12");
    }
}

#[test]
fn the_summary_counts_rows_and_quiet_omits_it() {
    let loud = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .stdin(FALLING_CUBE_MOTION)
        .output();
    assert_contains(&stderr(&loud), "1 row: 1 contact; median");
    let quiet = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .args(&["--quiet"])
        .stdin(FALLING_CUBE_MOTION)
        .output();
    assert_eq!(stderr(&quiet), "");
    assert!(quiet.status.success());
}

#[test]
fn a_table_without_rows_gives_a_header() {
    let output = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
        .stdin("id\n")
        .run_expecting_code(0);
    let header = String::from_utf8(output.stdout.clone()).unwrap();
    assert!(
        header.starts_with("id,status,time,distance_lower,"),
        "{header}"
    );
    assert_contains(
        &stderr(&output),
        "standard input: has a header, but no rows",
    );
}

#[test]
fn help_shows_examples() {
    for args in [&["--help"][..], &["query", "--help"], &["query", "-h"]] {
        let output = CommandCall::with_args(args).stdin("").run_expecting_code(0);
        assert!(
            String::from_utf8(output.stdout)
                .unwrap()
                .contains("ccd query --a"),
            "{args:?}"
        );
    }
}
