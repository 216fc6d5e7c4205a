//! Values that backends store with the pieces.

use std::any::Any;
use std::fmt;
use std::sync::OnceLock;

/// A table of values: one list for every requested type. Each list has an entry for each piece, computed at its first
/// request.
///
/// The table lives as long as the pieces, and is shared by all threads that share them. A copy of the pieces starts
/// with an empty table.
#[derive(Default)]
pub(crate) struct SideTable(OnceLock<Box<Column>>);

struct Column {
    /// A `Vec<OnceLock<T>>` of some type `T`.
    entries: Box<dyn Any + Send + Sync>,
    /// The columns of other types.
    next: SideTable,
}

impl SideTable {
    /// Returns the entry of one of `len` pieces.
    #[inline]
    pub(crate) fn entry<T: Any + Send + Sync>(&self, len: usize, index: usize) -> &OnceLock<T> {
        let mut side_table = self;
        loop {
            let column = side_table.0.get_or_init(|| Box::new(Column::of::<T>(len)));
            if let Some(entries) = column.entries.downcast_ref::<Vec<OnceLock<T>>>() {
                return &entries[index];
            }
            side_table = &column.next;
        }
    }
}

impl Column {
    fn of<T: Any + Send + Sync>(len: usize) -> Self {
        let entries: Vec<OnceLock<T>> = (0..len).map(|_| OnceLock::new()).collect();
        Column {
            entries: Box::new(entries),
            next: SideTable::default(),
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
