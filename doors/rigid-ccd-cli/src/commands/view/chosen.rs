//! Chooses the rows to draw on a page.

use ccd_tables::movements::Movements;
use ccd_tables::results::{ResultRow, Status};

/// The maximum number of rows of each status on a page, if no ids are given.
const MAX_ROWS_PER_STATUS: usize = 4;
/// The maximum number of rows on a page in total.
const MAX_ROWS: usize = 100;

/// The rows chosen for a page so far, and the rule by which they are chosen.
#[derive(Debug, Default)]
pub(crate) struct ChosenRows {
    /// The ids of the rows to show; if empty, a few rows of each status are shown.
    ids: Vec<String>,
    rows: Vec<(Movements, ResultRow)>,
    /// The number of rows that cannot be drawn.
    undrawable_count: usize,
    /// The message about the first row that cannot be drawn.
    first_message: Option<String>,
}

impl ChosenRows {
    /// Starts the choice of rows: the rows with these ids or, without ids, a few rows of each status.
    pub(crate) fn new(ids: Vec<String>) -> Self {
        ChosenRows {
            ids,
            ..ChosenRows::default()
        }
    }

    /// Returns whether an id is one of the given ids; `None` if none are given.
    pub(super) fn is_requested(&self, id: &str) -> Option<bool> {
        let is_one_of_them = || self.ids.iter().any(|given_id| given_id == id);
        (!self.ids.is_empty()).then(is_one_of_them)
    }

    /// Adds a row if its id is one of the given ids or, without ids, if few rows of its status have been added.
    pub(crate) fn add_if_wanted(&mut self, movements: &Movements, row: &ResultRow) {
        let is_wanted = self.is_requested(&row.id).unwrap_or_else(|| {
            let same_status = self
                .rows
                .iter()
                .filter(|(_, chosen)| chosen.status == row.status);
            same_status.count() < MAX_ROWS_PER_STATUS
        });
        if row.status == Status::Error {
            if self.is_requested(&row.id) != Some(false) {
                let reason = row.reason.as_deref().unwrap_or("not answered");
                self.note_undrawable_row(format!("row {}: {reason}", row.id));
            }
        } else if is_wanted && !self.needs_no_more_rows() {
            self.rows.push((movements.clone(), row.clone()));
        }
    }

    /// Returns whether no further row is needed: the page is full, or every given id has a row.
    pub(super) fn needs_no_more_rows(&self) -> bool {
        self.rows.len() >= MAX_ROWS
            || (!self.ids.is_empty() && self.ids_without_row().next().is_none())
    }

    /// Returns the given ids for which no row has been added.
    pub(super) fn ids_without_row(&self) -> impl Iterator<Item = &str> {
        let has_row = |id: &&String| self.rows.iter().any(|(_, row)| row.id == **id);
        self.ids
            .iter()
            .filter(move |id| !has_row(id))
            .map(String::as_str)
    }

    /// Removes the chosen rows, and returns them in the order in which they were added.
    pub(super) fn take_rows(&mut self) -> Vec<(Movements, ResultRow)> {
        std::mem::take(&mut self.rows)
    }

    /// Counts a row that cannot be drawn; `fault` is the message about it.
    pub(super) fn note_undrawable_row(&mut self, message: String) {
        self.undrawable_count += 1;
        self.first_message.get_or_insert(message);
    }

    /// Returns whether no row has been added, nor counted as one that cannot be drawn.
    pub(super) fn is_empty(&self) -> bool {
        self.rows.is_empty() && self.undrawable_count == 0
    }

    /// Returns whether no row has been counted as one that cannot be drawn.
    pub(super) fn are_all_rows_drawable(&self) -> bool {
        self.undrawable_count == 0
    }

    /// Describes the chosen rows that could not be drawn; `None` if there are none.
    pub(super) fn describe_faults(&self) -> Option<String> {
        let message = self.first_message.as_ref()?;
        Some(match self.undrawable_count {
            1 => format!("one row is no valid query, and is not shown: {message}"),
            count => {
                format!(
                    "{count} rows are no valid queries, and are not shown; the first: {message}"
                )
            }
        })
    }
}
