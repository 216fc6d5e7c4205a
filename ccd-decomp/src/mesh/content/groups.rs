//! Named groups of a file's faces, each a part of the mesh.

use crate::mesh::error::MeshFault;
use crate::mesh::polygons::Polygons;

/// A partition of a list of faces into groups, which may have names. Each face is in one group, and each group has a
/// face.
#[derive(Debug)]
pub(crate) struct Groups {
    pub(crate) names: Vec<Option<String>>,
    /// By face, the number of its group; empty if all faces are in the first group.
    pub(crate) of_face: Vec<u32>,
}

impl Groups {
    /// Returns a single unnamed group that contains all faces.
    pub(crate) fn single() -> Self {
        Groups {
            names: vec![None],
            of_face: Vec::new(),
        }
    }

    /// Copies the faces of one group, and the vertices that they use, in the list's order.
    pub(super) fn part(&self, list: &Polygons, group: usize) -> Result<Polygons, MeshFault> {
        let mut faces = self.faces(list);
        Ok(Copier::new(list)?.copy(&faces.swap_remove(group)))
    }

    /// Copies the faces of each group into a list of its own, like [`Groups::part`].
    pub(super) fn all(&self, list: &Polygons) -> Result<Vec<Polygons>, MeshFault> {
        let mut copier = Copier::new(list)?;
        let faces = self.faces(list);
        Ok(faces.iter().map(|faces| copier.copy(faces)).collect())
    }

    /// Returns the face numbers of each group.
    fn faces(&self, list: &Polygons) -> Vec<Vec<u32>> {
        let mut faces = vec![Vec::new(); self.names.len()];
        for face in 0..list.ends.len() {
            let group = self.of_face.get(face).copied().unwrap_or(0);
            faces[group as usize].push(face as u32);
        }
        faces
    }
}

/// A copier of faces from one list, which renumbers the vertices.
struct Copier<'a> {
    list: &'a Polygons,
    /// By vertex, its number in the copy. Only entries of copied vertices are valid.
    numbers: Vec<i64>,
}

impl<'a> Copier<'a> {
    fn new(list: &'a Polygons) -> Result<Self, MeshFault> {
        list.check_corners()?;
        Ok(Copier {
            list,
            numbers: vec![0; list.vertices.len()],
        })
    }

    fn copy(&mut self, faces: &[u32]) -> Polygons {
        let Copier { list, numbers } = self;
        let mut part = Polygons::default();
        for &face in faces {
            part.corners.extend(list.face_corners(face as usize));
            part.ends.push(part.corners.len());
            part.face_lines.extend(list.face_lines.get(face as usize));
        }
        let mut used: Vec<usize> = part.corners.iter().map(|&v| v as usize).collect();
        used.sort_unstable();
        used.dedup();
        for vertex in used {
            numbers[vertex] = part.vertices.len() as i64;
            part.vertices.push(list.vertices[vertex]);
            part.vertex_lines.extend(list.vertex_lines.get(vertex));
        }
        for corner in &mut part.corners {
            *corner = numbers[*corner as usize];
        }
        part
    }
}
