//! The command `ccd-web`, which writes the page.

mod answers;
mod page;

/// Write the page on which a visitor throws parts: one file that works from disk.
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

fn main() -> anyhow::Result<()> {
    let args = <Args as clap::Parser>::parse();
    page::write(&args.out, args.check)
}
