//! Parses the descriptions of meshes, and of their parts, on a command line.

use crate::file::has_stored_body_extension;
use crate::mesh::TriangleMesh;
use crate::mesh::adjustments::{Adjustments, UnknownAdjustment};
use crate::mesh::error::MeshError;
use crate::mesh::format::Format;
use crate::mesh::mesh_file::MeshFile;
use crate::mesh::unit::Unit;
use crate::prepare::Detail;
use std::ffi::OsString;
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// A mesh file or a part of a mesh file, with adjustments: `FILE`, `FILE#PART`, `FILE@mm`,
/// `FILE#PART@scale=0.5@mirror=x`.
///
/// The part follows the first `#` after a mesh extension, the adjustments follow `@`. After a part, only valid
/// adjustments are not part of its name. If a file has the whole text as its name, it is that file.
///
/// ```
/// use ccd_decomp::MeshSource;
/// let lid: MeshSource = "plate.glb#lid.stl@mirror=x".parse()?;
/// assert_eq!((lid.file.to_str(), lid.part.as_deref()), (Some("plate.glb"), Some("lid.stl")));
/// assert_eq!(lid.to_string(), "plate.glb#lid.stl@mirror=x");
/// assert_eq!("part#2.stl".parse::<MeshSource>()?.part, None);
/// # Ok::<(), ccd_decomp::UnknownAdjustment>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct MeshSource {
    /// The path of the mesh file.
    pub file: PathBuf,
    /// The name or number (from 0) of the part; `None` for all parts together.
    pub part: Option<String>,
    /// The adjustments that are applied to the mesh.
    pub adjustments: Adjustments,
}

impl MeshSource {
    /// Reads and adjusts the mesh. Also returns the unit of its coordinates, if known.
    ///
    /// # Errors
    /// [`MeshError`], which names the file.
    pub fn read(&self) -> Result<(TriangleMesh, Option<Unit>), MeshError> {
        let mut file = MeshFile::read(&self.file)?;
        if let Some(unit) = self.adjustments.stated_unit {
            file = file.with_stated_unit(unit);
        }
        if let Some(unit) = self.adjustments.target_unit {
            file = file.converted_to_unit(unit);
        }
        let unit = file.unit();
        let mesh = match &self.part {
            Some(part) => file.part(part)?,
            None => file.into_mesh()?,
        };
        let mesh = match self.adjustments.affine_map() {
            Some(map) => mesh
                .transformed(map)
                .map_err(|error| MeshError::new(&self.file, error.fault))?,
            None => mesh,
        };
        Ok((mesh, unit))
    }

    /// Returns `asked`, or `Detail::Surface` if the mesh is to be hollow.
    pub fn detail(&self, asked: Detail) -> Detail {
        if self.adjustments.is_hollow {
            Detail::Surface
        } else {
            asked
        }
    }
}

/// Splits a text into the file name, the mark after the file name (`#` or `@`), and the rest; `None` without a mark.
fn split_at_mark(text: &str) -> Option<(&str, char, &str)> {
    let mut ends = text.match_indices(['#', '@']);
    let (at, mark) = ends.find(|&(at, mark)| {
        let file = Path::new(&text[..at]);
        // A folder may end like a mesh.
        let is_folder = mark == "@" && text[at..].contains(['/', '\\']);
        let is_stored = mark == "@" && has_stored_body_extension(file);
        !is_folder && (is_stored || Format::from_path(file).is_ok())
    })?;
    Some((&text[..at], mark.chars().next()?, &text[at + 1..]))
}

impl FromStr for MeshSource {
    type Err = UnknownAdjustment;

    fn from_str(text: &str) -> Result<Self, UnknownAdjustment> {
        let Some((file, mark, rest)) = split_at_mark(text).filter(|_| !Path::new(text).is_file())
        else {
            return Ok(PathBuf::from(text).into());
        };
        let (mut part, mut words) = (None, Vec::new());
        if mark == '@' {
            words.extend(rest.split('@'));
        } else {
            let mut name = rest;
            while let Some((before, word)) = name.rsplit_once('@')
                && Adjustments::NONE.with_parsed_adjustment(word).is_ok()
            {
                name = before;
                words.push(word);
            }
            words.reverse();
            part = Some(name.to_owned());
        }
        let mut words = words.into_iter();
        Ok(MeshSource {
            file: file.into(),
            part,
            adjustments: words.try_fold(Adjustments::NONE, Adjustments::with_parsed_adjustment)?,
        })
    }
}

/// Creates the description of a whole mesh file, without adjustments.
impl From<PathBuf> for MeshSource {
    fn from(file: PathBuf) -> Self {
        MeshSource {
            file,
            part: None,
            adjustments: Adjustments::NONE,
        }
    }
}

/// Parses a description given as a string of the operating system, such as a command-line argument. A path that is not
/// UTF-8 is a file name without a part.
impl TryFrom<OsString> for MeshSource {
    type Error = UnknownAdjustment;

    fn try_from(text: OsString) -> Result<Self, UnknownAdjustment> {
        match text.to_str() {
            Some(text) => text.parse(),
            None => Ok(PathBuf::from(text).into()),
        }
    }
}

impl fmt::Display for MeshSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file.display())?;
        if let Some(part) = &self.part {
            write!(f, "#{part}")?;
        }
        write!(f, "{}", self.adjustments)
    }
}
