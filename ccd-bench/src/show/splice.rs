//! Inserts tables into a README, between markers.

use crate::show::tables::TextTable;
use crate::show::write;
use anyhow::{Context, Result, ensure};
use std::fs;
use std::path::Path;

/// Replaces the text between the markers `<!-- ccd chart: NAME -->` and `<!-- end -->` by the table of that name, for
/// each marker in the file.
///
/// # Errors
/// If the file cannot be read or written, has no marker of any table, or has a marker without an end.
pub fn splice(file: &Path, tables: &[TextTable]) -> Result<()> {
    let text = fs::read_to_string(file)?;
    let with_tables = with_tables(&text, tables)?;
    Ok(write(file, &with_tables)?)
}

fn with_tables(text: &str, tables: &[TextTable]) -> Result<String> {
    let mut text = text.to_owned();
    let mut found = false;
    for table in tables {
        let begin = format!("<!-- ccd chart: {} -->\n", table.name);
        let Some(from) = text.find(&begin).map(|at| at + begin.len()) else {
            continue;
        };
        let length = text[from..]
            .find(END_MARKER)
            .with_context(|| format!("no `{END_MARKER}` after `{}`", begin.trim_end()))?;
        let body = format!("{}:\n\n{}\n", table.title, table.as_markdown());
        text.replace_range(from..from + length, &body);
        found = true;
    }
    ensure!(
        found,
        "there is no marker such as `<!-- ccd chart: usual -->`"
    );
    Ok(text)
}

const END_MARKER: &str = "<!-- end -->";

#[cfg(test)]
mod tests;
