//! Tests messages about input, and about bodies of different size.

use crate::command::{CommandCall, Scene, assert_contains, parse, stderr};
use crate::{CUBE_AND_SLAB_OPTIONS, FALLING_CUBE_MOTION};

const SPHERES_OPTIONS: [&str; 4] = ["--a", "sphere:1", "--b", "sphere:1"];

/// Runs a query of two spheres on a table, asserts that the exit code is 2, and returns the messages.
fn query_messages(table: &str) -> String {
    let output = CommandCall::query(&SPHERES_OPTIONS)
        .args(&["--quiet"])
        .stdin(table)
        .run_expecting_code(2);
    stderr(&output)
}

#[test]
fn lines_are_counted_whatever_ends_them() {
    for end in ["\n", "\r\n", "\r"] {
        let table = "\u{feff}a_px\n1\n2\n\n3\nx\n".replace('\n', end);
        let message = query_messages(&table);
        assert_contains(&message, "row 3 (line 6): column a_px: `x`");
    }
}

#[test]
fn every_cause_is_reported_once() {
    let scene = Scene::new("said-once");
    let table = scene.directory.join("motions.csv");
    std::fs::write(&table, b"PAR1\x15\x04\xff\xfe\n").unwrap();
    let folder = scene.directory.to_str().unwrap();
    let damaged = if cfg!(feature = "parquet") {
        "cannot be read as Parquet"
    } else {
        "is Parquet, not CSV"
    };
    for (motions, a, expected) in [
        (table.to_str().unwrap(), "sphere:1", damaged),
        (folder, "sphere:1", "is a folder"),
        ("-", folder, "is a folder; name a mesh in it"),
    ] {
        let run =
            CommandCall::with_args(&["query", "--motions", motions, "--a", a, "--b", "sphere:1"]);
        let message = run.stdin("id\n1\n").run_for_messages(2);
        let lines: Vec<&str> = message
            .lines()
            .filter(|line| line.starts_with("ccd: "))
            .collect();
        assert_eq!(lines.len(), 1, "{message}");
        assert_eq!(lines[0].matches(expected).count(), 1, "{message}");
        assert!(
            !message.contains("os error") && !message.contains("utf-8"),
            "{message}"
        );
    }
}

/// Tests that missing files are reported by name, and without error numbers of the operating system.
#[test]
fn missing_files_are_reported_once() {
    let scene = Scene::new("not-there");
    let there = scene.file("there.csv", "id\n1\n");
    let there = there.to_str().unwrap();
    for (motions, a, out) in [
        ("gone.csv", "sphere:1", "-"),
        (there, "gone.obj", "-"),
        (there, "gone.ccd", "-"),
        (there, "sphere:1", "gone/out.csv"),
        (there, "sphere:1", "/dev/null/gone.csv"),
    ] {
        let run = CommandCall::with_args(&["query", "--quiet", "--motions", motions, "--out", out]);
        let output = run.args(&["--a", a, "--b", "sphere:1"]).stdin("").output();
        assert!(!output.status.success());
        let message = stderr(&output);
        assert!(
            message.contains("gone") && !message.contains("os error"),
            "{message}"
        );
        let mut parts: Vec<&str> = message.trim().split(": ").collect();
        let all = parts.len();
        parts.sort_unstable();
        parts.dedup();
        assert_eq!(parts.len(), all, "{message}");
    }
}

#[test]
fn help_explains_row_numbers_and_half_turns() {
    let output = CommandCall::with_args(&["query", "--help"])
        .stdin("")
        .output();
    let text = String::from_utf8(output.stdout).unwrap();
    for words in [
        "Rows count from 0",
        "An empty cell is an error",
        "Two rotations by half a turn",
    ] {
        assert!(text.contains(words), "{words}");
    }
}

#[test]
fn sizes_are_reported_and_compared() {
    let motions = "a_px\n3\n";
    let output = CommandCall::query(&["--a", "box:.5,1,2", "--b", "sphere:1"])
        .stdin(motions)
        .output();
    let message = stderr(&output);
    assert_contains(
        &message,
        "--a box:.5,1,2: 1 primitive, solid, size 1 × 2 × 4\n",
    );
    assert!(!message.contains("times as large"), "{message}");
    let message = CommandCall::query(&["--a", "box:150,50,50", "--b", "sphere:1"])
        .stdin(motions)
        .run_for_messages(0);
    assert_contains(&message, "--a is 150 times as large as --b");
}

#[test]
fn selected_rows_have_the_same_answers() {
    let motions = "a_px\n5\n6\nbad\n8\n9\n";
    let answers = |rows: &str| {
        let run = CommandCall::query(&SPHERES_OPTIONS).args(&["--no-micros", "--rows", rows]);
        let output = run.stdin(motions).output();
        let text = String::from_utf8(output.stdout).unwrap();
        let lines: Vec<String> = text.lines().skip(1).map(str::to_owned).collect();
        (output.status.code(), lines)
    };
    let (_, all) = answers("..");
    assert_eq!(answers("0..2"), (Some(0), all[..2].to_vec()));
    assert_eq!(answers("2..4"), (Some(2), all[2..4].to_vec()));
    assert_eq!(answers("3.."), (Some(0), all[3..].to_vec()));
    assert_eq!(answers("7.."), (Some(0), Vec::new()));
    let none = CommandCall::query(&SPHERES_OPTIONS)
        .args(&["--rows", "7.."])
        .stdin(motions)
        .output();
    assert_contains(
        &stderr(&none),
        "has 5 rows, and --rows 7.. selects none of them",
    );
    for bad in ["3", "4..4", "a..b", "-1..2"] {
        CommandCall::query(&SPHERES_OPTIONS)
            .args(&["--rows", bad])
            .run_expecting_code(2);
    }
    assert_eq!(parse(all.join("\n").as_bytes()).len(), 4);
}

/// Tests that control characters in cells and file names do not reach the terminal.
#[test]
fn nothing_in_a_file_controls_the_terminal() {
    let scene = Scene::new("escapes");
    let table = "id,a_px\n\"\u{1b}]0;owned\u{7}\",\u{1b}[2Jx\nb,\"1\n\rccd: all rows are free\"\n";
    let motions = scene.file("\u{1b}[31mred.csv", table);
    let mesh = [crate::TETRAHEDRON_OBJ, "\u{1b}[5m 1\n"].concat();
    let mesh = scene.file("part.obj", &mesh);
    let message = CommandCall::with_args(&["query", "--b", "box:1,1,1"])
        .args(&[
            "--a",
            mesh.to_str().unwrap(),
            "--motions",
            motions.to_str().unwrap(),
        ])
        .run_for_messages(2);
    for escaped in ["\\u{1b}[31mred.csv", "\\u{1b}[2Jx", "\\u{1b}[5m"] {
        assert_contains(&message, escaped);
    }
    assert!(!message.contains("\nccd: all rows"), "{message}");
    assert!(
        message.chars().all(|c| c == '\n' || !c.is_control()),
        "{message:?}"
    );
}

#[test]
fn ignored_input_is_reported_with_quiet_too() {
    let scene = Scene::new("unread");
    let mesh = [crate::TETRAHEDRON_OBJ, "l 1 2\n"].concat();
    let mesh = scene.file("part.obj", &mesh);
    let output =
        CommandCall::query(&["--a", mesh.to_str().unwrap(), "--b", "box:1,1,1", "--quiet"])
            .stdin("a_px\n9\n")
            .output();
    let message = stderr(&output);
    assert!(
        message.ends_with("part.obj: lines passed over: 1 (line 9)\n"),
        "{message}"
    );
    assert_eq!(message.lines().count(), 1, "{message}");
}

/// Tests that each probable mistake in the input gives one remark, none with `--quiet`, and does not change the exit
/// code.
#[test]
fn traps_are_remarked_upon_once() {
    let spins = |rates: &str| {
        let rows = rates.split(' ').map(|rate| format!("1,{rate}\n"));
        format!("a_px,a_wz\n{}", rows.collect::<String>())
    };
    let quaternions = "a_px,a_qw,a_qx,a_qy,a_qz\n1,1,1,0,0\n1,1,1,0,0\n".to_owned();
    let coarse = ["--a", "sphere:.0005", "--b", "box:9,9,1"];
    for (bodies, motions, words) in [
        (
            CUBE_AND_SLAB_OPTIONS,
            spins("90 180 -45"),
            "makes 14.3 turns",
        ),
        (CUBE_AND_SLAB_OPTIONS, quaternions, "has the length 1.414"),
        (
            coarse,
            FALLING_CUBE_MOTION.to_owned(),
            "the tolerance is large against",
        ),
    ] {
        let tolerance = ["--tolerance", "0.001"];
        let run = || {
            CommandCall::with_args(&["query", "--motions", "-"])
                .args(&bodies)
                .args(&tolerance)
                .stdin(&motions)
        };
        let (loud, quiet) = (run().output(), run().args(&["--quiet"]).output());
        let message = stderr(&loud);
        let remarks = message
            .lines()
            .filter(|line| line.starts_with("ccd: ") && line.contains(words));
        assert_eq!(remarks.count(), 1, "{message}");
        assert_eq!(stderr(&quiet), "");
        assert_eq!(loud.status.code(), quiet.status.code());
    }
    // A shaft at round numbers of radians, among them some that would be round in degrees.
    for rates in ["100", "6.283185307179586", "45 46", "0", "3.14 1.57"] {
        let output = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
            .stdin(&spins(rates))
            .output();
        assert!(!stderr(&output).contains("turns"), "{}", stderr(&output));
    }
}

/// Tests that one message reports two mesh files of which only one states its unit. Spheres and other simple shapes fit
/// any unit.
#[test]
fn a_single_known_unit_is_reported_once() {
    let scene = Scene::new("mixed-units");
    let mesh = scene.file("part.obj", crate::TETRAHEDRON_OBJ);
    let plain = mesh.to_str().unwrap();
    let in_mm = format!("{plain}@mm");
    let large = format!("{plain}@scale=1000");
    let told = |options: &[&str]| {
        let message = CommandCall::query(options)
            .stdin(FALLING_CUBE_MOTION)
            .run_for_messages(0);
        let lines = message.lines().filter(|line| line.starts_with("ccd: "));
        lines.map(str::to_owned).collect::<Vec<_>>()
    };
    for (a, b, start) in [
        (
            &*in_mm,
            plain,
            "ccd: --a is in mm, --b does not say its unit",
        ),
        (
            plain,
            &in_mm,
            "ccd: --b is in mm, --a does not say its unit",
        ),
        (
            &in_mm,
            &large,
            "ccd: --a is in mm, --b does not say its unit",
        ),
        (plain, &large, "ccd: --b is 1000 times as large as --a"),
    ] {
        let lines = told(&["--a", a, "--b", b]);
        assert_eq!(lines.len(), 1, "{lines:?}");
        assert!(lines[0].starts_with(start), "{lines:?}");
    }
    assert_eq!(told(&["--a", &in_mm, "--b", "sphere:1"]), [""; 0]);
    assert_eq!(
        told(&["--a", &in_mm, "--b", plain, "--unit", "mm"]),
        [""; 0]
    );
}

/// Tests that angular velocities of a path are refused without orientations.
#[test]
fn angular_velocities_of_a_path_need_orientations() {
    let message = query_messages("t,a_px,a_wz\n0,9,1\n1,9,1\n");
    assert_contains(&message, "no column `a_qw`, but column `a_wz` needs it");
    for column in ["a_vx", "b_end_px", "duration"] {
        let message = query_messages(&format!("t,a_px,{column}\n0,9,1\n1,9,1\n"));
        let expected =
            format!("unknown column `{column}`; a table with a column t holds the poses");
        assert_contains(&message, &expected);
    }
    let message = query_messages("id,time,a_px\nx,0,9\n");
    assert_contains(&message, "unknown column `time`; did you mean `t`?");
}

#[test]
fn a_page_of_rows_is_remarked_upon() {
    let scene = Scene::new("page-remarks");
    let motions = scene.file("motions.csv", "a_px,a_wz\n9,90\n");
    let run = CommandCall::with_args(&[
        "view",
        "--motions",
        motions.to_str().unwrap(),
        "--out",
        "page.html",
    ]);
    let run = run.folder(&scene.directory).args(&SPHERES_OPTIONS);
    let message = stderr(&run.output());
    assert_eq!(
        message.matches("a round number of degrees").count(),
        1,
        "{message}"
    );
    assert_eq!(stderr(&run.args(&["-q"]).output()), "");
}
