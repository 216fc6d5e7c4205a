//! Meshes, and parts of them, as they are named on a command line.

use crate::mesh::TriangleMesh;
use crate::mesh::error::MeshError;
use crate::mesh::format::Format;
use crate::mesh::mesh_file::MeshFile;
use crate::mesh::unit::Unit;
use std::ffi::OsString;
use std::fmt;
use std::path::{Path, PathBuf};

/// A mesh file, or a part of one: `FILE` or `FILE#PART`.
///
/// The part is what follows the first `#` after an extension of a mesh. A file that has the whole text as its name is
/// that file.
///
/// ```
/// use ccd_decomp::MeshSource;
/// let lid = MeshSource::from("plate.3mf#lid.stl");
/// assert_eq!((lid.file.to_str(), lid.part.as_deref()), (Some("plate.3mf"), Some("lid.stl")));
/// assert_eq!(MeshSource::from("part#2.stl").part, None);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshSource {
    /// The path of the file.
    pub file: PathBuf,
    /// The name of the part or its number, from 0; none for all parts together.
    pub part: Option<String>,
}

impl MeshSource {
    /// Reads the mesh; converted to a unit, if one is given. Returns the unit of its coordinates too, if it is known.
    ///
    /// # Errors
    /// [`MeshError`], which names the file.
    pub fn read(&self, unit: Option<Unit>) -> Result<(TriangleMesh, Option<Unit>), MeshError> {
        let mut file = MeshFile::read(&self.file)?;
        if let Some(unit) = unit {
            file = file.in_unit(unit);
        }
        let unit = file.unit();
        let mesh = match &self.part {
            Some(part) => file.part(part)?,
            None => file.into_mesh()?,
        };
        Ok((mesh, unit))
    }
}

impl From<&str> for MeshSource {
    fn from(text: &str) -> Self {
        let is_mesh = |(at, _): &(usize, &str)| Format::from_path(&text[..*at]).is_ok();
        let split = text.match_indices('#').find(is_mesh);
        match split.filter(|_| !Path::new(text).is_file()) {
            Some((at, _)) => MeshSource {
                file: text[..at].into(),
                part: Some(text[at + 1..].into()),
            },
            None => MeshSource {
                file: text.into(),
                part: None,
            },
        }
    }
}

/// A path that is no text names no part.
impl From<OsString> for MeshSource {
    fn from(text: OsString) -> Self {
        match text.to_str() {
            Some(text) => text.into(),
            None => MeshSource {
                file: text.into(),
                part: None,
            },
        }
    }
}

impl fmt::Display for MeshSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.part {
            Some(part) => write!(f, "{}#{part}", self.file.display()),
            None => write!(f, "{}", self.file.display()),
        }
    }
}
