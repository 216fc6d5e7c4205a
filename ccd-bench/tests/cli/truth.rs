//! Tests that `ccd-bench truth` writes a bracket of the first contact for each row of motions, and reports bad rows.

use crate::TETRAHEDRON_OBJ;
use crate::command::{CommandCall, Scene, parse, stderr};

const MOTIONS_CSV: &str = "id,a_px,a_py,a_pz,a_vx,duration\n\
                       hit,3,-.2,-.3,-4,1\nfree,3,-.2,-.3,-4,.1\ninitial,.1,-.2,-.3,0,1\n";

#[test]
fn brackets_hold_the_exact_first_contact() {
    let scene = Scene::new("truth");
    let mesh = scene.file("tetrahedron.obj", TETRAHEDRON_OBJ);
    let mesh = mesh.to_str().unwrap();
    let truth = scene.directory.join("truth.csv");
    let motions = scene.file("motions.csv", MOTIONS_CSV);
    let options = ["--motions", motions.to_str().unwrap()];
    let run = CommandCall::with_args(&["truth", "--a", mesh, "--b", mesh])
        .args(&options)
        .args(&["--out", truth.to_str().unwrap()]);
    let output = run.output();
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(output.stdout, b"");
    let message = stderr(&output);
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(
        message
            .starts_with("3 rows: 1 hit, 1 free, 1 initial, 0 graze, 0 undecided; widest bracket "),
        "{message}"
    );
    let rows = parse(&std::fs::read(&truth).unwrap());
    for row in &rows {
        assert_eq!(row.text("id"), row.text("status"));
    }
    // Face x = 0 reaches the corner at x = 1.
    let (lo, hi) = (rows[0].number("lo"), rows[0].number("hi"));
    assert!(lo <= 0.5 && 0.5 <= hi && hi - lo < 1e-12, "{lo} {hi}");
    assert_eq!([rows[1].number("lo"), rows[1].number("hi")], [0.1, 0.1]);
    assert_eq!([rows[2].number("lo"), rows[2].number("hi")], [0.0, 0.0]);
}

#[test]
fn good_rows_are_judged_and_bad_ones_reported() {
    let scene = Scene::new("truth-bad");
    let mesh = scene.file("tetrahedron.obj", TETRAHEDRON_OBJ);
    let mesh = mesh.to_str().unwrap();
    let run = CommandCall::with_args(&[
        "truth",
        "--a",
        mesh,
        "--b",
        mesh,
        "--motions",
        "-",
        "--quiet",
    ]);
    let output = run
        .stdin("id,a_px,a_py,a_pz,a_vx\nbad,x,0,0,0\ngood,3,.1,.1,-4\n")
        .output();
    assert_eq!(output.status.code(), Some(2));
    let rows = parse(&output.stdout);
    let statuses = rows.iter().map(|row| row.text("status"));
    assert_eq!(statuses.collect::<Vec<_>>(), ["error", "hit"]);
    assert_eq!([rows[0].text("lo"), rows[1].text("reason")], ["", ""]);
    assert!(rows[0].text("reason").contains("`x`"));
    let message = stderr(&output);
    assert!(
        message.contains("standard input, row 0 (line 2): column a_px"),
        "{message}"
    );
}

#[test]
fn impossible_requests_are_refused() {
    let scene = Scene::new("truth-refused");
    let mesh = scene.file("tetrahedron.obj", TETRAHEDRON_OBJ);
    let mesh = mesh.to_str().unwrap();
    let motions = scene.file("motions.csv", MOTIONS_CSV);
    let motions = motions.to_str().unwrap();
    let nowhere = scene.directory.join("none").join("truth.csv");
    let run = |a: &str, out: &str| {
        let arguments = ["truth", "--a", a, "--b", mesh, "--motions", motions];
        CommandCall::with_args(&arguments)
            .args(&["--out", out])
            .output()
    };
    assert_eq!(run("missing.obj", "-").status.code(), Some(2));
    assert_eq!(run(mesh, motions).status.code(), Some(2));
    assert_eq!(run(mesh, nowhere.to_str().unwrap()).status.code(), Some(1));
    assert_eq!(std::fs::read_to_string(motions).unwrap(), MOTIONS_CSV);
}
