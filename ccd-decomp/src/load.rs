//! Loads bodies from files: meshes, parts of meshes, and stored bodies.

pub(crate) mod error;
pub(crate) mod mesh_source;

use crate::file::has_stored_body_extension;
use crate::mesh::adjustments::Adjustments;
use crate::prepare::PieceChoice;
use crate::prepare::model::{PreparedBody, StoredBodyContent};
use error::{AdjustedStoredBody, BodyError};
use mesh_source::MeshSource;
use std::path::Path;

/// Loads the body in a file: a mesh, all parts of it as one body, or a [stored](StoredBodyContent::save) body. The
/// choice applies to meshes only.
///
/// The coordinates of a mesh file that states its unit are [converted](crate::MeshFile::converted_to_unit) to the
/// target unit of the adjustments. Those of a stored body are taken to be in that unit.
///
/// # Errors
/// [`BodyError`], which names the file. A stored body takes no adjustment but a target unit.
///
/// ```
/// use ccd_decomp::{Adjustments, BodyError, PieceChoice, load_body};
/// let missing = load_body("no/such/part.stl", &Adjustments::NONE, PieceChoice::Auto);
/// assert!(matches!(missing, Err(BodyError::Mesh(_))));
/// ```
pub fn load_body(
    file: impl AsRef<Path>,
    adjustments: &Adjustments,
    choice: PieceChoice,
) -> Result<PreparedBody, BodyError> {
    let file = file.as_ref();
    if has_stored_body_extension(file) {
        load_stored_body(file, adjustments)
    } else {
        let source = MeshSource {
            file: file.into(),
            part: None,
            adjustments: *adjustments,
        };
        source.load(choice)
    }
}

/// Loads a stored body, whatever the name of its file.
pub(crate) fn load_stored_body(
    file: &Path,
    adjustments: &Adjustments,
) -> Result<PreparedBody, BodyError> {
    if adjustments.has_mesh_only_adjustment() {
        return Err(AdjustedStoredBody { file: file.into() }.into());
    }
    match StoredBodyContent::load(file)?.into_prepared_body() {
        Ok(prepared) => Ok(PreparedBody {
            unit: adjustments.target_unit,
            ..prepared
        }),
        Err(error) => Err(BodyError::FileContent {
            file: file.into(),
            error,
        }),
    }
}

#[cfg(test)]
mod tests;
