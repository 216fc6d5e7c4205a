//! The groups of a file's faces; each group is a part of the mesh, and may have a name.

use crate::mesh::error::MeshFault;
use crate::mesh::polygons::Polygons;
use std::ops::Range;

/// A partition of a list of faces into groups, which may have names. Each face is in one group, and each group has a
/// face.
#[derive(Debug, Default)]
pub(crate) struct Groups {
    pub(crate) names: Vec<Option<String>>,
    /// For each face, the number of its group; empty if all faces are in the first group.
    pub(crate) group_of_face: Vec<u32>,
}

impl Groups {
    /// Returns a single unnamed group that contains all faces.
    pub(crate) fn single_group() -> Self {
        Groups {
            names: vec![None],
            group_of_face: Vec::new(),
        }
    }

    /// Copies each of some groups into a list of its own, with the faces of the group and the vertices that they use.
    /// Faces and vertices keep their order.
    pub(super) fn copy_groups(
        &self,
        list: &Polygons,
        groups: Range<usize>,
    ) -> Result<Vec<Polygons>, MeshFault> {
        list.check_corners()?;
        let mut faces = vec![Vec::new(); self.names.len()];
        for face in 0..list.corner_ends.len() {
            let group = self.group_of_face.get(face).copied().unwrap_or(0);
            faces[group as usize].push(face);
        }
        let mut numbers = vec![0; list.vertices.len()];
        let copies = faces[groups].iter();
        Ok(copies
            .map(|of| copy_faces(list, of, &mut numbers))
            .collect())
    }
}

/// Copies some faces of a list and the vertices that they use into a new list. `numbers` is a buffer for the new number
/// of each vertex.
fn copy_faces(list: &Polygons, faces: &[usize], numbers: &mut [i64]) -> Polygons {
    let mut part = Polygons::default();
    for &face in faces {
        part.push_face(list.face_corners(face).iter().copied());
        part.face_line_numbers
            .extend(list.face_line_numbers.get(face));
    }
    let mut used: Vec<usize> = part.corners.iter().map(|&v| v as usize).collect();
    used.sort_unstable();
    used.dedup();
    for vertex in used {
        numbers[vertex] = part.vertices.len() as i64;
        part.vertices.push(list.vertices[vertex]);
        part.vertex_line_numbers
            .extend(list.vertex_line_numbers.get(vertex));
    }
    for corner in &mut part.corners {
        *corner = numbers[*corner as usize];
    }
    part
}
