//! Writes pages to files.

use crate::console::print_error;
use crate::files::output::Output;
use anyhow::Result;
use ccd_view::Page;

/// Writes a page, and says so unless `quiet`.
pub(crate) fn write_page(page: &Page<'_>, out: Output, quiet: bool) -> Result<()> {
    let html = page.html()?;
    let told = (!quiet && !out.is_stream()).then(|| out.name());
    out.write(|writer| writer.write_all(html.as_bytes()))?;
    if let Some(name) = told {
        print_error(&format!("open {name} in a browser"));
    }
    Ok(())
}
