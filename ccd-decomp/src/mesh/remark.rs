//! Remarks of readers: content that was skipped or changed.

use super::error::Quote;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The content of a file that a reader skipped or changed: kinds of elements, each with a count.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Remarks(Vec<Remark>);

/// One kind of elements.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Remark {
    /// The kind of elements and their treatment, such as `lines passed over`.
    pub what: String,
    /// Their number.
    pub count: usize,
    /// The line of the first one, in a text.
    pub line: Option<usize>,
}

/// The maximum number of kinds listed separately, to keep the report short.
const KINDS: usize = 8;

impl Remarks {
    /// The remarks, in the order in which they were first made.
    pub fn iter(&self) -> std::slice::Iter<'_, Remark> {
        self.0.iter()
    }

    /// Returns whether the file was read completely and unchanged.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds elements of a kind.
    pub(crate) fn add(&mut self, what: &str, count: usize, line: Option<usize>) {
        let full = self.0.len() >= KINDS;
        match self.0.iter_mut().find(|remark| remark.what == what) {
            Some(remark) => remark.count += count,
            None if full && what != OTHERS => self.add(OTHERS, count, line),
            None => self.0.push(Remark {
                what: what.to_owned(),
                count,
                line,
            }),
        }
    }

    /// Adds elements of a kind with a name in the file.
    pub(crate) fn add_named(&mut self, kind: &str, name: &str, count: usize, line: Option<usize>) {
        let what = format!("{kind} {:?} passed over", Quote(name));
        self.add(&what, count, line);
    }

    /// Adds the remarks about another file.
    pub(crate) fn append(&mut self, other: &Self) {
        for Remark { what, count, .. } in other.iter() {
            self.add(what, *count, None);
        }
    }
}

/// The kind of all elements beyond [`KINDS`].
const OTHERS: &str = "others passed over";

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
        for (k, remark) in self.iter().enumerate() {
            write!(f, "{}{remark}", if k == 0 { "" } else { "; " })?;
        }
        Ok(())
    }
}
