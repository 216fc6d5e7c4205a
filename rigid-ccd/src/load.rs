//! Bodies from files.

use ccd_core::Body;
use ccd_decomp::{BodyError, BodySource, Detail};
use std::path::Path;

/// Loads a body from a mesh file (OBJ, STL, PLY, OFF), or from a `.ccd` file that was prepared before.
///
/// A mesh becomes the least that is exact: one hull, convex patches or triangles ([`Detail::Auto`]).
/// To choose, or to see what has become of a mesh, use
/// [`mesh::body_from_mesh`](ccd_decomp::body_from_mesh).
///
/// # Errors
/// [`BodyError`], naming the file and the element that is wrong.
///
/// ```no_run
/// let part = rigid_ccd::load("part.stl")?;
/// # Ok::<(), rigid_ccd::Error>(())
/// ```
pub fn load(path: impl AsRef<Path>) -> Result<Body, BodyError> {
    let source = BodySource::of_file(path.as_ref().into());
    Ok(source.load(Detail::Auto)?.body)
}
