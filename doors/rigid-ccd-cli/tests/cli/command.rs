//! Runs the command in tests, and reads its output.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// A call of the command with its arguments and input.
pub(crate) struct CommandCall {
    args: Vec<String>,
    stdin: String,
    folder: PathBuf,
}

impl CommandCall {
    pub(crate) fn with_args(args: &[&str]) -> Self {
        let run = CommandCall {
            args: Vec::new(),
            stdin: String::new(),
            folder: ".".into(),
        };
        run.args(args)
    }

    pub(crate) fn args(mut self, args: &[&str]) -> Self {
        self.args.extend(args.iter().map(|&arg| arg.to_owned()));
        self
    }

    pub(crate) fn stdin(mut self, text: &str) -> Self {
        self.stdin = text.to_owned();
        self
    }

    /// Sets the working folder of the call.
    #[allow(dead_code, reason = "ccd-bench's tests share this file without it")]
    pub(crate) fn folder(self, folder: &Path) -> Self {
        let folder = folder.to_owned();
        CommandCall { folder, ..self }
    }

    pub(crate) fn output(&self) -> Output {
        let mut child = Command::new(crate::PROGRAM_PATH)
            .args(&self.args)
            .current_dir(&self.folder)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        // A command that fails early does not read its input.
        let _ = child.stdin.take().unwrap().write_all(self.stdin.as_bytes());
        child.wait_with_output().unwrap()
    }

    /// Runs the command, checks that it ends with the exit code `code`, and returns its output.
    #[track_caller]
    pub(crate) fn run_expecting_code(&self, code: i32) -> Output {
        let output = self.output();
        let found = output.status.code();
        assert_eq!(found, Some(code), "{:?}: {}", self.args, stderr(&output));
        output
    }

    /// Runs the command, checks that it ends with the exit code `code`, and returns its messages.
    #[track_caller]
    #[allow(dead_code, reason = "ccd-bench's tests share this file without it")]
    pub(crate) fn run_for_messages(&self, code: i32) -> String {
        stderr(&self.run_expecting_code(code))
    }

    #[track_caller]
    pub(crate) fn run_for_rows(&self) -> Vec<Row> {
        parse(&self.run_expecting_code(0).stdout)
    }
}

/// Checks that a text contains the given words.
#[track_caller]
#[allow(dead_code, reason = "ccd-bench's tests share this file without it")]
pub(crate) fn assert_contains(text: &str, words: &str) {
    assert!(text.contains(words), "{words:?} is not in:\n{text}");
}

/// One row of a table of results: pairs of a column's name and its cell.
pub(crate) struct Row(pub(crate) Vec<(String, String)>);

impl Row {
    pub(crate) fn text(&self, column: &str) -> &str {
        let cell = self.0.iter().find(|(name, _)| name == column);
        &cell.unwrap_or_else(|| panic!("no column {column}")).1
    }

    pub(crate) fn number(&self, column: &str) -> f64 {
        let text = self.text(column);
        text.parse()
            .unwrap_or_else(|_| panic!("{column}: {text:?}"))
    }
}

pub(crate) fn parse(table: &[u8]) -> Vec<Row> {
    let mut reader = csv::Reader::from_reader(table);
    let names: Vec<String> = reader
        .headers()
        .unwrap()
        .iter()
        .map(str::to_owned)
        .collect();
    let row = |record: csv::StringRecord| {
        let cells = record.iter().map(str::to_owned);
        Row(names.iter().cloned().zip(cells).collect())
    };
    reader
        .records()
        .map(|record| row(record.unwrap()))
        .collect()
}

pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// A directory for one test's files. It is removed at the end of the test.
pub(crate) struct Scene {
    pub(crate) directory: PathBuf,
    _temp_dir: TempDir,
}

impl Scene {
    pub(crate) fn new(name: &str) -> Self {
        // Cases of one test run at the same time, and each has a directory of its own.
        let held = tempfile::Builder::new().prefix(name).tempdir().unwrap();
        Scene {
            directory: held.path().to_owned(),
            _temp_dir: held,
        }
    }

    pub(crate) fn file(&self, name: &str, text: &str) -> PathBuf {
        self.write_bytes(name, text.as_bytes())
    }

    pub(crate) fn write_bytes(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.directory.join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    }
}
