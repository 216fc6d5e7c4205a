//! A table of cached values of any type for each piece of a list.

use std::any::Any;
use std::fmt;
use std::sync::OnceLock;

/// A table of cached values with a row per piece and a column per type of value, as a linked list of columns. A column
/// has an entry for each piece, computed when first requested.
///
/// The table lives as long as the pieces, and is shared by all threads that share them. A copy of the pieces starts
/// with an empty table.
#[derive(Default)]
pub(crate) struct SideTable(OnceLock<Box<Column>>);

struct Column {
    /// The column's entries: a `Vec<OnceLock<T>>` for some type `T`.
    entries: Box<dyn Any + Send + Sync>,
    /// The rest of the linked list: the columns for other types of values.
    other_columns: SideTable,
}

impl SideTable {
    /// Returns the entry for the value of type `T` of the piece `index`; `len` is the number of pieces.
    #[inline]
    pub(crate) fn entry<T: Any + Send + Sync>(&self, len: usize, index: usize) -> &OnceLock<T> {
        let mut side_table = self;
        loop {
            let column = side_table.0.get_or_init(|| {
                let entries: Vec<OnceLock<T>> = (0..len).map(|_| OnceLock::new()).collect();
                Box::new(Column {
                    entries: Box::new(entries),
                    other_columns: SideTable::default(),
                })
            });
            if let Some(entries) = column.entries.downcast_ref::<Vec<OnceLock<T>>>() {
                return &entries[index];
            }
            side_table = &column.other_columns;
        }
    }
}

impl Clone for SideTable {
    fn clone(&self) -> Self {
        SideTable::default()
    }
}

impl fmt::Debug for SideTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SideTable").finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests;
