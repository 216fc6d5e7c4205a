//! Builds and runs programs against the static library that cargo has built beside the tests.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The warnings that are errors here.
pub(crate) const WARNINGS: [&str; 6] = [
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wshadow",
    "-Werror",
];

pub(crate) fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Returns the static library that cargo has built beside this test.
pub(crate) fn static_library() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let library = test.parent().unwrap().join("librigid_ccd_c.a");
    assert!(library.exists(), "{} is missing", library.display());
    library
}

/// Runs a command, and returns what it prints.
#[track_caller]
pub(crate) fn run(command: &mut Command) -> String {
    let output = command
        .output()
        .unwrap_or_else(|why| panic!("{command:?}: {why}"));
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// Builds a program of this crate, runs it in a folder of its own, and returns what it prints.
pub(crate) fn build_and_run(
    compiler: &str,
    options: &[&str],
    source: &str,
    arguments: &[&str],
) -> String {
    let folder_of_program = tempfile::tempdir().unwrap();
    let program = folder_of_program.path().join("program");
    run(Command::new(compiler)
        .args(options)
        .arg("-O1")
        .args(WARNINGS)
        .arg(format!("-I{}", folder().join("include").display()))
        .arg("-o")
        .arg(&program)
        .arg(folder().join(source))
        .arg(static_library())
        .args(["-lpthread", "-ldl", "-lm"]));
    run(Command::new(&program)
        .args(arguments)
        .current_dir(&folder_of_program))
}
