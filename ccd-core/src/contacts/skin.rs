//! The part of a body's surface near the other body, as triangles that keep the mesh's numbers.

mod unpack;

use crate::body::Body;
use crate::body::feature::Feature;
use crate::math::order::greater;
use crate::math::vector::{normal, unit, vector_perpendicular_to_both};
use crate::motion::pose::Frame;
use glam::DVec3;
use std::collections::HashMap;
use std::ops::Range;

/// The triangles of a body's surface that a search for contacts needs, in A's frame.
pub(super) struct NearSurface<'a> {
    body: &'a Body,
    body_to_a: Frame,
    corners: Vec<Corner>,
    faces: Vec<Face>,
    /// The index of the corner with a given position and mesh number.
    corner_indices: HashMap<(PointBits, Option<u32>), u32>,
    /// The edges between two coplanar faces, each mapped to these two faces. Points on such an edge belong to the first
    /// of the faces.
    coplanar_edges: HashMap<[u32; 2], [u32; 2]>,
    /// For each corner, whether it has no mesh number and all edges at it are between coplanar faces.
    is_corner_internal: Vec<bool>,
    /// The faces around each internal corner.
    faces_around_internal_corner: HashMap<u32, Vec<u32>>,
    /// The first triangle of each face of the mesh; a face may have several triangles.
    first_triangle_by_feature: HashMap<Feature, u32>,
    /// The sum of the normals of the faces around each corner.
    corner_normal_sums: Vec<DVec3>,
}

/// A vertex that triangles of the surface share.
struct Corner {
    position: DVec3,
    position_bits: PointBits,
    /// The corner's number in the mesh, if its piece has one.
    id: Option<u32>,
}

/// A triangle of the surface. A segment or a point is a triangle that repeats its last corner.
pub(super) struct Face {
    pub(super) corners: [u32; 3],
    pub(super) piece: u32,
    pub(super) radius: f64,
    name: Feature,
}

/// A corner, an edge or a face of the surface, by its index here rather than in the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) enum SurfacePart {
    Corner(u32),
    Edge([u32; 2]),
    Face(u32),
}

/// The bit pattern of a point's coordinates in the body's frame.
type PointBits = [u64; 3];

impl<'a> NearSurface<'a> {
    /// Creates the surface of a body without any triangles; `to_a` maps the body's frame to A's.
    pub(super) fn new(body: &'a Body, to_a: Frame) -> Self {
        NearSurface {
            body,
            body_to_a: to_a,
            corners: Vec::new(),
            faces: Vec::new(),
            corner_indices: HashMap::new(),
            coplanar_edges: HashMap::new(),
            is_corner_internal: Vec::new(),
            faces_around_internal_corner: HashMap::new(),
            first_triangle_by_feature: HashMap::new(),
            corner_normal_sums: Vec::new(),
        }
    }

    /// Finds the edges and corners that exist only because flat parts are cut into triangles. It is to be called after
    /// all needed pieces are added. Heights up to `rounding` count as flat.
    pub(super) fn find_internal_features(&mut self, rounding: f64) {
        self.propagate_mesh_vertex_numbers();
        self.compute_corner_normal_sums();
        let mut faces_at_edge: HashMap<[u32; 2], Vec<u32>> = HashMap::new();
        for (face, Face { corners, name, .. }) in (0u32..).zip(&self.faces) {
            if let Feature::Face(_) = name {
                self.first_triangle_by_feature.entry(*name).or_insert(face);
            }
            for ends in triangle_edges(*corners) {
                faces_at_edge.entry(ends).or_default().push(face);
            }
        }
        self.is_corner_internal = self.corners.iter().map(|c| c.id.is_none()).collect();
        // Segments and points are not within a plane.
        let thin = |face: &&Face| triangle_edges(face.corners).count() < 3;
        for corner in self.faces.iter().filter(thin).flat_map(|face| face.corners) {
            self.is_corner_internal[corner as usize] = false;
        }
        for (ends, faces) in faces_at_edge {
            match <[u32; 2]>::try_from(faces) {
                Ok(mut faces) if self.are_coplanar(ends, faces, rounding) => {
                    faces.sort_by_key(|&face| (self.face(face).name, face));
                    self.coplanar_edges.insert(ends, faces);
                }
                _ => {
                    for end in ends {
                        self.is_corner_internal[end as usize] = false;
                    }
                }
            }
        }
        for (face, Face { corners, .. }) in (0u32..).zip(&self.faces) {
            let hidden = corners
                .iter()
                .filter(|&&k| self.is_corner_internal[k as usize]);
            for &corner in hidden {
                let around = self.faces_around_internal_corner.entry(corner);
                around.or_default().push(face);
            }
        }
    }

    pub(super) fn face(&self, face: u32) -> &Face {
        &self.faces[face as usize]
    }

    pub(super) fn triangle(&self, face: u32) -> [DVec3; 3] {
        self.face(face)
            .corners
            .map(|corner| self.corner_position(corner))
    }

    pub(super) fn corner_position(&self, corner: u32) -> DVec3 {
        self.corners[corner as usize].position
    }

    /// Returns three points, possibly equal, whose convex hull is the given corner, edge or face.
    pub(super) fn part_points(&self, spot: SurfacePart, face: u32) -> [DVec3; 3] {
        match spot {
            SurfacePart::Corner(corner) => [self.corner_position(corner); 3],
            SurfacePart::Edge([v, w]) => [v, w, w].map(|end| self.corner_position(end)),
            SurfacePart::Face(_) => self.triangle(face),
        }
    }

    /// Returns the approximate outward direction at a corner, edge or face: the sum of the normals around it, or zero
    /// if none is known.
    pub(super) fn outward_direction(&self, spot: SurfacePart, face: u32) -> DVec3 {
        let at = |corner: u32| self.corner_normal_sums[corner as usize];
        match spot {
            SurfacePart::Corner(corner) => at(corner),
            SurfacePart::Edge([v, w]) => at(v) + at(w),
            SurfacePart::Face(_) => self.normal(face),
        }
    }

    /// Returns the unit normal of a face that points out of the body; zero if that normal is unknown.
    fn normal(&self, face: u32) -> DVec3 {
        let piece = self.face(face).piece;
        if let Some(normal) = self.body.outward_normal(piece) {
            return self.body_to_a.rotation * normal;
        }
        let [a, b, c] = self.triangle(face);
        let unknown = self.body.pieces().get(piece as usize).is_flat();
        if unknown {
            DVec3::ZERO
        } else {
            normal([a, b, c]).unwrap_or(DVec3::ZERO)
        }
    }

    pub(super) fn face_indices(&self) -> Range<u32> {
        0..self.faces.len() as u32
    }

    /// Calls `look` with the corners of a face, and with a point of the solid below it. If the piece of the face has no
    /// facets, all its points take the place of the corners.
    pub(super) fn for_each_face_point(&self, face: u32, look: impl FnMut(DVec3)) {
        let index = self.face(face).piece;
        let piece = self.body.pieces().get(index as usize);
        let corners = self.triangle(face);
        let points = if piece.facets.is_empty() {
            piece.points
        } else {
            &[]
        };
        let inside = self.body.interior_point(index);
        let placed = points
            .iter()
            .chain(&inside)
            .map(|&point| self.body_to_a.transform_point(point));
        corners.into_iter().chain(placed).for_each(look);
    }

    /// Returns the mean of a piece's points, in A's frame.
    pub(super) fn mean_of_points(&self, piece: u32) -> DVec3 {
        self.body_to_a
            .transform_point(self.body.mean_of_points(piece))
    }

    /// Returns the edges and corners on the boundary of an edge or face.
    pub(super) fn boundary_of_part(&self, spot: SurfacePart) -> Vec<SurfacePart> {
        match spot {
            SurfacePart::Corner(_) => Vec::new(),
            SurfacePart::Edge(ends) => ends.map(SurfacePart::Corner).to_vec(),
            SurfacePart::Face(face) => {
                let corners = self.face(face).corners;
                let ends = corners.into_iter().map(SurfacePart::Corner);
                ends.chain(triangle_edges(corners).map(SurfacePart::Edge))
                    .collect()
            }
        }
    }

    /// Returns the coplanar faces around an edge or corner that is inside a flat part; empty for others.
    pub(super) fn coplanar_faces_around(&self, spot: SurfacePart) -> &[u32] {
        let faces = match spot {
            SurfacePart::Corner(corner) => self
                .faces_around_internal_corner
                .get(&corner)
                .map(Vec::as_slice),
            SurfacePart::Edge(ends) => self.coplanar_edges.get(&ends).map(<[u32; 2]>::as_slice),
            SurfacePart::Face(_) => None,
        };
        faces.unwrap_or_default()
    }

    /// Returns the corner, edge or face that a contact reports for `spot`, and a face that contains `spot`. Edges and
    /// corners inside a flat part are replaced by a face. Triangles with the same face number are one face.
    pub(super) fn reported_part(&self, spot: SurfacePart, face: u32) -> (SurfacePart, u32) {
        let hiding_face = match spot {
            SurfacePart::Corner(corner) => self.is_corner_internal[corner as usize].then_some(face),
            SurfacePart::Edge(ends) => self.face_of_coplanar_edge(ends),
            SurfacePart::Face(face) => Some(face),
        };
        let Some(face) = hiding_face else {
            return (spot, face);
        };
        let first = self.first_triangle_by_feature.get(&self.face(face).name);
        (SurfacePart::Face(first.copied().unwrap_or(face)), face)
    }

    /// Returns the vertex, edge or face of the mesh for a part of the surface. If the part has no number, the feature
    /// is that of the face `face`, or the piece.
    pub(super) fn feature_of(&self, spot: SurfacePart, face: u32) -> Feature {
        let id = |corner: u32| self.mesh_vertex_number(corner);
        let own = match spot {
            SurfacePart::Corner(corner) => id(corner).map(Feature::Vertex),
            SurfacePart::Edge([v, w]) => id(v).zip(id(w)).map(|(v, w)| Feature::edge(v, w)),
            SurfacePart::Face(_) => None,
        };
        own.unwrap_or(self.face(face).name)
    }

    /// Returns the distinct corners of a face that are not hidden.
    pub(super) fn reportable_corners_of(&self, face: u32) -> impl Iterator<Item = u32> + use<'_> {
        let corners = self.face(face).corners;
        let first = (0..3).filter(move |&k| !corners[..k].contains(&corners[k]));
        let shown = |corner: &u32| !self.is_corner_internal[*corner as usize];
        first.map(move |k| corners[k]).filter(shown)
    }

    /// Returns the edges of a face, except those between coplanar faces.
    pub(super) fn reportable_edges_of(
        &self,
        face: u32,
    ) -> impl Iterator<Item = [u32; 2]> + use<'_> {
        triangle_edges(self.face(face).corners)
            .filter(|&ends| self.face_of_coplanar_edge(ends).is_none())
    }

    /// Returns the face to which points on an edge between coplanar faces belong; `None` for other edges.
    pub(super) fn face_of_coplanar_edge(&self, ends: [u32; 2]) -> Option<u32> {
        self.coplanar_edges.get(&ends).map(|faces| faces[0])
    }

    fn compute_corner_normal_sums(&mut self) {
        let mut outward = vec![DVec3::ZERO; self.corners.len()];
        for face in 0..self.faces.len() as u32 {
            let normal = self.normal(face);
            for corner in self.face(face).corners {
                outward[corner as usize] += normal;
            }
        }
        self.corner_normal_sums = outward;
    }

    /// Copies mesh numbers to corners without one, from corners of other pieces at the same position.
    fn propagate_mesh_vertex_numbers(&mut self) {
        let mut numbered: HashMap<PointBits, (u32, u32)> = HashMap::new();
        for (k, corner) in (0u32..).zip(&self.corners) {
            if let Some(id) = corner.id {
                let least = numbered.entry(corner.position_bits).or_insert((id, k));
                *least = (*least).min((id, k));
            }
        }
        for corner in self.faces.iter_mut().flat_map(|face| &mut face.corners) {
            let known = &self.corners[*corner as usize];
            if let (None, Some(&(_, other))) = (known.id, numbered.get(&known.position_bits)) {
                *corner = other;
            }
        }
    }

    /// Returns whether two faces with a common edge are coplanar. They are if neither rises above the other's plane, or
    /// if they are cut from one facet.
    fn are_coplanar(&self, ends: [u32; 2], faces: [u32; 2], rounding: f64) -> bool {
        let [one, other] = faces.map(|face| self.face(face));
        // Rounding moves their surfaces off the plane by different radii.
        if one.radius.to_bits() != other.radius.to_bits() {
            return false;
        }
        let named = matches!(one.name, Feature::Face(_));
        if named && one.name == other.name && one.piece == other.piece {
            return true;
        }
        let tips = faces.map(|face| {
            let corners = self.face(face).corners;
            corners.into_iter().find(|corner| !ends.contains(corner))
        });
        let ([Some(p), Some(q)], [a, b]) = (tips, ends.map(|end| self.corner_position(end))) else {
            return false;
        };
        let [p, q] = [p, q].map(|tip| self.corner_position(tip) - a);
        let normals = [p, q].map(|tip| unit(vector_perpendicular_to_both(b - a, tip)));
        let [Some(n), Some(m)] = normals else {
            return false;
        };
        greater(n.dot(q).abs(), m.dot(p).abs()) <= rounding && n.dot(m) < 0.0
    }
}

/// Returns the distinct edges of a triangle, each with its smaller corner index first. A segment has one edge, a point
/// none.
pub(super) fn triangle_edges(corners: [u32; 3]) -> impl Iterator<Item = [u32; 2]> {
    let ends = move |k: usize| triangle_edge(corners, k);
    let proper = move |&k: &usize| ends(k)[0] != ends(k)[1] && !(0..k).any(|j| ends(j) == ends(k));
    (0..3).filter(proper).map(ends)
}

/// Returns the edge from corner `k` of a triangle to the next corner, with the smaller corner index first.
pub(super) fn triangle_edge(corners: [u32; 3], k: usize) -> [u32; 2] {
    let (v, w) = (corners[k], corners[(k + 1) % 3]);
    [v.min(w), v.max(w)]
}
