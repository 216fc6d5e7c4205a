//! The executable `ccd-bench`, which runs the command line of the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    ccd_bench::command::main()
}
