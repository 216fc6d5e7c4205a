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

/// Builds a program of this folder, and returns what it prints.
fn build_and_run(compiler: &str, options: &[&str], source: &str, arguments: &[&str]) -> String {
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
        .current_dir(folder().join("../rigid-ccd")))
}

#[test]
fn the_headers_compile_without_a_warning() {
    for (compiler, standard, language, header) in [
        ("cc", "-std=c99", "c", "rigid_ccd.h"),
        ("cc", "-std=c11", "c", "rigid_ccd.h"),
        ("c++", "-std=c++17", "c++", "rigid_ccd.h"),
        ("c++", "-std=c++17", "c++", "rigid_ccd.hpp"),
        ("c++", "-std=c++20", "c++", "rigid_ccd.hpp"),
        ("c++", "-std=c++17", "c++", "rigid_ccd_cell.hpp"),
        ("c++", "-std=c++20", "c++", "rigid_ccd_cell.hpp"),
    ] {
        run(Command::new(compiler)
            .args([standard, "-fsyntax-only", "-x", language])
            .args(WARNINGS)
            .arg(folder().join("include").join(header)));
    }
}

#[test]
fn a_program_in_c_answers() {
    let printed = build_and_run("cc", &["-std=c99"], "examples/first_contact.c", &[]);
    assert!(printed.starts_with("contact at 0.99"), "{printed}");
}

#[test]
fn a_program_in_cpp_answers() {
    let printed = build_and_run("c++", &["-std=c++17"], "examples/first_contact.cpp", &[]);
    assert!(printed.starts_with("contact at 0.99"), "{printed}");
    assert!(printed.contains("no triangles"), "{printed}");
}

#[test]
fn failures_are_values_without_exceptions() {
    let options = ["-std=c++17", "-fno-exceptions"];
    let printed = build_and_run("c++", &options, "tests/programs/expected.cpp", &[]);
    let expected = "2.00; radius is -1";
    assert!(printed.contains("no such file.urdf"), "{printed}");
    assert!(printed.starts_with(expected), "{printed}");
}

#[test]
fn robots_in_cpp_answer() {
    let arguments = ["../rigid-ccd-robot/examples/edges/arm.urdf", "link7"];
    let printed = build_and_run(
        "c++",
        &["-std=c++17"],
        "tests/programs/cells.cpp",
        &arguments,
    );
    assert!(printed.ends_with("of 50 edges are free\n"), "{printed}");
}

#[test]
fn threads_in_cpp_share() {
    let arguments = ["../rigid-ccd-robot/examples/edges/arm.urdf"];
    let program = "tests/programs/threads.cpp";
    let printed = build_and_run("c++", &["-std=c++17"], program, &arguments);
    assert_eq!(printed, "threads agree\n");
}
