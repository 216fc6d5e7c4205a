//! Loads bodies from files.

use ccd_core::Body;
use ccd_decomp::{
    Adjustments, BodyError, MeshFile, NamedMesh, PieceChoice, Unit, body_from_mesh, load_body,
};
use std::path::Path;

/// Loads a body from a mesh file (OBJ, STL, PLY, OFF; glTF and COLLADA with the features `gltf` and `collada`) or a prepared body (`.ccd`).
///
/// Coordinates keep the [unit of the file](MeshFile::unit). All parts of a file make one body: [`load_parts`] makes one of each.
/// A mesh becomes the fewest convex pieces that are exact: one hull, convex patches or triangles
/// ([`PieceChoice::Auto`]). To choose the pieces, or to get a report of defects, use
/// [`mesh::body_from_mesh`](ccd_decomp::body_from_mesh).
///
/// # Errors
/// The file cannot be read, or holds no valid mesh; the error names the file and the element.
///
/// ```
/// let part = rigid_ccd::load("examples/bracket.obj")?;
/// assert_eq!(part.solidity(), rigid_ccd::body::Solidity::Solid);
/// # Ok::<(), rigid_ccd::Error>(())
/// ```
pub fn load(path: impl AsRef<Path>) -> Result<Body, BodyError> {
    load_adjusted(path, &Adjustments::NONE)
}

/// Loads a body as [`load`] does, with coordinates converted to a unit. A file that [states its
/// unit](MeshFile::unit), as glTF and COLLADA do, is [converted](MeshFile::converted_to_unit); the coordinates of others are taken
/// to be in the unit already.
///
/// # Errors
/// Those of [`load`].
///
/// ```
/// use rigid_ccd::{load_in_unit, mesh::Unit};
/// let part = load_in_unit("examples/bracket.obj", Unit::Millimetre)?;
/// # Ok::<(), rigid_ccd::Error>(())
/// ```
pub fn load_in_unit(path: impl AsRef<Path>, unit: Unit) -> Result<Body, BodyError> {
    load_adjusted(path, &Adjustments::NONE.with_target_unit(unit))
}

/// Loads a body as [`load`] does, with adjustments of its mesh: unit, scale factor, mirror, or a closed mesh taken as a
/// hollow surface.
///
/// # Errors
/// Those of [`load`]. A prepared body is refused: it stays as it is.
///
/// ```
/// use rigid_ccd::{load_adjusted, mesh::{Adjustments, Axis}};
/// let half = Adjustments::default().scaled(0.5)?.mirrored(Axis::X);
/// let part = load_adjusted("examples/bracket.obj", &half)?;
/// # let whole = rigid_ccd::load("examples/bracket.obj")?;
/// # assert!((part.bounding_radius() / whole.bounding_radius() - 0.5).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn load_adjusted(path: impl AsRef<Path>, adjustments: &Adjustments) -> Result<Body, BodyError> {
    Ok(load_body(path, adjustments, PieceChoice::Auto)?.body)
}

/// Loads each part of a mesh file as a body, with its name or, without one, its number from 0. Parts are the nodes with
/// meshes of a glTF, the objects or groups of an OBJ. Any other mesh is one part.
///
/// Vertices and faces are numbered from 0 in each part. To convert units, or to load one part, use
/// [`mesh::MeshFile`](MeshFile).
///
/// # Errors
/// The file cannot be read, or a part is no valid mesh; the error names the file, the part and the element.
///
/// ```
/// let parts = rigid_ccd::load_parts("examples/bracket.obj")?;
/// let names: Vec<&str> = parts.iter().map(|(name, _)| name.as_str()).collect();
/// assert_eq!(names, ["bracket"]);
/// # Ok::<(), rigid_ccd::Error>(())
/// ```
pub fn load_parts(path: impl AsRef<Path>) -> Result<Vec<(String, Body)>, BodyError> {
    let path = path.as_ref();
    let parts = MeshFile::read(path)?.into_parts()?.into_iter();
    let loaded = parts.enumerate().map(|(number, NamedMesh { name, mesh })| {
        let name = name.unwrap_or_else(|| number.to_string());
        let prepared =
            body_from_mesh(&mesh, PieceChoice::Auto).map_err(|error| BodyError::FileContent {
                file: format!("{}#{name}", path.display()).into(),
                error,
            })?;
        Ok((name, prepared.body))
    });
    loaded.collect()
}
