//! Inserts tables into a README, between markers.

use crate::show::tables::TextTable;
use anyhow::{Context, Result, ensure};
use std::fs;
use std::path::Path;

/// Replaces the text between `<!-- ccd chart: NAME -->` and the next `<!-- end -->` by the table of
/// that name, for every table that the file has a marker for.
///
/// # Errors
/// If the file cannot be read or written, has no marker of any table, or has a marker without an end.
pub fn splice(file: &Path, tables: &[TextTable]) -> Result<()> {
    let text = fs::read_to_string(file)?;
    let spliced = spliced(&text, tables)?;
    Ok(ccd_file::write(file, |out| {
        out.write_all(spliced.as_bytes())
    })?)
}

fn spliced(text: &str, tables: &[TextTable]) -> Result<String> {
    let mut text = text.to_owned();
    let mut found = false;
    for table in tables {
        let begin = format!("<!-- ccd chart: {} -->\n", table.name);
        let Some(from) = text.find(&begin).map(|at| at + begin.len()) else {
            continue;
        };
        let length = text[from..]
            .find(END)
            .with_context(|| format!("no `{END}` after `{}`", begin.trim_end()))?;
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

const END: &str = "<!-- end -->";

#[cfg(test)]
mod tests {
    use super::*;

    fn table(name: &str) -> TextTable {
        TextTable {
            name: name.to_owned(),
            title: "Title".to_owned(),
            header: vec!["scene".to_owned(), "x".to_owned()],
            rows: vec![vec!["santa".to_owned(), "1.5".to_owned()]],
        }
    }

    #[test]
    fn text_between_the_markers_is_replaced_and_nothing_else() {
        let text = "a\n<!-- ccd chart: usual -->\nold\n<!-- end -->\nb\n";
        let once = spliced(text, &[table("fine"), table("usual")]).unwrap();
        assert!(once.starts_with("a\n<!-- ccd chart: usual -->\nTitle:\n\n| scene"));
        assert!(once.contains("santa") && !once.contains("old"));
        assert!(once.ends_with("<!-- end -->\nb\n"));
        assert_eq!(spliced(&once, &[table("usual")]).unwrap(), once);
    }

    #[test]
    fn a_file_without_markers_is_refused() {
        assert!(spliced("nothing", &[table("usual")]).is_err());
        assert!(spliced("<!-- ccd chart: usual -->\n", &[table("usual")]).is_err());
    }
}
