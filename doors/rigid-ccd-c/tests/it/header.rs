//! Tests that the headers compile without a warning, and that programs in C and C++ build and answer correctly.

use crate::programs::{WARNINGS, build_and_run, folder, run};
use std::process::Command;

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
fn the_initial_settings_are_the_default_ones() {
    for (compiler, standard) in [("cc", "-std=c99"), ("c++", "-std=c++17")] {
        let printed = build_and_run(compiler, &[standard], "tests/programs/init.c", &[]);
        assert_eq!(printed.trim_end(), env!("CARGO_PKG_VERSION"), "{standard}");
    }
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
fn no_handle_is_lost() {
    let other = folder().join("tests/programs/failures_as_values.cpp");
    let options = ["-std=c++17", other.to_str().unwrap()];
    let printed = build_and_run("c++", &options, "tests/programs/handles.cpp", &[]);
    assert_eq!(printed, "handles hold\n");
}

#[test]
fn robots_in_cpp_answer() {
    let arm = folder().join("../../rigid-ccd-robot/examples/edges/arm.urdf");
    let arguments = [arm.to_str().unwrap(), "link7"];
    let printed = build_and_run(
        "c++",
        &["-std=c++17"],
        "tests/programs/cells.cpp",
        &arguments,
    );
    assert!(printed.ends_with("of 50 edges are free\n"), "{printed}");
}

#[test]
fn the_gate_stops_before_the_table() {
    let arm = folder().join("../rigid-ccd-cli/examples/arm.urdf");
    let arguments = [arm.to_str().unwrap()];
    let printed = build_and_run("c++", &["-std=c++17"], "examples/gate.cpp", &arguments);
    assert!(printed.starts_with("go until waypoint "), "{printed}");
}

#[test]
fn the_robot_of_the_documentation_prints_what_is_shown() {
    let printed = build_and_run("c++", &["-std=c++17"], "examples/robot.cpp", &[]);
    let page = include_str!("../../../../docs/c.md");
    assert!(
        page.contains(&format!("```text\n{printed}```")),
        "{printed}"
    );
}

#[test]
fn threads_in_cpp_fraction() {
    let arm = folder().join("../../rigid-ccd-robot/examples/edges/arm.urdf");
    let arguments = [arm.to_str().unwrap()];
    let program = "tests/programs/threads.cpp";
    let printed = build_and_run("c++", &["-std=c++17"], program, &arguments);
    assert_eq!(printed, "threads agree\n");
}
