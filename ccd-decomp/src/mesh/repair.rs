//! Finds the faces of a mesh that are dropped, and reports the faults of a mesh.

use super::remark::Remarks;
use crate::hull::polygons::with_smallest_corner_first;
use crate::tally::CountWithExamples;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::HashSet;
use std::fmt;

/// The faults that were found in a mesh, and how they were repaired. Numbers are those of the file.
///
/// # Guarantee
/// No repair removes a point of the surface.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Repairs {
    /// Faces of more than three corners, which were triangulated. A non-planar polygon bounds several surfaces: the
    /// triangles are one of them.
    pub triangulated_polygons: CountWithExamples<u32>,
    /// Polygons that intersect themselves or are far from planar. Their triangle fan extends beyond the polygon.
    pub overhanging_fans: CountWithExamples<u32>,
    /// Faces dropped because another face has the same three points in the same orientation. The same points in the
    /// opposite orientation are kept: two faces back to back are a closed surface.
    pub duplicate_faces: CountWithExamples<u32>,
    /// Faces that were dropped because they collapse to a segment or point on an edge of another face. Two of their
    /// corners are the same point. Collapsed faces elsewhere are kept.
    pub collapsed_faces: CountWithExamples<u32>,
    /// Faces without area, which are kept. A segment or point can be touched, too.
    pub zero_area_faces: CountWithExamples<u32>,
    /// Vertices that no face uses.
    pub unreferenced_vertices: CountWithExamples<u32>,
    /// Remarks about content of the file that was skipped or changed.
    // Stored bodies have the remarks at their end; older files have none.
    #[serde(skip)]
    pub remarks: Remarks,
}

impl Repairs {
    /// Returns whether the mesh had no faults.
    pub fn is_empty(&self) -> bool {
        self == &Repairs::default()
    }

    /// Returns the repairs without the number of faces that have no area. Rebuilding the mesh from its triangles finds
    /// these faces again, but not the other repairs.
    pub(crate) fn with_zero_area_tally_cleared(&self) -> Self {
        Repairs {
            zero_area_faces: CountWithExamples::default(),
            ..self.clone()
        }
    }

    /// Adds the repairs of another mesh, with offsets of its vertex and face numbers.
    pub(crate) fn append(&mut self, other: &Self, vertex: u32, face: u32) {
        // Exhaustive: a new kind of repair does not compile until it is added here.
        let Repairs {
            triangulated_polygons: polygons,
            overhanging_fans: overhanging,
            duplicate_faces: duplicates,
            collapsed_faces: collapsed,
            zero_area_faces: zero_area,
            unreferenced_vertices: unreferenced,
            remarks,
        } = self;
        polygons.append(&other.triangulated_polygons, face);
        overhanging.append(&other.overhanging_fans, face);
        duplicates.append(&other.duplicate_faces, face);
        collapsed.append(&other.collapsed_faces, face);
        zero_area.append(&other.zero_area_faces, face);
        unreferenced.append(&other.unreferenced_vertices, vertex);
        remarks.add_counts(&other.remarks);
    }

    pub(crate) fn note_unreferenced_vertices(&mut self, vertices: usize, corners: &[i64]) {
        let mut referenced = vec![false; vertices];
        for &corner in corners {
            referenced[corner as usize] = true;
        }
        for (vertex, _) in referenced.iter().enumerate().filter(|(_, r)| !**r) {
            self.unreferenced_vertices.add(vertex as u32);
        }
    }
}

impl fmt::Display for Repairs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let notes = [
            (&self.triangulated_polygons, "polygons cut into triangles"),
            (
                &self.overhanging_fans,
                "of them meeting themselves, covered too widely",
            ),
            (&self.duplicate_faces, "duplicate faces dropped"),
            (&self.collapsed_faces, "collapsed faces dropped"),
            (&self.zero_area_faces, "faces without area kept"),
            (&self.unreferenced_vertices, "vertices unused"),
        ];
        let notes = notes.iter().filter(|(tally, _)| !tally.is_empty());
        let mut notes: Vec<String> = notes
            .map(|(tally, what)| format!("{what}: {tally}"))
            .collect();
        notes.extend((!self.remarks.is_empty()).then(|| self.remarks.to_string()));
        match &notes[..] {
            [] => write!(f, "no repairs"),
            notes => f.write_str(&notes.join("; ")),
        }
    }
}

/// Marks every face with the same points as an earlier face, in the same orientation.
pub(crate) fn duplicate_face_flags(faces: &[[u32; 3]], positions: &[u32]) -> Vec<bool> {
    let key = |face: &[u32; 3]| with_smallest_corner_first(face.map(|v| positions[v as usize]));
    let mut keyed: Vec<([u32; 3], u32)> = faces.iter().map(key).zip(0..).collect();
    keyed.par_sort_unstable();
    let mut duplicate = vec![false; faces.len()];
    for pair in keyed.windows(2) {
        duplicate[pair[1].1 as usize] = pair[0].0 == pair[1].0;
    }
    duplicate
}

/// Marks every collapsed face whose segment or point lies on an edge of an unmarked face. A collapsed face has two
/// equal corner points.
pub(crate) fn covered_collapsed_face_flags(faces: &[[u32; 3]], positions: &[u32]) -> Vec<bool> {
    let welded = |face: &[u32; 3]| face.map(|v| positions[v as usize]);
    let has_collapsed = |[a, b, c]: [u32; 3]| a == b || b == c || c == a;
    let mut marked = vec![false; faces.len()];
    if !faces.iter().any(|face| has_collapsed(welded(face))) {
        return marked;
    }
    // An edge from a point to itself represents the point.
    let mut covered = HashSet::new();
    let mut cover = |[a, b, c]: [u32; 3]| {
        let pairs = [(a, b), (b, c), (c, a), (a, a), (b, b), (c, c)];
        let before = covered.len();
        covered.extend(pairs.map(|(v, w)| (v.min(w), v.max(w))));
        covered.len() > before
    };
    for face in faces
        .iter()
        .map(welded)
        .filter(|&face| !has_collapsed(face))
    {
        cover(face);
    }
    // Segments come before points, so that a point at the end of a kept segment is covered, in either order of the
    // file.
    let is_point = |[a, b, c]: [u32; 3]| a == b && b == c;
    for points in [false, true] {
        for (k, face) in faces.iter().map(welded).enumerate() {
            if has_collapsed(face) && is_point(face) == points {
                marked[k] = !cover(face);
            }
        }
    }
    marked
}
