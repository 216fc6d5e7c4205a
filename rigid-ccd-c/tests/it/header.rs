//! Tests that both headers compile without a warning, and that a program in C and one in C++ build and answer right.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The warnings that are errors here.
const WARNINGS: [&str; 6] = [
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wshadow",
    "-Werror",
];

fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Returns the static library that cargo has built beside this test.
fn static_library() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let library = test.parent().unwrap().join("librigid_ccd_c.a");
    assert!(library.exists(), "{} is missing", library.display());
    library
}

/// Runs a command, and returns what it prints.
#[track_caller]
fn run(command: &mut Command) -> String {
    let output = command
        .output()
        .unwrap_or_else(|why| panic!("{command:?}: {why}"));
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// Builds an example, and returns what it prints.
fn build_and_run(compiler: &str, standard: &str, example: &str) -> String {
    let program = std::env::temp_dir().join(format!("rigid_ccd_{}_{example}", std::process::id()));
    run(Command::new(compiler)
        .args([standard, "-O1"])
        .args(WARNINGS)
        .arg(format!("-I{}", folder().join("include").display()))
        .arg("-o")
        .arg(&program)
        .arg(folder().join("examples").join(example))
        .arg(static_library())
        .args(["-lpthread", "-ldl", "-lm"]));
    let printed = run(Command::new(&program).current_dir(folder().join("../rigid-ccd")));
    std::fs::remove_file(program).unwrap();
    printed
}

#[test]
fn the_headers_compile_without_a_warning() {
    for (compiler, standard, language, header) in [
        ("cc", "-std=c99", "c", "rigid_ccd.h"),
        ("cc", "-std=c11", "c", "rigid_ccd.h"),
        ("c++", "-std=c++17", "c++", "rigid_ccd.h"),
        ("c++", "-std=c++17", "c++", "rigid_ccd.hpp"),
        ("c++", "-std=c++20", "c++", "rigid_ccd.hpp"),
    ] {
        run(Command::new(compiler)
            .args([standard, "-fsyntax-only", "-x", language])
            .args(WARNINGS)
            .arg("-Wno-pragma-once-outside-header")
            .arg(folder().join("include").join(header)));
    }
}

#[test]
fn a_program_in_c_answers() {
    let printed = build_and_run("cc", "-std=c99", "first_contact.c");
    assert!(printed.starts_with("contact at 0.99"), "{printed}");
}

#[test]
fn a_program_in_cpp_answers() {
    let printed = build_and_run("c++", "-std=c++17", "first_contact.cpp");
    assert!(printed.starts_with("contact at 0.99"), "{printed}");
    assert!(printed.contains("no triangles"), "{printed}");
}
