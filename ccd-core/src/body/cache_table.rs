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
pub(crate) struct CacheTable(OnceLock<Box<Column>>);

struct Column {
    /// The column's entries: a `Vec<OnceLock<T>>` for some type `T`.
    entries: Box<dyn Any + Send + Sync>,
    /// The rest of the linked list: the columns for other types of values.
    other_columns: CacheTable,
}

impl CacheTable {
    /// Returns the entry for the value of type `T` of the piece `index`; `len` is the number of pieces.
    #[inline]
    pub(crate) fn entry<T: Any + Send + Sync>(&self, len: usize, index: usize) -> &OnceLock<T> {
        let mut cache_table = self;
        loop {
            let column = cache_table.0.get_or_init(|| {
                let entries: Vec<OnceLock<T>> = (0..len).map(|_| OnceLock::new()).collect();
                Box::new(Column {
                    entries: Box::new(entries),
                    other_columns: CacheTable::default(),
                })
            });
            if let Some(entries) = column.entries.downcast_ref::<Vec<OnceLock<T>>>() {
                return &entries[index];
            }
            cache_table = &column.other_columns;
        }
    }
}

impl Clone for CacheTable {
    fn clone(&self) -> Self {
        CacheTable::default()
    }
}

impl fmt::Debug for CacheTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SideTable").finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests;
