//! Writes pages to files.

use crate::console::print_error;
use crate::files::output::Output;
use anyhow::Result;

/// Writes a page, and prints how to open it unless `quiet`.
pub(crate) fn write_page(html: &str, out: Output, quiet: bool) -> Result<()> {
    let name = (!quiet && !out.is_stream()).then(|| out.name());
    out.write(|writer| writer.write_all(html.as_bytes()))?;
    if let Some(name) = name {
        print_error(&format!("open {name} in a browser"));
    }
    Ok(())
}
