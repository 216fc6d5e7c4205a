//! Tests `ccd query --question` for motions and for paths.

use crate::command::{CommandCall, Row, Scene, assert_contains, parse, stderr};
use crate::{CUBE_AND_SLAB_OPTIONS, DROP_CONTACT_TIME, FALLING_CUBE_MOTION};
use ccd_tables::results::{ANSWERS, Status, names};
use std::collections::BTreeSet;
use std::f64::consts::{FRAC_PI_4, TAU};
use std::fmt::Write;
use std::fs;

/// The options for two balls of radius 0.5.
const BALLS_OPTIONS: [&str; 4] = ["--a", "sphere:.5", "--b", "sphere:.5"];
/// A table of motions in which a ball passes another one at a distance of 0.2, nearest at time 0.5.
const PASSING_MOTION: &str = "id,a_px,a_py,a_vx\npasses,-3,1.2,6\n";

/// A table of a path from time 10 on: a cube comes down onto a slab, stays for a unit of time, and leaves. It touches
/// from 12.5 to 15.
const TOUCH_AND_LEAVE_PATH: &str = "id,t,a_px,a_pz\n\
                     visit,10,0,4\n\
                     visit,13,0,1\n\
                     visit,14,5,1\n\
                     visit,18,5,3\n";
const TOUCH_START_TIME: f64 = 12.5;
const TOUCH_END_TIME: f64 = 15.0;

fn question_call(question: &str, bodies: &[&str], table: &str) -> CommandCall {
    CommandCall::query(bodies)
        .args(&["--question", question])
        .stdin(table)
}

fn only_row(run: &CommandCall) -> Row {
    let mut rows = run.run_for_rows();
    assert_eq!(rows.len(), 1);
    rows.remove(0)
}

#[test]
fn a_contact_is_found_at_any_time() {
    let row = only_row(&question_call(
        "is-free",
        &CUBE_AND_SLAB_OPTIONS,
        FALLING_CUBE_MOTION,
    ));
    assert_eq!(row.text("status"), "contact");
    let time = row.number("time");
    assert!((DROP_CONTACT_TIME - 1e-3..=1.0).contains(&time), "{time}");
    assert!(row.number("distance_upper") <= 1e-3);
    let row = only_row(&question_call("is-free", &BALLS_OPTIONS, PASSING_MOTION));
    assert_eq!((row.text("status"), row.text("time")), ("free", "1.0"));
    assert_eq!(row.text("distance_lower"), "");
}

#[test]
fn an_interval_holds_the_contact() {
    let through = "a_pz,a_vz,duration\n4,-4,3\n";
    let row = only_row(&question_call(
        "contact-interval",
        &CUBE_AND_SLAB_OPTIONS,
        through,
    ));
    assert_eq!(row.text("status"), "contact");
    row.assert_time_within_tolerance(DROP_CONTACT_TIME, 4.0);
    let late = row.number("last_time") - 5.5 / 4.0;
    assert!((0.0..=1e-3 / 4.0).contains(&late), "{late} late");
}

#[test]
fn an_interval_begins_as_the_first_contact_does() {
    let starts =
        "id,a_px,a_pz,a_vz\ninto,0,1.4,-1\ndeep,0,0,0\non,0,1.5005,1\nin,0,1.4,1\nbeside,19,0,0\n";
    let first = question_call("first-contact", &CUBE_AND_SLAB_OPTIONS, starts).run_for_rows();
    let interval = question_call("contact-interval", &CUBE_AND_SLAB_OPTIONS, starts).run_for_rows();
    for (first, interval) in first.iter().zip(&interval) {
        for column in ["id", "status", "time", "distance_lower", "witness_a_x"] {
            assert_eq!(first.text(column), interval.text(column), "{column}");
        }
    }
    let statuses: Vec<_> = first.iter().map(|row| row.text("status")).collect();
    assert_eq!(
        statuses,
        [
            "overlapping",
            "overlapping",
            "touching",
            "overlapping",
            "free"
        ]
    );
}

#[test]
fn the_least_distance_is_bracketed_and_compared() {
    let row = only_row(&question_call(
        "closest-approach",
        &BALLS_OPTIONS,
        PASSING_MOTION,
    ));
    assert_eq!(row.text("status"), "measured");
    let [lower, upper] = ["distance_lower", "distance_upper"].map(|name| row.number(name));
    assert!(lower <= 0.2 && 0.2 <= upper && upper - lower <= 1e-3);
    assert!((row.number("time") - 0.5).abs() < 0.05);
    for (clearance, status) in [("0", "kept"), ("0.19", "kept"), ("0.21", "violated")] {
        let run = question_call("closest-approach", &BALLS_OPTIONS, PASSING_MOTION)
            .args(&["--clearance", clearance]);
        assert_eq!(only_row(&run).text("status"), status, "{clearance}");
    }
    let run = question_call(
        "closest-approach",
        &CUBE_AND_SLAB_OPTIONS,
        FALLING_CUBE_MOTION,
    )
    .args(&["--clearance", "0.002"]);
    assert_eq!(only_row(&run).text("status"), "violated");
    let run = question_call("closest-approach", &BALLS_OPTIONS, PASSING_MOTION).args(&[
        "--clearance",
        "0.2",
        "--tolerance",
        "0.1",
    ]);
    let row = only_row(&run);
    assert_eq!(row.text("status"), "unverified");
    assert!(
        row.text("reason")
            .contains("a smaller --tolerance may decide"),
        "{}",
        row.text("reason")
    );
}

/// Tests that a clearance is `unverified`, not `violated`, if two cylinders keep it but the polytopes around them do
/// not.
#[test]
fn a_clearance_of_cylinders_is_violated_beyond_their_excess_only() {
    let bodies = ["--a", "cylinder:1,1,.01", "--b", "cylinder:1,1,.01"];
    // Corners towards each other.
    let beside =
        "a_px,a_qw,a_qx,a_qy,a_qz,b_qw,b_qx,b_qy,b_qz\n2.1,.99786,0,0,.0654,.99786,0,0,.0654\n";
    for (clearance, status) in [
        (".01", "kept"),
        (".095", "unverified"),
        (".0999", "unverified"),
        (".13", "violated"),
    ] {
        let run = question_call("distance", &bodies, beside).args(&["--clearance", clearance]);
        let row = only_row(&run);
        assert_eq!(row.text("status"), status, "{clearance}");
        let [lower, upper] = ["distance_lower", "distance_upper"].map(|name| row.number(name));
        assert!(lower < 0.095 && (0.1..0.13).contains(&upper), "{upper}");
        let names = row.text("reason").contains("excess of the bodies");
        assert_eq!(names, status == "unverified", "{}", row.text("reason"));
    }
}

#[test]
fn a_clearance_that_is_decided_ends_the_search() {
    let visits = |more: &[&str]| {
        let row =
            only_row(&question_call("closest-approach", &BALLS_OPTIONS, PASSING_MOTION).args(more));
        (row.number("iterations"), row)
    };
    let (kept, row) = visits(&["--clearance", "0.1"]);
    assert_eq!(row.text("distance_upper"), "");
    assert!((0.1..0.2).contains(&row.number("distance_lower")));
    let (measured, _) = visits(&[]);
    assert!(kept < measured, "{kept} {measured}");
    let (_, row) = visits(&["--clearance", "0.5"]);
    let upper = row.number("distance_upper");
    assert!((0.2..0.5).contains(&upper), "{upper}");
    assert!(row.number("time") < 0.5);
}

#[test]
fn the_distance_is_that_of_the_start() {
    let row = only_row(&question_call(
        "distance",
        &CUBE_AND_SLAB_OPTIONS,
        FALLING_CUBE_MOTION,
    ));
    assert_eq!((row.text("status"), row.text("time")), ("measured", "0.0"));
    assert!((row.number("distance_lower") - 2.5).abs() < 1e-3);
    assert!((row.number("distance_upper") - 2.5).abs() < 1e-12);
    assert!((row.number("witness_b_z") - 1.0).abs() < 1e-12);
    let inside = "a_px\n0.1\n";
    let row = only_row(&question_call("distance", &CUBE_AND_SLAB_OPTIONS, inside));
    assert_eq!(row.text("status"), "overlapping");
}

#[test]
fn paths_answer_every_question() {
    let row = only_row(&question_call(
        "first-contact",
        &CUBE_AND_SLAB_OPTIONS,
        TOUCH_AND_LEAVE_PATH,
    ));
    assert_eq!((row.text("id"), row.text("status")), ("visit", "contact"));
    row.assert_time_within_tolerance(TOUCH_START_TIME, 1.0);

    let row = only_row(&question_call(
        "is-free",
        &CUBE_AND_SLAB_OPTIONS,
        TOUCH_AND_LEAVE_PATH,
    ));
    assert_eq!(row.text("status"), "contact");
    let time = row.number("time");
    assert!(
        (TOUCH_START_TIME - 1e-3..=TOUCH_END_TIME + 2e-3).contains(&time),
        "{time}"
    );

    let row = only_row(&question_call(
        "contact-interval",
        &CUBE_AND_SLAB_OPTIONS,
        TOUCH_AND_LEAVE_PATH,
    ));
    row.assert_time_within_tolerance(TOUCH_START_TIME, 1.0);
    let late = row.number("last_time") - TOUCH_END_TIME;
    assert!((-1e-9..=2e-3).contains(&late), "{late} late");

    let over = TOUCH_AND_LEAVE_PATH.replace(",1\n", ",2\n");
    let row = only_row(&question_call(
        "closest-approach",
        &CUBE_AND_SLAB_OPTIONS,
        &over,
    ));
    let [lower, upper] = ["distance_lower", "distance_upper"].map(|name| row.number(name));
    assert!(
        lower <= 0.5 && 0.5 <= upper && upper - lower <= 1e-3,
        "{lower} {upper}"
    );
    let time = row.number("time");
    assert!((12.9..=14.1).contains(&time), "{time}");
    let row = only_row(&question_call(
        "first-contact",
        &CUBE_AND_SLAB_OPTIONS,
        &over,
    ));
    assert_eq!((row.text("status"), row.text("time")), ("free", "18.0"));
}

#[test]
fn distances_are_those_of_every_row_of_a_path() {
    let rows =
        question_call("distance", &CUBE_AND_SLAB_OPTIONS, TOUCH_AND_LEAVE_PATH).run_for_rows();
    let times: Vec<f64> = rows.iter().map(|row| row.number("time")).collect();
    assert_eq!(times, [10.0, 13.0, 14.0, 18.0]);
    let statuses: Vec<&str> = rows.iter().map(|row| row.text("status")).collect();
    assert_eq!(
        statuses,
        ["measured", "overlapping", "overlapping", "measured"]
    );
    for (row, expected) in [(&rows[0], 2.5), (&rows[3], 1.5)] {
        assert!((row.number("distance_upper") - expected).abs() < 1e-12);
    }
}

#[test]
fn contacts_of_a_path_are_listed() {
    let scene = Scene::new("contacts-of-a-path");
    let contacts = scene.directory.join("contacts.csv");
    let contacts_name = contacts.to_str().unwrap();
    let run = question_call(
        "first-contact",
        &CUBE_AND_SLAB_OPTIONS,
        TOUCH_AND_LEAVE_PATH,
    )
    .args(&["--contacts", contacts_name]);
    let found = only_row(&run);
    let rows = parse(&fs::read(&contacts).unwrap());
    assert_eq!(rows.len(), 4, "the corners of the cube");
    for row in rows {
        assert_eq!(row.text("time"), found.text("time"));
        assert!(row.number("distance_upper") <= 1e-3);
    }
}

#[test]
fn paths_are_resumed_and_cut_into_rows() {
    let scene = Scene::new("rows-of-paths");
    let out = scene.directory.join("results.csv");
    let table: String = (0..40)
        .map(|k| format!("p{k},0,0,4\np{k},1,{k},1.{k}\np{k},2,0,{k}\n"))
        .collect();
    let table = format!("id,t,a_px,a_pz\n{table}");
    let run = |more: &[&str]| {
        question_call("is-free", &CUBE_AND_SLAB_OPTIONS, &table)
            .args(&["--no-micros"])
            .args(more)
    };
    let whole = run(&[]).output().stdout;
    let rows = parse(&whole);
    let of = |status: &str| {
        rows.iter()
            .filter(|row| row.text("status") == status)
            .count()
    };
    assert_eq!(of("contact") + of("free"), 40);
    assert!(
        of("contact") > 5 && of("free") > 5,
        "{} in contact",
        of("contact")
    );
    let part = run(&["--rows", "10..30"]).output().stdout;
    let lines = |table: &[u8]| {
        String::from_utf8(table.to_vec())
            .unwrap()
            .lines()
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    assert_eq!(lines(&part)[1..], lines(&whole)[11..31]);
    let out_name = out.to_str().unwrap();
    run(&["--out", out_name]).run_for_rows();
    let again = run(&["--out", out_name, "--resume"]).output();
    assert_contains(&stderr(&again), "already has all rows");
    assert_eq!(fs::read(&out).unwrap(), whole);
}

#[test]
fn options_without_a_use_are_refused() {
    for (options, refusal) in [
        (
            &["--clearance", "1"][..],
            "--clearance needs --question closest-approach or distance",
        ),
        (
            &["--question", "distance", "--margin", "1"],
            "use --clearance instead of --margin",
        ),
        (
            &["--question", "closest-approach", "--contacts", "c.csv"],
            "--contacts needs --question first-contact or is-free",
        ),
        (
            &["--question", "is-free", "--schedule", "fast"],
            "--question is-free needs --schedule best-first",
        ),
        (
            &["--question", "distance", "--start", "leave"],
            "--start leave needs --question first-contact",
        ),
        (
            &["--schedule", "naive"],
            "--schedule naive needs a table of motions, not of paths",
        ),
        (
            &["--start", "leave"],
            "--start leave needs a table of motions, not of paths",
        ),
        (
            &["--question", "nothing"],
            "first-contact, is-free, contact-interval, closest-approach, distance",
        ),
    ] {
        let message = CommandCall::query(&CUBE_AND_SLAB_OPTIONS)
            .args(options)
            .stdin(TOUCH_AND_LEAVE_PATH)
            .run_for_messages(2);
        assert_contains(&message, refusal);
    }
}

/// Tests that bodies that overlap at the start have the status `overlapping` at time 0, although their centers are
/// nearest later.
#[test]
fn bodies_that_overlap_at_the_start_are_overlapping() {
    let deeper = "a_px,a_vx\n0.9,-1.9\n";
    let row = only_row(&question_call("closest-approach", &BALLS_OPTIONS, deeper));
    assert_eq!(
        (row.text("status"), row.text("time")),
        ("overlapping", "0.0")
    );
    let path = "t,a_px\n0,0.9\n1,-1\n2,3\n";
    let row = only_row(&question_call("closest-approach", &BALLS_OPTIONS, path));
    assert_eq!(
        (row.text("status"), row.text("time")),
        ("overlapping", "0.0")
    );
}

/// Tests that `--check` has exit code 0 only if every row is proven.
#[test]
fn a_check_fails_unless_every_row_is_proven() {
    let near = &["--clearance", "0.21"][..];
    let far = &["--clearance", "0.19"][..];
    let open = &["--clearance", "0.2", "--tolerance", "0.1"][..];
    let short = &["--margin", "0.3", "--budget", "1"][..];
    for (asked, options, status, code) in [
        ("first-contact", &[][..], "free", 0),
        ("first-contact", &["--margin", "0.3"], "contact", 3),
        ("is-free", &["--margin", "0.3"], "contact", 3),
        ("contact-interval", short, "unresolved", 3),
        ("closest-approach", far, "kept", 0),
        ("closest-approach", near, "violated", 3),
        ("closest-approach", open, "unverified", 3),
    ] {
        let run = question_call(asked, &BALLS_OPTIONS, PASSING_MOTION).args(options);
        assert_eq!(only_row(&run).text("status"), status, "{options:?}");
        let output = run.args(&["--check", "-q"]).output();
        assert_eq!(output.status.code(), Some(code), "{asked} {options:?}");
        let told = stderr(&output).contains("--check: 1 of 1 rows");
        assert_eq!(told, code == 3, "{}", stderr(&output));
    }
    // A bad row takes precedence.
    let two = format!("{}bad,x\n", "id,a_px\nnear,0\n");
    CommandCall::query(&BALLS_OPTIONS)
        .args(&["--check"])
        .stdin(&two)
        .run_expecting_code(2);
    for (options, refusal) in [
        (&["--question", "distance"][..], "--check needs --clearance"),
        (
            &["--schedule", "fast", "--bound", "published"],
            "--check needs certified answers",
        ),
    ] {
        let run = CommandCall::query(&BALLS_OPTIONS)
            .args(&["--check"])
            .args(options);
        let message = run.stdin(PASSING_MOTION).run_for_messages(2);
        assert_contains(&message, refusal);
    }
}

/// Tests that `--check --resume` has the same exit code again when it finds the run finished.
#[test]
fn a_finished_check_fails_again() {
    let scene = Scene::new("check-again");
    let motions = scene.file("motions.csv", FALLING_CUBE_MOTION);
    let out = scene.directory.join("results.csv");
    let query = ["query", "--motions", motions.to_str().unwrap(), "--check"];
    let run = CommandCall::with_args(&query)
        .args(&CUBE_AND_SLAB_OPTIONS)
        .args(&["--out", out.to_str().unwrap()]);
    assert_eq!(run.output().status.code(), Some(3));
    run.args(&["--resume"]).run_expecting_code(3);
}

/// Returns a tube about z as the text of an OBJ file.
fn tube_obj(radii: [f64; 2], heights: [f64; 2]) -> String {
    const CORNERS: usize = 48;
    let mut text = String::new();
    for z in heights {
        for r in radii {
            for k in 0..CORNERS {
                let (sin, cos) = (TAU * k as f64 / CORNERS as f64).sin_cos();
                writeln!(text, "v {} {} {z}", r * cos, r * sin).unwrap();
            }
        }
    }
    for k in 0..CORNERS {
        let at = |ring: usize, k: usize| ring * CORNERS + k % CORNERS + 1;
        for [one, other] in [[1, 0], [2, 3], [3, 1], [0, 2]] {
            let [p, q, r, s] = [at(one, k), at(one, k + 1), at(other, k + 1), at(other, k)];
            writeln!(text, "f {p} {s} {r} {q}").unwrap();
        }
    }
    text
}

/// Tests that `--budget` holds for each segment of a path: a path of many segments is measured with more iterations in
/// total.
#[test]
fn a_long_path_is_measured_with_what_its_parts_need() {
    let scene = Scene::new("long-path");
    let wheel = scene.file("wheel.obj", &tube_obj([5.2, 8.0], [0.0, 8.0]));
    let axle = scene.file("axle.obj", &tube_obj([4.0, 5.0], [-10.0, 18.0]));
    let bodies = [
        "--a",
        wheel.to_str().unwrap(),
        "--b",
        axle.to_str().unwrap(),
    ];
    let turns = |quarters: u32| {
        let mut path = String::from("t,a_qw,a_qx,a_qy,a_qz\n");
        for k in 0..=quarters {
            let (sin, cos) = (f64::from(k) * FRAC_PI_4).sin_cos();
            writeln!(path, "{k},{cos},0,0,{sin}").unwrap();
        }
        path
    };
    let measured = |quarters, budget: &str| {
        let run = question_call("closest-approach", &bodies, &turns(quarters));
        let row = only_row(&run.args(&["--budget", budget]));
        assert_eq!(row.text("status"), "measured", "{budget}");
        row.number("iterations")
    };
    let one = measured(1, "80000");
    let all = measured(120, "80000");
    assert!(all > 80_000.0 && one < 40_000.0, "{one} and {all}");
}

/// A table of a cube and a slab in all kinds of places, at rest and in motion.
fn all_kinds_of_motions() -> String {
    let mut table = "a_px,a_pz,a_vz,a_wx\n".to_owned();
    for (k, x) in [0.0, 9.4, 9.5005, 9.7, 19.0].into_iter().enumerate() {
        for z in [0.0, 1.4, 1.5, 1.5005, 1.5015, 1.7, 4.0] {
            for v in [0.0, -1.0, 1.0, -4.0] {
                table += &format!("{x},{z},{v},{}\n", k % 2);
            }
        }
    }
    table
}

/// Tests that the statuses that a question has are those of the one table in the code: all of them occur, and no other.
#[test]
fn questions_have_the_statuses_of_their_table() {
    let table = all_kinds_of_motions();
    for answers in ANSWERS {
        let statuses = |more: &[&str]| {
            let call = question_call(answers.question.name(), &CUBE_AND_SLAB_OPTIONS, &table);
            let rows = call.args(more).run_for_rows();
            let found = rows.iter().map(|row| row.text("status").to_owned());
            found.collect::<BTreeSet<_>>()
        };
        let names = |listed: &[Status]| {
            listed
                .iter()
                .map(|status| status.name().to_owned())
                .collect()
        };
        assert_eq!(
            statuses(&[]),
            names(answers.statuses),
            "{}",
            answers.question
        );
        if answers.question.is_for_a_distance() {
            let mut found = statuses(&["--clearance", "0.2005"]);
            found.extend(statuses(&["--clearance", "0.0005"]));
            assert_eq!(
                found,
                names(answers.compared_statuses),
                "{}",
                answers.question
            );
        }
    }
}

/// Tests that the documentation and the help have the same statuses and columns.
#[test]
fn the_documentation_has_the_statuses_of_the_table() {
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/command.md");
    let page = fs::read_to_string(page).unwrap();
    let help = CommandCall::with_args(&["query", "--help"])
        .run_expecting_code(0)
        .stdout;
    let help = String::from_utf8(help).unwrap();
    for answers in ANSWERS {
        let name = answers.question.name();
        let start = [format!("| `{name}` | "), format!("| `{name}` (default) | ")];
        let is_row = |line: &&str| start.iter().any(|start| line.starts_with(start));
        let row = page.lines().find(is_row).unwrap();
        let cell = row.trim_end_matches(" |").rsplit(" | ").next().unwrap();
        let list = |listed: &[Status]| {
            let names: Vec<String> = listed
                .iter()
                .map(|status| format!("`{}`", status.name()))
                .collect();
            names.join(", ")
        };
        let expected = match answers.compared_statuses {
            [] => list(answers.statuses),
            compared => format!(
                "{}; with `--clearance`: {}",
                list(answers.statuses),
                list(compared)
            ),
        };
        assert_eq!(cell, expected, "{name}");
        for column in names(answers.more_columns) {
            assert_contains(row, &format!("`{column}`"));
            assert_contains(
                &page,
                &format!("| `{column}` | with `--question {name}` only"),
            );
        }
        let at = help.find(&format!("  {name}  ")).unwrap();
        let in_help = expected
            .replace(['`'], "")
            .replace("clearance:", "clearance");
        assert_contains(&help[at..], &format!("statuses {in_help}"));
    }
}

/// Tests that bodies that touch or overlap at the start have a last time, which is not early.
#[test]
fn an_interval_from_the_start_has_a_last_time() {
    let parts = "id,a_pz,a_vz\nin,1.4,1\non,1.5005,1\nstays,1.4,0\nback,1.4,-1\n";
    let rows = question_call("contact-interval", &CUBE_AND_SLAB_OPTIONS, parts).run_for_rows();
    let found: Vec<_> = rows
        .iter()
        .map(|row| (row.text("status"), row.text("time")))
        .collect();
    assert_eq!(
        found,
        [
            ("overlapping", "0.0"),
            ("touching", "0.0"),
            ("overlapping", "0.0"),
            ("overlapping", "0.0")
        ]
    );
    let last: Vec<f64> = rows.iter().map(|row| row.number("last_time")).collect();
    // The cube leaves the slab when it is 0.5 above its top at 1, and is in contact within the tolerance.
    assert!((0.1..=0.1011).contains(&last[0]), "{last:?}");
    assert!((0.0..=0.0006).contains(&last[1]), "{last:?}");
    assert_eq!(last[2..], [1.0, 1.0]);
}
