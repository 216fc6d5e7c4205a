//! Errors of preparing a mesh.

use crate::pieces::vhacd::VhacdError;
use crate::solid::error::DecomposeError;
use crate::tree::hull_tree::BuildError;
use ccd_core::{HullTreeError, InputError};

/// The reason why a mesh cannot be made into a body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PrepareError {
    /// The mesh cannot be decomposed into the requested pieces.
    #[error(transparent)]
    Decompose(#[from] DecomposeError),
    /// The mesh cannot be approximated.
    #[error(transparent)]
    Vhacd(#[from] VhacdError),
    /// No hull tree can be built.
    #[error(transparent)]
    BuildHullTree(#[from] BuildError),
    /// The hull tree does not match the pieces.
    #[error(transparent)]
    HullTree(#[from] HullTreeError),
    /// The core rejects the pieces.
    #[error(transparent)]
    Input(#[from] InputError),
}
