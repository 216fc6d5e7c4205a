//! Errors of preparing a mesh.

use crate::hull::HullError;
use crate::solid::error::DecomposeError;
use crate::tree::hull_tree::HullTreeBuildError;
use ccd_core::{HullTreeError, InputError};

/// The reason why no body can be made of a mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PrepareError {
    /// The mesh cannot be decomposed exactly into the requested pieces.
    #[error(transparent)]
    Decompose(#[from] DecomposeError),
    /// The convex hull of the mesh cannot be computed: a vertex is out of range.
    #[error(transparent)]
    Hull(#[from] HullError),
    /// The hull tree over the pieces cannot be built.
    #[error(transparent)]
    BuildHullTree(#[from] HullTreeBuildError),
    /// The hull tree does not fit the pieces of the body.
    #[error(transparent)]
    HullTree(#[from] HullTreeError),
    /// The constructors of `ccd_core` reject the pieces.
    #[error(transparent)]
    Input(#[from] InputError),
}
