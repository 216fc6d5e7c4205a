//! The wide tree over a body's pieces.

use crate::error::InputError;
use crate::hierarchy::Hierarchy;
use crate::piece::Pieces;

/// WIP
#[derive(Clone, Debug)]
pub(crate) struct Tree;
impl Tree {
    pub(crate) fn build(_pieces: &Pieces, _hierarchy: &Hierarchy) -> Result<(Tree, Vec<u32>), InputError> {
        Ok((Tree, (0.._pieces.len() as u32).collect()))
    }
    pub(crate) fn bytes(&self) -> usize {0}
}
