//! The `ccd-bench` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    ccd_bench::command::main()
}
