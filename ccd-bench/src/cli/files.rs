//! Tables in and out: files, or the standard streams.

use super::{CannotWrite, same_file};
use crate::motions::MotionTable;
use anyhow::{Context, Result, anyhow, bail};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// A table that is to be written once the work is done.
pub(super) struct Output {
    name: String,
    writer: Box<dyn Write>,
}

impl Output {
    pub(super) fn open(path: &Path) -> Result<Self, CannotWrite> {
        if is_standard(path) {
            return Ok(Output {
                name: "standard output".to_owned(),
                writer: Box::new(io::stdout().lock()),
            });
        }
        let name = path.display().to_string();
        match File::create(path) {
            Ok(file) => Ok(Output {
                name,
                writer: Box::new(BufWriter::new(file)),
            }),
            Err(source) => Err(CannotWrite {
                place: name,
                source,
            }),
        }
    }

    /// Writes the whole table.
    pub(super) fn write(
        self,
        table: impl FnOnce(Box<dyn Write>) -> Result<(), csv::Error>,
    ) -> Result<(), CannotWrite> {
        table(self.writer).map_err(|error| CannotWrite {
            place: self.name,
            source: match error.into_kind() {
                csv::ErrorKind::Io(error) => error,
                other => io::Error::other(format!("{other:?}")),
            },
        })
    }
}

/// Refuses to have two options name one file, of which the second one is written to.
pub(super) fn refuse_overwriting(
    (read, source): (&str, &Path),
    (written, target): (&str, &Path),
) -> Result<()> {
    if !is_standard(target) && same_file(source, target) {
        bail!("{written} names the file of {read}, which it would overwrite; give it another");
    }
    Ok(())
}

/// The table of motions, of which `--motions` names the file.
pub(super) fn read_motions(path: &Path) -> Result<MotionTable> {
    let table = if is_standard(path) {
        MotionTable::read(io::stdin().lock())
    } else {
        let file = File::open(path).map_err(|error| {
            anyhow!("{error}; give --motions a CSV file, or - for standard input")
        });
        MotionTable::read(io::BufReader::new(file.with_context(|| input_name(path))?))
    };
    table.with_context(|| input_name(path))
}

/// What messages call a file that is read.
pub(super) fn input_name(path: &Path) -> String {
    match is_standard(path) {
        true => "standard input".to_owned(),
        false => path.display().to_string(),
    }
}

pub(super) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}
