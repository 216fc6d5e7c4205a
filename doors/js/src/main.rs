//! The command `rigid-ccd-js`, which writes the npm package.

use rigid_ccd_js::package::Modules;

/// Write the npm package `rigid-ccd` into a folder.
#[derive(clap::Parser)]
struct Args {
    /// The folder, which is made if there is none.
    #[arg(default_value = "target/js")]
    folder: std::path::PathBuf,
    /// Leave out the module for WebAssembly without vector instructions, which is half of the work; such a package is for tests
    #[arg(long)]
    without_fallback: bool,
}

fn main() -> anyhow::Result<()> {
    let args = <Args as clap::Parser>::parse();
    let modules = if args.without_fallback {
        Modules::WithVectors
    } else {
        Modules::All
    };
    rigid_ccd_js::package::write(&args.folder, modules)
}
