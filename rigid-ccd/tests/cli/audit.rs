//! Tests `ccd audit`: motions that another checker has called free.

use super::command::{Run, Scene, assert_contains, parse, stderr};

/// A ball that flies through a plate. Of ten equal steps of the fast shots none is in the plate.
const BALL_AND_PLATE_OPTIONS: [&str; 4] = ["--a", "sphere:0.5", "--b", "box:0.001,5,5"];
const SHOTS_TABLE: &str =
    "id,a_px,a_py,a_vx\nbeside,-3,6,60\nfast,-3,0,60\nfast/2,-3,0,70\ntouching,0.501,0,0\n";

fn audit() -> Run {
    Run::with_args(&["audit", "--motions", "-"]).args(&BALL_AND_PLATE_OPTIONS)
}

#[test]
fn rows_that_are_not_free_are_listed() {
    let output = audit().stdin(SHOTS_TABLE).ends(3);
    let rows = parse(&output.stdout);
    let ids: Vec<&str> = rows.iter().map(|row| row.text("id")).collect();
    assert_eq!(ids, ["fast", "fast/2", "touching"]);
    let exact = 2.499 / 60.0;
    let early = exact - rows[0].number("time");
    assert!((0.0..1e-6).contains(&early), "{early} early");
    assert!((rows[0].number("witness_b_x") + 0.001).abs() < 1e-9);
    assert!(rows[0].0.iter().all(|(name, _)| name != "page"));
    let message = stderr(&output);
    assert_contains(
        &message,
        "1 of 4 rows are free: that is proven, 2 contact, 1 touching",
    );
}

#[test]
fn free_rows_are_left_out() {
    let output = audit().stdin("a_px,a_py\n-3,0\n0,6\n").ends(0);
    assert_eq!(parse(&output.stdout).len(), 0);
    assert_contains(&stderr(&output), "2 of 2 rows are free");
    // With a small tolerance, a distance of a hundred thousandth is free.
    assert!(audit().stdin("a_px\n0.50101\n").output().status.success());
    let kept = audit().args(&["--margin", "1e-4"]);
    assert_eq!(
        kept.stdin("a_px\n0.50101\n").output().status.code(),
        Some(3)
    );
}

#[test]
fn each_has_a_page() {
    let scene = Scene::new("audit");
    let pages = scene.directory.join("pages");
    let _ = std::fs::remove_dir_all(&pages);
    let run = audit().folder(&scene.directory).args(&["--pages", "pages"]);
    let rows = parse(&run.stdin(SHOTS_TABLE).output().stdout);
    let named: Vec<&str> = rows.iter().map(|row| row.text("page")).collect();
    let names = ["fast.html", "fast_2.html", "touching.html"];
    assert_eq!(named, names.map(|name| format!("pages/{name}")));
    for name in named {
        let page = std::fs::read_to_string(scene.directory.join(name)).unwrap();
        assert!(page.contains("id=\"views\">"), "{name}");
    }
    let few = audit().folder(&scene.directory);
    let few = few.args(&["--pages", "pages", "--most-pages", "1"]);
    let output = few.stdin(SHOTS_TABLE).output();
    let rows = parse(&output.stdout);
    assert_eq!(
        [0, 1, 2].map(|k| rows[k].text("page")),
        ["pages/fast.html", "", ""]
    );
    assert_contains(&stderr(&output), "--most-pages");
}

#[test]
fn rows_without_an_answer_are_reported() {
    let rods = ["--a", "capsule:.01,2", "--b", "capsule:.01,2"];
    let run = Run::with_args(&["audit", "--motions", "-", "--budget", "1"]).args(&rods);
    let output = run
        .stdin("a_px,a_vx,a_wx,a_wy,a_wz\n-3,4,300,200,100\n")
        .ends(3);
    let rows = parse(&output.stdout);
    assert_eq!(rows[0].text("status"), "unresolved");

    let output = audit().stdin("a_px,a_vx\n-3,x\n-3,60\n").ends(2);
    let rows = parse(&output.stdout);
    assert_eq!([0, 1].map(|k| rows[k].text("status")), ["error", "contact"]);
    assert_contains(&stderr(&output), "row 0 (line 2): column a_vx: `x`");
}

#[test]
fn unreadable_and_unwritable_files_are_refused() {
    let scene = Scene::new("audit-refused");
    let file = scene.file("file", "");
    let run = audit().args(&["--pages", file.to_str().unwrap()]);
    assert_eq!(run.stdin(SHOTS_TABLE).output().status.code(), Some(1));
    let missing = scene.directory.join("none/pages");
    let run = audit().args(&["--pages", missing.to_str().unwrap()]);
    assert_eq!(run.stdin(SHOTS_TABLE).output().status.code(), Some(1));
    let motions = scene.file("motions.csv", SHOTS_TABLE);
    let motions = motions.to_str().unwrap();
    let run = Run::with_args(&["audit", "--motions", motions, "--out", motions])
        .args(&BALL_AND_PLATE_OPTIONS);
    let message = run.expect_messages(2);
    assert_contains(&message, "would overwrite");
    audit().stdin("a_x\n1\n").ends(2);
}
