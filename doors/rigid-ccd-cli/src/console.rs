//! Messages, progress, and the outcome of a run.

pub(crate) mod causes;
pub(crate) mod interruption;
pub(crate) mod printable;
pub(crate) mod progress;
pub(crate) mod standard_output;

pub use progress::{Progress, TotalWork};

use printable::PrintableText;
use std::fmt::Display;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The outcome of a run that wrote all its output. Of two outcomes, the greater one decides the exit code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum RunOutcome {
    /// Every row has an answer.
    AllAnswered,
    /// Every row has an answer, but something is not proven. With `--check` a row is not `free` or `kept`, a required
    /// clearance is violated or unverified, a proof does not hold, or a signal ended the search for link contacts.
    SomeRowsUnproven,
    /// Some rows could not be read, answered or drawn; all others are done.
    SomeRowsBad,
}

/// Writes a message to standard error, after the program's name.
pub fn print_error(message: &str) {
    print_escaped_to_stderr(&format!("{}: {message}", program_name()));
}

/// Writes a line to standard error, with control characters escaped. So a cell or a file name in the line cannot move
/// the cursor, change colours or end the line.
pub(crate) fn print_escaped_to_stderr(line: &str) {
    // A message that cannot be written is not a failure.
    let _ = writeln!(io::stderr(), "{}", PrintableText(line));
}

/// Prints remarks about the input, one line for each.
pub(crate) fn print_remarks(remarks: impl IntoIterator<Item: Display>) {
    for remark in remarks {
        print_error(&remark.to_string());
    }
}

/// Returns the name of this program without its folder and extension.
fn program_name() -> String {
    let path = std::env::args_os().next().map(PathBuf::from);
    let name = path.as_deref().and_then(Path::file_stem);
    name.map_or("ccd".into(), |name| name.to_string_lossy().into_owned())
}
