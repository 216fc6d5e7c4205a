//! The budget for the expansion of a file, which limits how many elements a small file can produce by repeated
//! references.

use crate::mesh::error::MeshFault;
use crate::tolerance::{
    BASE_FILE_EXPANSION_LIMIT, EXPANSION_LIMIT_PER_BYTE, MAX_EXPANDED_ELEMENT_COUNT,
    VERTEX_EXPANSION_COST,
};

/// The budget of vertices and face corners that a file may expand to. A corner costs 1, a vertex more.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ExpansionBudget {
    remaining_budget: u64,
    limit: u64,
}

/// Returns what so many vertices and face corners take from the allowance of a file.
pub(crate) fn expansion_cost(vertices: u64, corners: u64) -> u64 {
    vertices
        .saturating_mul(VERTEX_EXPANSION_COST)
        .saturating_add(corners)
}

impl ExpansionBudget {
    /// Returns the budget of a file of `bytes` bytes: an amount per byte for what the file contains once, plus a capped
    /// amount for repeated references.
    pub(crate) fn for_file(bytes: u64) -> Self {
        // Without repetition, a byte costs at most 4: a corner of a strip may take one byte, is read as a number, and
        // makes a triangle of three corners.
        let once = bytes.saturating_mul(4);
        let repeated = BASE_FILE_EXPANSION_LIMIT
            .saturating_add(bytes.saturating_mul(EXPANSION_LIMIT_PER_BYTE));
        let limit = once.saturating_add(repeated.min(MAX_EXPANDED_ELEMENT_COUNT));
        ExpansionBudget {
            remaining_budget: limit,
            limit,
        }
    }

    /// Spends a cost from the budget; returns an error if too little is left.
    pub(crate) fn spend(&mut self, cost: u64) -> Result<(), MeshFault> {
        let left = self.remaining_budget.checked_sub(cost);
        let limit = self.limit;
        self.remaining_budget = left.ok_or(MeshFault::TooManyRepeats { limit })?;
        Ok(())
    }
}
