//! How many there are of something, and which came first.

use serde::{Deserialize, Serialize};
use std::fmt;

/// How many elements something is true of, and the first of them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally<T> {
    count: usize,
    first: Vec<T>,
}

/// As many as a report can name before it becomes a list nobody reads.
const NAMED: usize = 8;

impl<T> Tally<T> {
    /// How many.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The first of them, at most eight, in the order they were met.
    pub fn first(&self) -> &[T] {
        &self.first
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    pub(crate) fn add(&mut self, element: T) {
        self.count += 1;
        if self.first.len() < NAMED {
            self.first.push(element);
        }
    }
}

impl<T> Default for Tally<T> {
    fn default() -> Self {
        Tally {
            count: 0,
            first: Vec::new(),
        }
    }
}

impl<T: fmt::Display> fmt::Display for Tally<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.count)?;
        for (k, element) in self.first.iter().enumerate() {
            write!(f, "{}{element}", if k == 0 { " (" } else { ", " })?;
        }
        match (self.first.len(), self.count) {
            (0, _) => Ok(()),
            (named, count) if named < count => write!(f, ", …)"),
            _ => write!(f, ")"),
        }
    }
}
