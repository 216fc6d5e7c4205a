//! The command `rigid-ccd-js`, which writes the npm package.

/// Write the npm package `rigid-ccd` into a folder.
#[derive(clap::Parser)]
struct Args {
    /// The folder, which is made if there is none.
    #[arg(default_value = "target/js")]
    folder: std::path::PathBuf,
}

fn main() -> anyhow::Result<()> {
    let args = <Args as clap::Parser>::parse();
    rigid_ccd_js::package::write(&args.folder)
}
