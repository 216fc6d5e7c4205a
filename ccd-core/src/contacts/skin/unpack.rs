//! Converts pieces to triangles with mesh numbers.

use super::{Corner, Face, NearSurface, PointBits};
use crate::body::facets::fan_triangles;
use crate::body::feature::Feature;
use crate::body::piece::{ConvexCombination, Piece};
use crate::body::tree::point_query::polytopes_with_box_at;
use crate::math::vector::position_bits;
use glam::DVec3;
use std::collections::HashMap;
use std::ops::Range;

/// A triangle: its feature in the mesh, and its corners with their mesh numbers. Corners have a number if the mesh has
/// one.
type NumberedTriangle = (Feature, [(DVec3, Option<u32>); 3]);

impl NearSurface<'_> {
    /// Adds the triangles of a piece, and returns their indices. It is to be called once for each piece.
    pub(in crate::contacts) fn add_piece(&mut self, index: u32) -> Range<u32> {
        let piece = self.body.pieces().get(index as usize);
        let first = self.faces.len() as u32;
        for (name, corners) in self.triangles(index, &piece) {
            let corners = corners.map(|(point, id)| self.find_or_add_corner(point, id));
            self.faces.push(Face {
                corners,
                piece: index,
                radius: piece.radius,
                name,
            });
        }
        first..self.faces.len() as u32
    }

    /// Returns the triangles of a piece: the mesh's triangles on it, or else those of its facets. A piece without
    /// facets gives one triangle if it has up to three points, and otherwise a degenerate triangle for each point.
    fn triangles(&self, index: u32, piece: &Piece<'_>) -> Vec<NumberedTriangle> {
        let mesh: Vec<NumberedTriangle> = self.mesh_triangles_of(index, piece);
        if !mesh.is_empty() {
            return mesh;
        }
        let whole = |corners: [u32; 3]| {
            let point = |k: u32| piece.points[k as usize];
            // Facets that are not of the mesh have no name. Finding that out takes a visit to all of them.
            if !piece.facets.is_empty() {
                let nameless = corners.map(|k| (point(k), None));
                return (Feature::Piece(index), nameless);
            }
            let mut inside = ConvexCombination::EMPTY;
            for corner in corners {
                inside.add_weighted_point(corner, 1.0);
            }
            let name = self.body.pieces().feature(index as usize, &inside);
            (
                name,
                corners.map(|k| (point(k), self.mesh_vertex_of_point(index, k))),
            )
        };
        let facets = piece.facets.iter().flat_map(fan_triangles);
        let hull = match piece.points.len() as u32 {
            _ if !piece.facets.is_empty() => facets.collect(),
            1 => vec![[0, 0, 0]],
            2 => vec![[0, 1, 1]],
            3 => vec![[0, 1, 2]],
            more => (0..more).map(|k| [k; 3]).collect(),
        };
        hull.into_iter().map(whole).collect()
    }

    /// Returns the triangles of the mesh that lie on a polytope; empty if the polytope has none.
    fn mesh_triangles_of(&self, index: u32, piece: &Piece<'_>) -> Vec<NumberedTriangle> {
        let mut triangles = piece.mesh_triangles().peekable();
        if triangles.peek().is_none() {
            return Vec::new();
        }
        let faces = piece.facets.mesh_faces.iter();
        let numbered = faces.flat_map(|face| face.corners.into_iter().zip(face.vertices.map(Some)));
        let points = (0..piece.points.len() as u32).rev();
        let own = points.map(|k| {
            (
                piece.points[k as usize],
                self.mesh_vertex_of_point(index, k),
            )
        });
        // If several points are at one place, the first counts.
        let numbers: HashMap<PointBits, Option<u32>> = numbered
            .chain(own)
            .map(|(point, number)| (position_bits(point), number))
            .collect();
        let number = |point: DVec3| numbers.get(&position_bits(point)).copied().flatten();
        let named = triangles.map(|(id, corners)| {
            let corners = corners.map(|point| (point, number(point)));
            (Feature::Face(id), corners)
        });
        named.collect()
    }

    /// Returns the number of the mesh's vertex at a corner. If the corner's own piece does not have the number, this is
    /// the least number among the pieces with a point at the same position; `None` if none of them has one.
    pub(super) fn mesh_vertex_number(&self, corner: u32) -> Option<u32> {
        let corner = &self.corners[corner as usize];
        corner.id.or_else(|| {
            let place = corner.position_bits;
            let there = polytopes_with_box_at(self.body.tree(), place.map(f64::from_bits).into());
            let numbers = there.filter_map(|piece| {
                let mut points = self.body.pieces().get(piece as usize).points.iter();
                let point = points.position(|&point| position_bits(point) == place)?;
                self.mesh_vertex_of_point(piece, point as u32)
            });
            numbers.min()
        })
    }

    /// Returns the mesh's number of a point of a piece; `None` if the point has none.
    fn mesh_vertex_of_point(&self, piece: u32, point: u32) -> Option<u32> {
        let pieces = self.body.pieces();
        match pieces.feature(piece as usize, &ConvexCombination::from_single_point(point)) {
            Feature::Vertex(id) => Some(id),
            _ => None,
        }
    }

    fn find_or_add_corner(&mut self, point: DVec3, id: Option<u32>) -> u32 {
        let place = position_bits(point);
        *self.corner_indices.entry((place, id)).or_insert_with(|| {
            self.corners.push(Corner {
                position: self.body_to_a.transform_point(point),
                position_bits: place,
                id,
            });
            self.corners.len() as u32 - 1
        })
    }
}
