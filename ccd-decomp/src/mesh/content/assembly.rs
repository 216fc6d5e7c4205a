//! Assemblies: shapes, and the parts of a scene, each of which is a shape at a place.

use super::allowance::{ExpansionBudget, expansion_cost};
use crate::mesh::affine::AffineMap;
use crate::mesh::error::MeshFault;
use crate::mesh::polygons::Polygons;
use crate::mesh::remark::Remarks;
use std::ops::Range;

/// A scene, as a list of shapes and the parts that place them. One shape may be placed by several parts.
///
/// # Guarantee
/// Every part names a shape with a face.
#[derive(Debug)]
pub(crate) struct Assembly {
    /// The shapes, as lists of polygons, whose corners are indices into the shape's own vertices.
    pub(crate) shapes: Vec<Polygons>,
    pub(crate) parts: Vec<Part>,
    pub(crate) budget: ExpansionBudget,
    pub(crate) remarks: Remarks,
}

/// A part of a scene: the index of a shape, with the affine map that places it.
#[derive(Debug)]
pub(crate) struct Part {
    pub(crate) shape: usize,
    pub(crate) placement: AffineMap,
}

impl Assembly {
    /// Returns the placed triangles of some parts as one list, part by part.
    pub(super) fn placed_triangles(&self, parts: Range<usize>) -> Result<Polygons, MeshFault> {
        self.check_expansion_cost(parts.clone())?;
        let mut all = Polygons {
            remarks: self.remarks.clone(),
            ..Polygons::default()
        };
        for part in &self.parts[parts] {
            append_placed_shape(&mut all, &self.shapes[part.shape], &part.placement);
        }
        Ok(all)
    }

    /// Checks that the number of vertices and corners of some parts does not exceed the file's budget.
    pub(super) fn check_expansion_cost(&self, parts: Range<usize>) -> Result<(), MeshFault> {
        let mut allowance = self.budget;
        self.parts[parts].iter().try_for_each(|part| {
            let shape = &self.shapes[part.shape];
            let (vertices, corners) = (shape.vertices.len(), shape.corners.len());
            allowance.spend(1 + expansion_cost(vertices as u64, corners as u64))
        })
    }
}

/// Appends the image of a shape under an affine map to a list of faces. A mirroring map reverses the triangles, so that
/// a solid stays one.
fn append_placed_shape(all: &mut Polygons, shape: &Polygons, map: &AffineMap) {
    let first = all.vertices.len() as i64;
    let image = |&point| map.apply(point);
    all.vertices.extend(shape.vertices.iter().map(image));
    let mirrors = map.reverses_orientation();
    for triangle in shape.faces() {
        let start = all.corners.len();
        all.push_face(triangle.iter().map(|corner| first + corner));
        if mirrors {
            all.corners[start + 1..].reverse();
        }
    }
}

#[cfg(test)]
mod tests;
