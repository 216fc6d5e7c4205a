//! Bodies from files.

use ccd_core::Body;
use ccd_decomp::{BodyError, BodySource, Detail};
use std::path::Path;

/// Loads a body from a mesh file (OBJ, STL, PLY, OFF) or a prepared body (`.ccd`).
///
/// Coordinates keep the unit of the file. A mesh becomes the fewest convex pieces that are exact: one
/// hull, convex patches or triangles ([`Detail::Auto`]). To choose the pieces, or to get a report of
/// defects, use [`mesh::body_from_mesh`](ccd_decomp::body_from_mesh).
///
/// # Errors
/// The file cannot be read, or holds no valid mesh; the error names the file and the element.
///
/// ```
/// let part = rigid_ccd::load("examples/bracket.obj")?;
/// assert_eq!(part.volume(), rigid_ccd::Volume::Solid);
/// # Ok::<(), rigid_ccd::Error>(())
/// ```
pub fn load(path: impl AsRef<Path>) -> Result<Body, BodyError> {
    let source = BodySource::of_file(path.as_ref().into());
    Ok(source.load(Detail::Auto)?.body)
}
