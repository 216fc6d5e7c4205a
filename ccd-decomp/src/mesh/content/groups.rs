//! Copies of the groups of a file's faces; each group is a part of the mesh.

use crate::mesh::error::MeshFault;
use crate::mesh::polygons::Polygons;
use std::ops::Range;

/// Copies each of some groups into a list of its own, with the faces of the group and the vertices that they use. Faces
/// and vertices keep their order. Faces without a group are in the first one.
pub(super) fn copy_groups(
    list: &Polygons,
    group_of_face: &[u32],
    groups: Range<usize>,
) -> Result<Vec<Polygons>, MeshFault> {
    list.check_corners()?;
    let mut faces = vec![Vec::new(); groups.len()];
    for face in 0..list.corner_ends.len() {
        let group = group_of_face.get(face).map_or(0, |&group| group as usize);
        if groups.contains(&group) {
            faces[group - groups.start].push(face);
        }
    }
    let mut numbers = vec![0; list.vertices.len()];
    let copies = faces.iter();
    Ok(copies
        .map(|of| copy_faces(list, of, &mut numbers))
        .collect())
}

/// Copies some faces of a list and the vertices that they use into a new list. `numbers` is a buffer for the new number
/// of each vertex.
fn copy_faces(list: &Polygons, faces: &[usize], numbers: &mut [i64]) -> Polygons {
    let mut part = Polygons {
        remarks: list.remarks.clone(),
        ..Polygons::default()
    };
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
