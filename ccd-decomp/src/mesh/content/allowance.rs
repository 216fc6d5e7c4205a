//! How much a file may ask for: a limit to what a few bytes can make by naming the same things again and again.

use crate::mesh::error::MeshFault;
use crate::tolerance::{REPEATED, REPEATED_AT_MOST, REPEATED_PER_BYTE};

/// The vertices, corners and placements that may still be made of a file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Allowance {
    left: u64,
    all: u64,
}

impl Allowance {
    /// The allowance of a file of so many bytes.
    pub(crate) fn of(bytes: u64) -> Self {
        let repeated = REPEATED.saturating_add(bytes.saturating_mul(REPEATED_PER_BYTE));
        let all = bytes.saturating_add(repeated.min(REPEATED_AT_MOST));
        Allowance { left: all, all }
    }

    /// Takes so many elements of it.
    pub(crate) fn take(&mut self, count: u64) -> Result<(), MeshFault> {
        match self.left.checked_sub(count) {
            Some(left) => {
                self.left = left;
                Ok(())
            }
            None => Err(MeshFault::Repeats { limit: self.all }),
        }
    }
}
