//! Names a mesh file, a part of it, and adjustments, and loads them.

use super::error::BodyError;
use crate::mesh::TriangleMesh;
use crate::mesh::adjustments::Adjustments;
use crate::mesh::error::MeshError;
use crate::mesh::mesh_file::MeshFile;
use crate::mesh::unit::Unit;
use crate::prepare::model::PreparedBody;
use crate::prepare::{PieceChoice, body_from_mesh};
use std::fmt;
use std::path::PathBuf;

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

    /// Reads the mesh, and makes a body of it.
    ///
    /// # Errors
    /// [`BodyError::Mesh`] if the file cannot be read, [`BodyError::FileContent`] if no body can be made of the mesh.
    pub fn load(&self, choice: PieceChoice) -> Result<PreparedBody, BodyError> {
        let (mesh, unit) = self.read()?;
        match body_from_mesh(&mesh, self.choice(choice)) {
            Ok(prepared) => Ok(PreparedBody { unit, ..prepared }),
            Err(error) => Err(BodyError::FileContent {
                file: self.to_string().into(),
                error,
            }),
        }
    }

    /// Returns `asked`, or `PieceChoice::Surface` if the mesh is to be hollow.
    pub fn choice(&self, asked: PieceChoice) -> PieceChoice {
        if self.adjustments.is_hollow {
            PieceChoice::Surface
        } else {
            asked
        }
    }
}

/// Names a whole mesh file, without adjustments.
impl From<PathBuf> for MeshSource {
    fn from(file: PathBuf) -> Self {
        MeshSource {
            file,
            part: None,
            adjustments: Adjustments::NONE,
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
