//! The content of a mesh file before it is checked: faces in groups, or shapes with their placements.

pub(crate) mod allowance;
pub(crate) mod assembly;
pub(crate) mod groups;

use super::error::MeshFault;
use super::polygons::Polygons;
use super::remark::Remarks;
use super::unit::Unit;
use assembly::Assembly;
use groups::Groups;
use std::ops::Range;

/// The content of a mesh file as its reader returns it, not yet checked.
#[derive(Debug)]
pub(crate) struct Content {
    /// The unit of the coordinates; `None` if neither the file's format nor the caller states one.
    pub(crate) unit: Option<Unit>,
    pub(crate) layout: Layout,
    /// Remarks about content that was skipped or changed.
    pub(crate) remarks: Remarks,
}

/// The faces of a file, in one of the two ways in which formats describe them.
#[derive(Debug)]
pub(crate) enum Layout {
    /// A list of vertices and faces. Each part of the file is a group of these faces.
    FaceList(Polygons, Groups),
    /// An assembly of shapes and their placements. One shape may be placed several times.
    Assembly(Assembly),
}

impl Content {
    /// Returns the number of parts of the file.
    pub(crate) fn part_count(&self) -> usize {
        match &self.layout {
            Layout::FaceList(_, groups) => groups.names.len(),
            Layout::Assembly(assembly) => assembly.parts.len(),
        }
    }

    /// Returns the name of a part, if it has one.
    pub(crate) fn name(&self, part: usize) -> Option<&str> {
        match &self.layout {
            Layout::FaceList(_, groups) => groups.names[part].as_deref(),
            Layout::Assembly(assembly) => assembly.parts[part].name.as_deref(),
        }
    }

    /// Returns the faces of some parts of the file, in one list for each part. Vertices and faces of a part are
    /// numbered from 0.
    pub(crate) fn separate_parts(&self, parts: Range<usize>) -> Result<Vec<Polygons>, MeshFault> {
        let mut separate: Vec<Polygons> = match &self.layout {
            Layout::FaceList(polygons, groups) => groups.copy_groups(polygons, parts)?,
            Layout::Assembly(assembly) => {
                assembly.check_expansion_cost(parts.clone())?;
                let alone = parts.map(|part| assembly.placed_triangles(part..part + 1));
                alone.collect::<Result<_, _>>()?
            }
        };
        for part in &mut separate {
            part.remarks = self.remarks.clone();
        }
        Ok(separate)
    }

    /// Returns all faces of the file as one list. Faces of a list keep the file's numbers; faces of an assembly are
    /// numbered part by part.
    pub(crate) fn all_faces(self) -> Result<Polygons, MeshFault> {
        let faces = match self.layout {
            Layout::FaceList(polygons, _) => polygons,
            Layout::Assembly(assembly) => assembly.placed_triangles(0..assembly.parts.len())?,
        };
        let remarks = self.remarks;
        Ok(Polygons { remarks, ..faces })
    }
}

/// Wraps a list of faces without groups as the content of a file.
impl From<Polygons> for Content {
    fn from(mut polygons: Polygons) -> Self {
        Content {
            unit: None,
            remarks: std::mem::take(&mut polygons.remarks),
            layout: Layout::FaceList(polygons, Groups::single_group()),
        }
    }
}
