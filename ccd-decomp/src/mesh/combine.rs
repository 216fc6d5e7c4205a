//! Transforms, merges and measures meshes.

use super::TriangleMesh;
use super::affine::AffineMap;
use super::error::{MeshError, MeshFault};
use super::polygons::{check_coordinate_range, check_count_fits_indices};
use super::repair::Repairs;
use crate::bounds::BoundingBox;
use ccd_core::glam::DVec3;

impl TriangleMesh {
    /// Returns the image of the mesh under an affine map. Vertices and faces keep their numbers.
    ///
    /// A map that [reverses_orientation](AffineMap::reverses_orientation) reverses all triangles, so that a solid stays
    /// one. A map that flattens may make faces without area, or several faces of the same points: they are repaired as
    /// in a file.
    ///
    /// # Guarantee
    /// Every vertex is the image of a vertex, rounded as [`AffineMap::apply`] says. The triangles cover the image of
    /// the surface up to that rounding: four coplanar corners may no longer be coplanar.
    ///
    /// # Errors
    /// [`MeshFault::NotFinite`] and [`MeshFault::CoordinateTooLarge`] name a vertex whose image is out of range.
    ///
    /// ```
    /// use ccd_core::Pose;
    /// use ccd_core::glam::{DVec3, dvec3};
    /// use ccd_decomp::{AffineMap, TriangleMesh};
    /// let mesh = TriangleMesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], &[[0, 1, 2]])?;
    /// let moved = mesh.transformed(Pose::at([0.0, 0.0, 2.0])?)?;
    /// assert_eq!(moved.vertices()[1], dvec3(1.0, 0.0, 2.0));
    /// let inches = mesh.transformed(AffineMap::from_scale_and_pose(25.4, Pose::IDENTITY))?;
    /// assert_eq!(inches.vertices()[1], dvec3(25.4, 0.0, 0.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn transformed(&self, map: impl Into<AffineMap>) -> Result<Self, MeshError> {
        let map = map.into();
        let images = self.vertices.iter().map(|&vertex| map.apply(vertex));
        let vertices: Vec<DVec3> = images.collect();
        check_coordinate_range(&vertices, &[])?;
        let mut faces = self.faces.clone();
        if map.reverses_orientation() {
            faces.iter_mut().for_each(|face| face.swap(1, 2));
        }
        Ok(TriangleMesh::from_triangles(
            vertices,
            (faces, self.face_ids.clone()),
            self.file_face_count,
            self.repairs.with_zero_area_tally_cleared(),
        ))
    }

    /// Merges meshes into one, which numbers the vertices and faces of each mesh after those of the preceding meshes.
    /// Numbers of dropped faces are not reused.
    ///
    /// Faces with the same points are repaired as in a file. Meshes that touch in equal points are connected
    /// there; those that overlap are the sum of their solids.
    ///
    /// # Errors
    /// [`MeshFault::NoVertices`] for no mesh, [`MeshFault::TooManyElements`].
    ///
    /// ```
    /// use ccd_core::Pose;
    /// use ccd_core::glam::DVec3;
    /// use ccd_decomp::TriangleMesh;
    /// let one = TriangleMesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], &[[0, 1, 2]])?;
    /// let other = one.transformed(Pose::at([0.0, 0.0, 1.0])?)?;
    /// let both = TriangleMesh::merge([&one, &other])?;
    /// assert_eq!(both.faces(), [[0, 1, 2], [3, 4, 5]]);
    /// assert_eq!(both.face_ids(), [0, 1]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn merge<'a>(meshes: impl IntoIterator<Item = &'a Self>) -> Result<Self, MeshError> {
        let meshes: Vec<&Self> = meshes.into_iter().collect();
        if meshes.is_empty() {
            return Err(MeshFault::NoVertices.into());
        }
        let total = |count: fn(&Self) -> usize| meshes.iter().map(|mesh| count(mesh)).sum();
        check_count_fits_indices("vertices", total(|mesh| mesh.vertices.len()))?;
        check_count_fits_indices("corners", total(|mesh| 3 * mesh.faces.len()))?;
        check_count_fits_indices("faces", total(|mesh| mesh.file_face_count as usize))?;
        let (mut vertices, mut faces, mut ids) = (Vec::new(), Vec::new(), Vec::new());
        let (mut repairs, mut face_count) = (Repairs::default(), 0);
        for mesh in meshes {
            let first = vertices.len() as u32;
            repairs.append(
                &mesh.repairs.with_zero_area_tally_cleared(),
                first,
                face_count,
            );
            vertices.extend(&mesh.vertices);
            faces.extend(mesh.faces.iter().map(|face| face.map(|v| first + v)));
            ids.extend(mesh.face_ids.iter().map(|id| face_count + id));
            face_count += mesh.file_face_count;
        }
        Ok(TriangleMesh::from_triangles(
            vertices,
            (faces, ids),
            face_count,
            repairs,
        ))
    }

    /// Returns the lower and the upper corner of the bounding box of all triangles.
    ///
    /// ```
    /// use ccd_core::glam::DVec3;
    /// use ccd_decomp::TriangleMesh;
    /// let vertices = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    /// let mesh = TriangleMesh::new(vertices, &[[0, 1, 2]])?;
    /// // No triangle uses the last vertex.
    /// assert_eq!(mesh.bounding_box(), [DVec3::ZERO, DVec3::X + DVec3::Y]);
    /// # Ok::<(), ccd_decomp::MeshError>(())
    /// ```
    pub fn bounding_box(&self) -> [DVec3; 2] {
        let corners = self.faces.iter().flatten();
        let BoundingBox { lo, hi } =
            BoundingBox::enclosing(corners.map(|&v| self.vertices[v as usize]));
        [lo, hi]
    }
}

#[cfg(test)]
mod tests;
