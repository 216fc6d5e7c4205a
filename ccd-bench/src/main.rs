//! The `ccd` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    ccd_bench::cli::main()
}
