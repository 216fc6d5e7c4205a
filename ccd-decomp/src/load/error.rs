//! Errors of loading bodies.

use crate::file::error::StoreError;
use crate::mesh::error::MeshError;
use crate::prepare::error::PrepareError;
use ccd_core::InputError;
use std::path::PathBuf;

/// The reason why a body cannot be loaded.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BodyError {
    /// The mesh file cannot be read.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The file of the stored body cannot be loaded.
    #[error(transparent)]
    UnloadableStoredBody(#[from] StoreError),
    /// A stored body is to be adjusted.
    #[error(transparent)]
    AdjustedStoredBody(#[from] AdjustedStoredBody),
    /// The constructors of `ccd_core` reject the shape, or a factor.
    #[error(transparent)]
    InvalidShape(#[from] InputError),
    /// No body can be made of the mesh.
    #[error(transparent)]
    Prepare(#[from] PrepareError),
    /// No body can be made of the content of a file.
    #[error("{}: {error}", .file.display())]
    FileContent {
        /// The path of the file whose content is at fault.
        file: PathBuf,
        /// The reason why no body can be made.
        error: PrepareError,
    },
}

/// The error for adjustments of a stored body. They apply to meshes only.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}: {PREPARED_BODY_ADVICE}", .file.display())]
pub struct AdjustedStoredBody {
    /// The path of the file of the stored body.
    pub file: PathBuf,
}

const PREPARED_BODY_ADVICE: &str = "a prepared body has its unit, size and pieces already; use the mesh it was made from, or \
                        prepare it with the adjustments";
