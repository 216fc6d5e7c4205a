//! Counts of elements in reports, with the first few elements.

use serde::{Deserialize, Serialize};
use std::fmt;

/// The number of elements of some kind, and the first few of them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct CountWithExamples<T> {
    count: usize,
    first: Vec<T>,
}

/// The maximum number of stored elements, to keep reports short.
const MAX_STORED_ELEMENTS: usize = 8;

impl<T> CountWithExamples<T> {
    /// Returns the number of elements that were counted.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Returns the first counted elements, at most eight.
    pub fn first_elements(&self) -> &[T] {
        &self.first
    }

    /// Returns whether no element was counted.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    pub(crate) fn add(&mut self, element: T) {
        self.count += 1;
        if self.first.len() < MAX_STORED_ELEMENTS {
            self.first.push(element);
        }
    }
}

impl CountWithExamples<u32> {
    /// Adds the element numbers of another tally, each increased by `first`.
    pub(crate) fn append(&mut self, other: &Self, first: u32) {
        let room = MAX_STORED_ELEMENTS - self.first.len();
        let numbers = other.first.iter().map(|number| first + number);
        self.first.extend(numbers.take(room));
        self.count += other.count;
    }
}

impl<T> Default for CountWithExamples<T> {
    fn default() -> Self {
        CountWithExamples {
            count: 0,
            first: Vec::new(),
        }
    }
}

impl<T: fmt::Display> fmt::Display for CountWithExamples<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut named: Vec<String> = self.first.iter().map(T::to_string).collect();
        named.extend((named.len() < self.count).then(|| "…".into()));
        match (self.count, named.join(", ")) {
            (0, _) => write!(f, "0"),
            (count, named) => write!(f, "{count} ({named})"),
        }
    }
}
