//! Tests that `ccd-bench stability` judges a right and a wrong method as expected, and resumes a survey.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn run_survey(folder: &Path, methods: &str) -> Output {
    let families = ["--families", "bullet and paper, margin"];
    run_stability(folder, &[&families[..], &["--methods", methods]].concat())
}

fn run_stability(folder: &Path, options: &[&str]) -> Output {
    let mut command = Command::new(crate::PROGRAM_PATH);
    command.arg("stability").args(options);
    command.arg("--out").arg(folder);
    command.output().unwrap()
}

/// Returns the cells of a method's row in the table: the number of queries, and the numbers of queries with each
/// verdict that occurs.
fn row<'t>(table: &'t str, method: &str) -> Vec<&'t str> {
    let line = table.lines().find(|line| line.contains(method)).unwrap();
    line.rsplit(method)
        .next()
        .unwrap()
        .split_whitespace()
        .filter(|cell| *cell != "|")
        .collect()
}

#[test]
fn methods_are_judged_and_answers_are_kept() {
    let folder = std::env::temp_dir().join(format!("ccd-stability-{}", std::process::id()));
    let output = run_survey(&folder, "best-first direct,discrete stepping");
    let table = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{table}");
    // Three values of two families, each in three worlds.
    assert_eq!(
        row(&table, "best-first direct")[..2],
        ["18", "18"],
        "{table}"
    );
    let limit = |family: &str| {
        let limits = fs::read_to_string(folder.join("limits.md")).unwrap();
        let line = limits.lines().find(|line| line.contains(family)).unwrap();
        line.to_owned()
    };
    // Stepping detects thin paper only once the body is inside it.
    let paper = limit("bullet and paper");
    assert!(paper.contains("late"), "{paper}");
    // A second run runs only what is missing.
    let answers = fs::read_to_string(folder.join("trials.csv")).unwrap();
    let again = run_survey(&folder, "best-first direct,discrete stepping,C2A");
    assert!(again.status.success());
    let more = fs::read_to_string(folder.join("trials.csv")).unwrap();
    assert!(more.starts_with(&answers) && more.contains("C2A"));
    // The method has no margin.
    let margin = limit("| margin");
    assert!(margin.contains("1e-2 refused"), "{margin}");
    // All answers are drawn, although fewer are requested.
    let few = run_stability(&folder, &["--families", "margin", "--methods", "CONTACT"]);
    assert!(few.status.success());
    let paper = limit("bullet and paper");
    assert!(
        paper.contains("late") && paper.contains("not asked"),
        "{paper}"
    );
    let drawn = fs::read_to_string(folder.join("limits.md")).unwrap();
    assert!(run_stability(&folder, &["--redraw"]).status.success());
    assert_eq!(fs::read_to_string(folder.join("limits.md")).unwrap(), drawn);
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_folder_without_answers_is_not_drawn() {
    let output = run_stability(Path::new("never-made"), &["--redraw"]);
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.contains("holds no answers"), "{message}");
    assert!(!output.status.success() && !Path::new("never-made").exists());
}

#[test]
fn a_script_that_does_not_run_is_an_error() {
    let script = ["--peers", "never-made.py", "--methods", "coal-steps"];
    let output = run_stability(Path::new("never-made"), &script);
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.contains("python-fcl"), "{message}");
    assert!(!output.status.success() && !Path::new("never-made").exists());
}

#[test]
fn unknown_names_are_answered_with_the_known_ones() {
    let output = run_survey(Path::new("never-made"), "unicorn");
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(
        !output.status.success() && message.contains("discrete stepping"),
        "{message}"
    );
}
