//! Checks the polygons of a file, and cuts them into triangles.

use super::error::MeshFault;
use super::outline;
use super::remark::Remarks;
use super::repair::Repairs;
use crate::exact::predicates::{first_point_out_of_range, has_zero_area};
use ccd_core::glam::DVec3;

/// The vertices and faces of a file, not yet checked.
#[derive(Debug, Default)]
pub(crate) struct Polygons {
    pub(crate) vertices: Vec<DVec3>,
    /// The vertex numbers of the corners of all faces, one face after the other, from 0; not yet checked.
    pub(crate) corners: Vec<i64>,
    /// For each face, the end of its range in `corners`.
    pub(crate) corner_ends: Vec<usize>,
    /// The line number of each vertex in the file, from 1; empty if the format has no lines. `face_line_numbers` has the line
    /// numbers of the faces.
    pub(crate) vertex_line_numbers: Vec<usize>,
    pub(crate) face_line_numbers: Vec<usize>,
    pub(crate) remarks: Remarks,
}

impl Polygons {
    pub(super) fn check(&self) -> Result<(), MeshFault> {
        let (vertices, faces) = (self.vertices.len(), self.corner_ends.len());
        if vertices == 0 {
            return Err(MeshFault::NoVertices);
        }
        if faces == 0 {
            return Err(MeshFault::NoFaces);
        }
        check_count_fits_indices("vertices", vertices)?;
        check_count_fits_indices("corners", self.corners.len())?;
        check_coordinate_range(&self.vertices, &self.vertex_line_numbers)?;
        self.check_corners()
    }

    /// Checks that every face has at least three corners, and that every corner names an existing vertex.
    pub(super) fn check_corners(&self) -> Result<(), MeshFault> {
        let vertices = self.vertices.len();
        for (face, corners) in self.faces().enumerate() {
            let line = self.face_line_numbers.get(face).copied();
            if corners.len() < 3 {
                let corners = corners.len();
                return Err(MeshFault::TooFewCorners {
                    face,
                    line,
                    corners,
                });
            }
            if let Some(&vertex) = corners.iter().find(|&&v| v < 0 || v >= vertices as i64) {
                return Err(MeshFault::NoSuchVertex {
                    face,
                    line,
                    vertex,
                    vertices,
                    first_vertex_number: 0,
                });
            }
        }
        Ok(())
    }

    /// Adds a face with the given vertex numbers of its corners.
    pub(crate) fn push_face(&mut self, corners: impl IntoIterator<Item = i64>) {
        self.corners.extend(corners);
        self.corner_ends.push(self.corners.len());
    }

    pub(super) fn faces(&self) -> impl Iterator<Item = &[i64]> {
        (0..self.corner_ends.len()).map(|face| self.face_corners(face))
    }

    /// Returns the vertex numbers of a face's corners.
    pub(super) fn face_corners(&self, face: usize) -> &[i64] {
        let start = face
            .checked_sub(1)
            .map_or(0, |before| self.corner_ends[before]);
        &self.corners[start..self.corner_ends[face]]
    }

    /// Triangulates every polygon as the fan about its first corner. A polygon whose fan has a degenerate triangle,
    /// or one outside the polygon, is triangulated otherwise. Corners that repeat the one before, and spikes, bound no area.
    ///
    /// The signed areas of the fan add up to the polygon's, so that the fan covers a planar polygon, convex or not. For
    /// a non-convex polygon it covers more; that is reported if the polygon intersects itself and cannot be
    /// triangulated otherwise.
    pub(super) fn triangulate(&self, repairs: &mut Repairs) -> (Vec<[u32; 3]>, Vec<u32>) {
        let count = self.corners.len() - 2 * self.corner_ends.len();
        let (mut faces, mut ids) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for (face, corners) in self.faces().enumerate() {
            let id = face as u32;
            let start = faces.len();
            for pair in corners[1..].windows(2) {
                faces.push([corners[0], pair[0], pair[1]].map(|v| v as u32));
                ids.push(id);
            }
            if corners.len() > 3 {
                repairs.triangulated_polygons.add(id);
                let fan = &mut faces[start..];
                let overhangs = has_flipped_triangle(&self.vertices, fan);
                if !(overhangs || has_degenerate_triangle(&self.vertices, fan)) {
                    continue;
                }
                let points: Vec<DVec3> =
                    corners.iter().map(|&v| self.vertices[v as usize]).collect();
                match outline::fill_outline(&points) {
                    Some(filled) => {
                        for (face, triangle) in fan.iter_mut().zip(filled) {
                            *face = triangle.map(|k| corners[k] as u32);
                        }
                    }
                    None if overhangs => repairs.overhanging_fans.add(id),
                    None => {}
                }
            }
        }
        (faces, ids)
    }
}

/// Checks that there are few enough vertices or corners for 32-bit indices.
pub(super) fn check_count_fits_indices(what: &'static str, count: usize) -> Result<(), MeshFault> {
    // A fan makes less than one triangle per corner; pieces name corners by u32.
    if count < u32::MAX as usize / 12 {
        Ok(())
    } else {
        Err(MeshFault::TooManyElements {
            element_kind: what,
            element_count: count,
        })
    }
}

/// Checks that all coordinates are in the supported range.
pub(super) fn check_coordinate_range(vertices: &[DVec3], lines: &[usize]) -> Result<(), MeshFault> {
    let Some(vertex) = first_point_out_of_range(vertices) else {
        return Ok(());
    };
    let line = lines.get(vertex).copied();
    Err(if vertices[vertex].is_finite() {
        MeshFault::CoordinateTooLarge { vertex, line }
    } else {
        MeshFault::NotFinite { vertex, line }
    })
}

/// Returns whether any triangle of a fan has zero area.
fn has_degenerate_triangle(vertices: &[DVec3], fan: &[[u32; 3]]) -> bool {
    fan.iter()
        .any(|face| has_zero_area(face.map(|v| vertices[v as usize])))
}

/// Returns whether the normal of any triangle of a fan points against the sum of the fan's normals.
fn has_flipped_triangle(vertices: &[DVec3], fan: &[[u32; 3]]) -> bool {
    let normal = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|v| vertices[v as usize]);
        (b - a).cross(c - a)
    };
    let whole: DVec3 = fan.iter().map(normal).sum();
    fan.iter().any(|face| normal(face).dot(whole) < 0.0)
}
