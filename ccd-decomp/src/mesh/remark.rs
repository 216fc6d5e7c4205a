//! Remarks of mesh readers about content that was skipped or changed.

use super::error::quoted;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The content of a file that a reader skipped or changed: kinds of elements, each with a count.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Remarks(Vec<Remark>);

/// A remark that elements of one kind were skipped or changed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Remark {
    /// The kind of elements and their treatment, such as `lines passed over`.
    pub what: String,
    /// The number of elements of this kind.
    pub count: usize,
    /// The line number of the first element, if the format is text.
    pub line: Option<usize>,
}

/// What the remark on vertices says that have a fourth number other than 1, which divides their coordinates.
pub const DIVIDED_VERTICES: &str = "vertices divided by their fourth number";

/// The maximum number of kinds of elements that have a remark of their own, to keep the report short.
const MAX_REMARKED_KINDS: usize = 8;

impl Remarks {
    /// Iterates over the remarks, in the order in which they were first made.
    pub fn iter(&self) -> std::slice::Iter<'_, Remark> {
        self.0.iter()
    }

    /// Returns whether the file was read completely and unchanged.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds `count` elements to the remark about `what`, which is created if it is missing. A count of 0 adds nothing.
    pub(crate) fn add(&mut self, what: &str, count: usize, line: Option<usize>) {
        let full = self.0.len() >= MAX_REMARKED_KINDS;
        match self.0.iter_mut().find(|remark| remark.what == what) {
            _ if count == 0 => {}
            Some(remark) => remark.count += count,
            None if full && what != OTHER_KINDS_TEXT => self.add(OTHER_KINDS_TEXT, count, line),
            None => self.0.push(Remark {
                what: what.to_owned(),
                count,
                line,
            }),
        }
    }

    /// Adds `count` skipped elements to the remark about their kind and their name in the file.
    pub(crate) fn add_skipped(
        &mut self,
        kind: &str,
        name: &str,
        count: usize,
        line: Option<usize>,
    ) {
        let what = format!("{kind} {} passed over", quoted(name));
        self.add(&what, count, line);
    }

    /// Adds the counts of the remarks about another file, without its line numbers.
    pub(crate) fn add_counts(&mut self, other: &Self) {
        for Remark { what, count, .. } in other.iter() {
            self.add(what, *count, None);
        }
    }
}

/// The text of the remark that counts all kinds of elements beyond the first [`MAX_REMARKED_KINDS`].
const OTHER_KINDS_TEXT: &str = "others passed over";

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.what, self.count)?;
        match (self.line, self.count) {
            (None, _) => Ok(()),
            (Some(line), 1) => write!(f, " (line {line})"),
            (Some(line), _) => write!(f, " (from line {line} on)"),
        }
    }
}

impl fmt::Display for Remarks {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let all: Vec<String> = self.iter().map(Remark::to_string).collect();
        f.write_str(&all.join("; "))
    }
}
