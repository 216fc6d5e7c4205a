//! How much a file may ask for: a limit to what a few bytes can make by naming the same things again and again.

use crate::mesh::error::MeshFault;
use crate::tolerance::{REPEATED, REPEATED_AT_MOST, REPEATED_PER_BYTE, VERTEX_COST};

/// What may still be made of a file. A corner costs one, and a vertex more.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Allowance {
    left: u64,
    all: u64,
}

/// The cost of so many vertices and corners.
pub(crate) fn cost(vertices: u64, corners: u64) -> u64 {
    vertices.saturating_mul(VERTEX_COST).saturating_add(corners)
}

impl Allowance {
    /// The allowance of a file of so many bytes.
    pub(crate) fn of(bytes: u64) -> Self {
        // What is named once costs no more than this: a corner of a strip may be of one byte, makes a triangle, and is
        // a number first.
        let once = bytes.saturating_mul(4);
        let repeated = REPEATED.saturating_add(bytes.saturating_mul(REPEATED_PER_BYTE));
        let all = once.saturating_add(repeated.min(REPEATED_AT_MOST));
        Allowance { left: all, all }
    }

    /// Takes a cost off it.
    pub(crate) fn take(&mut self, cost: u64) -> Result<(), MeshFault> {
        match self.left.checked_sub(cost) {
            Some(left) => {
                self.left = left;
                Ok(())
            }
            None => Err(MeshFault::Repeats { limit: self.all }),
        }
    }
}
