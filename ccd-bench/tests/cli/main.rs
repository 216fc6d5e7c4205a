//! Tests the `ccd-bench` program by running its commands and reading their output.

mod chart;
#[path = "../../../doors/rigid-ccd-cli/tests/cli/command.rs"]
mod command;
mod cost;
mod judge;
mod peer;
mod stability;
mod truth;

use command::{CommandCall, stderr};

/// The path of the `ccd-bench` program that the tests run.
const PROGRAM_PATH: &str = env!("CARGO_BIN_EXE_ccd-bench");

const TETRAHEDRON_OBJ: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

#[test]
fn models_need_a_directory_that_exists() {
    let output = CommandCall::with_args(&["chart", "--models", "no/such/models"])
        .stdin("")
        .output();
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("no/such/models"));
}
