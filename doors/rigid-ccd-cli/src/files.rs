//! Opens input tables from files or standard input, and names files in messages.

pub(crate) mod html;
pub(crate) mod output;
pub(crate) mod table;

use crate::files::output::{JOURNAL_EXTENSION, is_dash, is_standard_output};
use anyhow::{Context, Result, anyhow, bail};
use ccd_file::{PARTIAL_EXTENSION, folder_to_open, resolve_links};
use ccd_tables::motions::MotionRows;
use ccd_tables::movements::MovementRows;
use ccd_tables::paths::Grouping;
use ccd_tables::table_records::TableRecords;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// Returns an error if an output, or a temporary file of the output, would overwrite an input.
pub fn refuse_overwriting_input(
    (read, source): (&str, &Path),
    (written, target): (&str, &Path),
) -> Result<()> {
    if is_standard_output(target) {
        return Ok(());
    }
    if is_same_file(source, target) {
        bail!("{written} would overwrite the file of {read}; give {written} another file");
    }
    let target_file = resolve_links(target).unwrap_or_else(|_| target.to_owned());
    for ending in [PARTIAL_EXTENSION, JOURNAL_EXTENSION] {
        let mut name = target_file.clone().into_os_string();
        name.push(ending);
        let temporary_file = PathBuf::from(name);
        if is_same_file(source, &temporary_file) {
            let temporary_file = temporary_file.display();
            bail!(
                "{written} would overwrite {temporary_file}, the file of {read}; give {written} another file"
            );
        }
    }
    Ok(())
}

/// Returns an error if an output would overwrite an input or another output, or if two outputs are standard output. Each
/// file comes with the option that names it.
pub(crate) fn refuse_shared_files<'p>(
    inputs: impl IntoIterator<Item = (&'static str, &'p Path)>,
    outputs: &[(&str, &Path)],
) -> Result<()> {
    for input in inputs {
        for &output in outputs {
            refuse_overwriting_input(input, output)?;
        }
    }
    for (k, &output) in outputs.iter().enumerate() {
        for &other in &outputs[..k] {
            if is_standard_output(output.1) && is_standard_output(other.1) {
                let (option, other_option) = (output.0, other.0);
                bail!(
                    "{option} - and {other_option} - are both standard output; give one of them a file"
                );
            }
            refuse_overwriting_input(other, output)?;
            refuse_overwriting_input(output, other)?;
        }
    }
    Ok(())
}

/// Opens a table of motions, and returns its rows and, if known, its length in bytes.
pub fn open_motions(path: &Path) -> Result<(MotionRows<TableRecords>, Option<u64>)> {
    let (records, length) = open_table("--motions", path)?;
    let rows = MotionRows::of(records).with_context(|| input_name(path))?;
    Ok((rows, length))
}

/// The rows of a table of motions or paths, from a file or standard input.
pub(super) type Rows = MovementRows<TableRecords>;

/// Opens a table of motions or paths, and returns its rows and, if known, its length in bytes.
pub(super) fn open_movement_rows(path: &Path, grouping: Grouping) -> Result<(Rows, Option<u64>)> {
    let (records, length) = open_table("--motions", path)?;
    let rows = MovementRows::of(records, grouping).with_context(|| input_name(path))?;
    Ok((rows, length))
}

/// Opens the table that an option names, and returns its rows and, if known, its length in bytes.
pub(super) fn open_table(option: &str, path: &Path) -> Result<(TableRecords, Option<u64>)> {
    let name = || input_name(path);
    let advice = format!("give {option} {TABLE_FILE}, or - for CSV from standard input");
    if is_dash(path) {
        let records = TableRecords::from_stream(io::stdin().lock()).with_context(name)?;
        return Ok((records, None));
    }
    let (metadata, file) = File::open(path)
        .and_then(|file| Ok((file.metadata()?, file)))
        .map_err(|error| anyhow!("{error}; {advice}"))
        .with_context(name)?;
    if metadata.is_dir() {
        bail!("{}: is a folder; {advice}", name());
    }
    let length = metadata.is_file().then_some(metadata.len());
    let records = TableRecords::from_file(file).with_context(name)?;
    Ok((records, length))
}

/// The formats of tables that this build reads from a file.
const TABLE_FILE: &str = if cfg!(feature = "parquet") {
    "a CSV or Parquet file"
} else {
    "a CSV file"
};

/// Returns the name that messages give to an input: its path, or standard input.
pub fn input_name(path: &Path) -> String {
    if is_dash(path) {
        "standard input".to_owned()
    } else {
        path.display().to_string()
    }
}

/// Returns whether two paths refer to the same file, which need not exist.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    a == b || real_path(a).is_some_and(|a| Some(a) == real_path(b))
}

fn real_path(path: &Path) -> Option<PathBuf> {
    let path_of_missing_file = || {
        let path = resolve_links(path).ok()?;
        let folder = fs::canonicalize(folder_to_open(path.parent()?)).ok()?;
        Some(folder.join(path.file_name()?))
    };
    fs::canonicalize(path).ok().or_else(path_of_missing_file)
}
