//! The `ccd` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    rigid_ccd_cli::main()
}
