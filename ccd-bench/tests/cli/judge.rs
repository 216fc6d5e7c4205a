//! Tests that `ccd-bench judge` gives the recorded verdicts on failures of other methods, and finds the default method
//! right on all of them.

use std::path::Path;
use std::process::Command;

/// Recorded failures: the folder, the method, the tolerance, and the verdict recorded in `failures/README.md`.
const RECORDED_FAILURES: [(&str, &str, &str, &str); 11] = [
    (
        "fast-vmarch-published-late",
        "fast vmarch published",
        "1e-6",
        "late",
    ),
    (
        "discrete-stepping-late",
        "discrete stepping",
        "1e-2",
        "late",
    ),
    ("parry-f64-late", "parry-f64", "1e-3", "missed"),
    ("parry-f64-early", "parry-f64", "1e-6", "false"),
    ("parry-f32-late", "parry-f32", "1e-3", "missed"),
    ("parry-f32-early", "parry-f32", "1e-6", "early"),
    ("parry-sweep-f64-early", "parry-sweep-f64", "1e-3", "false"),
    ("parry-sweep-f32-late", "parry-sweep-f32", "1e-6", "missed"),
    ("parry-sweep-f32-early", "parry-sweep-f32", "1e-6", "false"),
    ("rapier-step-f64-late", "rapier-step-f64", "1e-6", "missed"),
    ("rapier-step-f64-early", "rapier-step-f64", "1e-6", "false"),
];

/// The folders and tolerances of recorded failures of Python methods; only the default method is run on them here.
const RECORDED_PYTHON_FAILURES: [(&str, &str); 5] = [
    ("coal-steps-late", "1e-2"),
    ("fcl-ca-late", "1e-3"),
    ("fcl-ca-early", "1e-6"),
    ("fcl-naive-late", "1e-3"),
    ("fcl-naive-early", "1e-6"),
];

/// Returns the verdict on a method's answer to a recorded failure.
fn verdict(folder: &str, method: &str, tolerance: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("failures")
        .join(folder);
    let output = Command::new(crate::PROGRAM_PATH)
        .args(["judge", "--method", method, "--tolerance", tolerance])
        .args(["--patience", "60"])
        .arg("--a")
        .arg(folder.join("a.obj"))
        .arg("--b")
        .arg(folder.join("b.obj"))
        .arg("--motions")
        .arg(folder.join("motions.csv"))
        .output()
        .unwrap();
    let table = String::from_utf8(output.stdout).unwrap();
    let mut lines = table.lines();
    assert_eq!(
        lines.next(),
        Some("id,status,lo,hi,verdict,answer,time"),
        "{folder:?}: {output:?}",
        output = output.stderr
    );
    lines.next().unwrap().split(',').nth(4).unwrap().to_owned()
}

#[test]
fn kept_failures_are_still_failures_and_the_default_is_right() {
    let of_rust = RECORDED_FAILURES.map(|(folder, _, tolerance, _)| (folder, tolerance));
    for (folder, tolerance) in of_rust.into_iter().chain(RECORDED_PYTHON_FAILURES) {
        assert_eq!(
            verdict(folder, "best-first direct", tolerance),
            "right",
            "{folder}"
        );
    }
    for (folder, method, tolerance, recorded) in RECORDED_FAILURES {
        assert_eq!(verdict(folder, method, tolerance), recorded, "{folder}");
    }
}

#[test]
fn every_recorded_failure_is_run() {
    let kept = std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("failures")).unwrap();
    let folders = kept.filter(|entry| entry.as_ref().unwrap().path().is_dir());
    assert_eq!(
        folders.count(),
        RECORDED_FAILURES.len() + RECORDED_PYTHON_FAILURES.len()
    );
}
