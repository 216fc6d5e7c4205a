//! The command `ccd-web`, which writes the page.

#[cfg(not(target_family = "wasm"))]
mod answers;
#[cfg(not(target_family = "wasm"))]
mod page;

/// Write the page on which a visitor throws parts: one file that works from disk.
#[cfg(not(target_family = "wasm"))]
#[derive(clap::Parser)]
struct Args {
    /// The HTML file to write.
    #[arg(default_value = "throw.html")]
    out: std::path::PathBuf,
    /// Make the page test itself when it is opened: it compares its answers with those computed now, and throws a part
    /// with simulated pointer events. What is wrong goes to the console.
    #[arg(long)]
    check: bool,
}

#[cfg(not(target_family = "wasm"))]
fn main() -> anyhow::Result<()> {
    let args = <Args as clap::Parser>::parse();
    page::write(&args.out, args.check)
}

#[cfg(target_family = "wasm")]
fn main() {}
