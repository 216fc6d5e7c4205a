//! The content of a mesh file: faces in groups, or shapes that are placed.

pub(crate) mod allowance;
pub(crate) mod assembly;
pub(crate) mod groups;

use super::error::MeshFault;
use super::polygons::Polygons;
use super::remark::Remarks;
use super::unit::{Conversion, Unit};
use assembly::Assembly;
use groups::Groups;

/// The content of a mesh file as its reader returns it, not yet checked.
#[derive(Debug)]
pub(crate) struct Content {
    /// The unit of the coordinates, if the file states one or its format has one.
    pub(crate) unit: Option<Unit>,
    pub(crate) layout: Layout,
    /// Remarks about content that was skipped or changed.
    pub(crate) remarks: Remarks,
}

/// The layout of the faces in a file.
#[derive(Debug)]
pub(crate) enum Layout {
    /// A list of vertices and faces. Each part of the file is a group of these faces.
    List(Polygons, Groups),
    /// Shapes and their placements. One shape may be placed several times.
    Assembly(Assembly),
}

impl Content {
    /// Returns the number of parts of the file.
    pub(crate) fn parts(&self) -> usize {
        match &self.layout {
            Layout::List(_, groups) => groups.names.len(),
            Layout::Assembly(assembly) => assembly.parts.len(),
        }
    }

    /// Returns the name of a part, if it has one.
    pub(crate) fn name(&self, part: usize) -> Option<&str> {
        match &self.layout {
            Layout::List(_, groups) => groups.names[part].as_deref(),
            Layout::Assembly(assembly) => assembly.parts[part].name.as_deref(),
        }
    }

    /// Returns the faces of one part. Vertices and faces are numbered from 0.
    pub(crate) fn part(&self, part: usize, conversion: Conversion) -> Result<Polygons, MeshFault> {
        let faces = match &self.layout {
            Layout::List(polygons, groups) => converted(groups.part(polygons, part)?, conversion),
            Layout::Assembly(assembly) => assembly.expanded(part..part + 1, conversion)?,
        };
        Ok(self.remarked(faces))
    }

    /// Returns the faces of each part separately, like [`Content::part`].
    pub(crate) fn all_parts(&self, conversion: Conversion) -> Result<Vec<Polygons>, MeshFault> {
        let parts: Vec<Polygons> = match &self.layout {
            Layout::List(polygons, groups) => {
                let parts = groups.all(polygons)?.into_iter();
                parts.map(|part| converted(part, conversion)).collect()
            }
            Layout::Assembly(assembly) => {
                let parts = 0..assembly.parts.len();
                assembly.check_size(parts.clone())?;
                let alone = parts.map(|part| assembly.expanded(part..part + 1, conversion));
                alone.collect::<Result<_, _>>()?
            }
        };
        Ok(parts.into_iter().map(|part| self.remarked(part)).collect())
    }

    /// Returns all faces as one list. Those of a list keep the file's numbers; those of an assembly are numbered part
    /// by part.
    pub(crate) fn all_faces(self, conversion: Conversion) -> Result<Polygons, MeshFault> {
        let mut faces = match self.layout {
            Layout::List(polygons, _) => converted(polygons, conversion),
            Layout::Assembly(assembly) => assembly.expanded(0..assembly.parts.len(), conversion)?,
        };
        faces.remarks = self.remarks;
        Ok(faces)
    }

    fn remarked(&self, faces: Polygons) -> Polygons {
        let remarks = self.remarks.clone();
        Polygons { remarks, ..faces }
    }
}

fn converted(mut polygons: Polygons, conversion: Conversion) -> Polygons {
    if conversion != Conversion::NONE {
        for vertex in &mut polygons.vertices {
            *vertex = conversion.apply(*vertex);
        }
    }
    polygons
}

/// Wraps a list of faces without groups as the content of a file.
impl From<Polygons> for Content {
    fn from(mut polygons: Polygons) -> Self {
        Content {
            unit: None,
            remarks: std::mem::take(&mut polygons.remarks),
            layout: Layout::List(polygons, Groups::single()),
        }
    }
}
