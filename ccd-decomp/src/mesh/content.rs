//! The content of a mesh file before it is checked: faces in groups, or shapes with their placements.

pub(crate) mod allowance;
pub(crate) mod assembly;
mod groups;

use super::error::MeshFault;
use super::polygons::Polygons;
use super::unit::Unit;
use assembly::Assembly;
use std::ops::Range;

/// The content of a mesh file as its reader returns it, not yet checked.
#[derive(Debug)]
pub(crate) struct Content {
    /// The unit of the coordinates; `None` if neither the file's format nor the caller states one.
    pub(crate) unit: Option<Unit>,
    /// The names of the parts of the file, in the order of their numbers. Each part has a face.
    pub(crate) part_names: Vec<Option<String>>,
    pub(crate) geometry: Geometry,
}

/// The faces of a file, in one of the two ways in which formats describe them.
#[derive(Debug)]
pub(crate) enum Geometry {
    /// A list of vertices and faces, with the number of each face's part; without numbers all faces are in the first
    /// part.
    FaceList(Polygons, Vec<u32>),
    /// An assembly of shapes and their placements. One shape may be placed several times.
    Assembly(Assembly),
}

impl Content {
    /// Returns the faces of some parts of the file, in one list for each part. Vertices and faces of a part are
    /// numbered from 0.
    pub(crate) fn separate_parts(&self, parts: Range<usize>) -> Result<Vec<Polygons>, MeshFault> {
        match &self.geometry {
            Geometry::FaceList(polygons, part_of_face) => {
                groups::copy_groups(polygons, part_of_face, parts)
            }
            Geometry::Assembly(assembly) => {
                assembly.check_expansion_cost(parts.clone())?;
                let alone = parts.map(|part| assembly.placed_triangles(part..part + 1));
                alone.collect()
            }
        }
    }

    /// Returns all faces of the file as one list. Faces of a list keep the file's numbers; faces of an assembly are
    /// numbered part by part.
    pub(crate) fn all_faces(self) -> Result<Polygons, MeshFault> {
        match self.geometry {
            Geometry::FaceList(polygons, _) => Ok(polygons),
            Geometry::Assembly(assembly) => assembly.placed_triangles(0..assembly.parts.len()),
        }
    }
}

/// Wraps a list of faces that are all in one part without a name as the content of a file.
impl From<Polygons> for Content {
    fn from(polygons: Polygons) -> Self {
        Content {
            unit: None,
            part_names: vec![None],
            geometry: Geometry::FaceList(polygons, Vec::new()),
        }
    }
}
