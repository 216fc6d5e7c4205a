//! Describes the geometry of a shape in double precision, from which a body is made.

use crate::closed::find_open_edge;
use crate::order::{greater, length};
use crate::tolerance::POSE_ROUNDING;
use crate::{Excess, ShapeError};
use ccd_core::glam::DVec3;
use ccd_core::{
    Body, ConvexCombination, EnclosingPolytope, Facet, FacetOrigin, Feature, InputError, Pieces,
    Polytope, Pose, SolidOfRevolution, Solidity,
};
use std::borrow::Cow;
use std::iter::repeat;

/// The geometry of a shape: triangles and convex parts.
///
/// A body is made of this alone: equal geometries make equal bodies.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ShapeGeometry {
    vertices: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// The sub-shape index of each triangle.
    triangle_sub_shape_indices: Vec<u32>,
    parts: Vec<Part>,
    /// A cylinder or a cone, the radius by which it is grown, and the allowed excess, if the geometry is that shape
    /// alone.
    grown_solid_of_revolution: Option<(SolidOfRevolution, f64, Excess)>,
    volume: Solidity,
    /// A bound on the rounding error of points, as a length.
    pub(crate) slack: f64,
    /// A bound on how far polytopes extend beyond the round shapes that they enclose.
    pub(crate) excess: f64,
    /// The boundary as triangles with their sub-shape indices, for the polytope of a cylinder or a cone that is not
    /// grown.
    surface: Option<(Vec<[u32; 3]>, Vec<u32>)>,
}

/// A convex part of a geometry: the hull of points, grown by a radius.
#[derive(Clone, Debug, PartialEq)]
struct Part {
    polytope: Polytope,
    /// The sub-shape index of the part.
    sub_shape_index: u32,
}

impl ShapeGeometry {
    /// The empty geometry, to which vertices, triangles and parts are added. It is a surface, not a solid.
    pub(crate) const EMPTY: ShapeGeometry = ShapeGeometry {
        vertices: Vec::new(),
        triangles: Vec::new(),
        triangle_sub_shape_indices: Vec::new(),
        parts: Vec::new(),
        grown_solid_of_revolution: None,
        volume: Solidity::Surface,
        slack: 0.0,
        excess: 0.0,
        surface: None,
    };

    /// Returns the geometry of a cylinder or a cone, grown by a radius; its polytope is made later, with the body.
    pub(crate) fn from_solid_of_revolution(
        round: SolidOfRevolution,
        radius: f64,
        excess: Excess,
    ) -> Self {
        ShapeGeometry {
            grown_solid_of_revolution: Some((round, radius, excess)),
            ..ShapeGeometry::EMPTY
        }
    }

    /// Returns the geometry with a polytope in place of its cylinder or cone, or unchanged if it has neither.
    pub(crate) fn with_enclosing_polytope(&self) -> Result<Cow<'_, ShapeGeometry>, ShapeError> {
        let Some((round, radius, excess)) = &self.grown_solid_of_revolution else {
            return Ok(Cow::Borrowed(self));
        };
        let enclosing = polytope_around(round, *excess)?;
        let (triangles, face_indices) = enclosing.triangles();
        let has_surface = *radius == 0.0 && !triangles.is_empty();
        let to_parry_axes = |point: &DVec3| DVec3::new(point.y, point.z, point.x);
        let polytope = Polytope {
            // The engine's axis is z, parry's is y.
            points: enclosing
                .polytope()
                .points
                .iter()
                .map(to_parry_axes)
                .collect(),
            radius: *radius,
            ..enclosing.polytope().clone()
        };
        Ok(Cow::Owned(ShapeGeometry {
            parts: vec![Part {
                polytope,
                sub_shape_index: 0,
            }],
            excess: enclosing.excess(),
            surface: has_surface.then_some((triangles, face_indices)),
            ..ShapeGeometry::EMPTY
        }))
    }

    /// Adds the hull of some points, grown by a radius, as a part with the sub-shape index `number`.
    pub(crate) fn push_hull<L: AsRef<[u32]>>(
        &mut self,
        points: Vec<DVec3>,
        radius: f64,
        loops: impl IntoIterator<Item = L>,
        number: u32,
    ) {
        let facet = |(id, corners): (u32, L)| Facet {
            origin: FacetOrigin::Face(id),
            corners: corners.as_ref().to_vec(),
        };
        let polytope = Polytope {
            points,
            radius,
            facets: (0..).zip(loops).map(facet).collect(),
            ..Polytope::default()
        };
        self.parts.push(Part {
            polytope,
            sub_shape_index: number,
        });
    }

    /// Adds the hull of points, grown by a radius, as a part with the sub-shape index `number`; it lists no facets.
    pub(crate) fn push_hull_of_points<const N: usize>(
        &mut self,
        points: [DVec3; N],
        radius: f64,
        number: u32,
    ) {
        self.push_hull(points.to_vec(), radius, [[0; 0]; 0], number);
    }

    /// Adds the box between its lowest and its highest corner, grown by a radius.
    pub(crate) fn push_box(&mut self, low: DVec3, high: DVec3, radius: f64) {
        let pick = |corner: u32, bit: u32| [low, high][(corner >> bit & 1) as usize];
        let corner = |k| DVec3::new(pick(k, 0).x, pick(k, 1).y, pick(k, 2).z);
        self.push_box_of_corners((0..8).map(corner).collect(), radius);
    }

    /// Adds a box given by its eight corners: bits 0, 1 and 2 of `k` are set if corner `k` is high along the first,
    /// second and third axis of a right-handed frame.
    pub(crate) fn push_box_of_corners(&mut self, corners: Vec<DVec3>, radius: f64) {
        self.push_hull(corners, radius, BOX_FACES, 0);
    }

    /// Adds triangles, with their sub-shape indices.
    pub(crate) fn push_triangles(
        &mut self,
        vertices: impl IntoIterator<Item = DVec3>,
        faces: &[[u32; 3]],
        numbers: impl IntoIterator<Item = u32>,
    ) {
        let first = self.vertices.len() as u32;
        self.vertices.extend(vertices);
        let corners = |face: &[u32; 3]| face.map(|corner| first.saturating_add(corner));
        self.triangles.extend(faces.iter().map(corners));
        (self.triangle_sub_shape_indices).extend(numbers.into_iter().take(faces.len()));
    }

    /// Returns the geometry of the solid whose surface the triangles are.
    ///
    /// # Errors
    /// [`ShapeError::OpenMesh`] unless they are closed.
    pub(crate) fn into_solid(self) -> Result<Self, ShapeError> {
        match find_open_edge(&self.vertices, &self.triangles) {
            Some([from, to]) => Err(ShapeError::OpenMesh {
                from,
                other_end_index: to,
            }),
            None => Ok(ShapeGeometry {
                volume: Solidity::Solid,
                ..self
            }),
        }
    }

    /// Adds another geometry at a pose, with `number` as the sub-shape index of all its parts.
    pub(crate) fn push_at_pose(
        &mut self,
        pose: &Pose,
        inner: &ShapeGeometry,
        number: u32,
    ) -> Result<(), ShapeError> {
        let inner = inner.with_enclosing_polytope()?;
        let to_outer = |point: &DVec3| pose.transform_point(*point);
        let reach = (inner.points()).fold(0.0, |most, point| greater(most, length(*point)));
        let rounding = if *pose == Pose::IDENTITY {
            0.0
        } else {
            POSE_ROUNDING * (reach + length(pose.translation()))
        };
        let vertices = inner.vertices.iter().map(to_outer);
        self.push_triangles(vertices, &inner.triangles, repeat(number));
        for Part { polytope, .. } in &inner.parts {
            let points = polytope.points.iter().map(to_outer).collect();
            let polytope = Polytope {
                points,
                ..polytope.clone()
            };
            self.parts.push(Part {
                polytope,
                sub_shape_index: number,
            });
        }
        self.slack = greater(self.slack, inner.slack + rounding);
        self.excess = greater(self.excess, inner.excess);
        Ok(())
    }

    /// Returns the approximate memory use in bytes.
    pub(crate) fn memory_usage(&self) -> usize {
        let of_facet = |facet: &Facet| 32 + 4 * facet.corners.len();
        let of_part = |Part { polytope, .. }: &Part| {
            let facets: usize = polytope.facets.iter().map(of_facet).sum();
            24 * polytope.points.len() + facets + 128
        };
        let parts: usize = self.parts.iter().map(of_part).sum();
        24 * self.vertices.len() + 16 * self.triangles.len() + parts
    }

    /// Returns an enclosing ball: its center, and its radius rounded up.
    pub(crate) fn enclosing_ball(&self) -> (DVec3, f64) {
        let (low, high) = self
            .points()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
                (low.min(*p), high.max(*p))
            });
        let center = 0.5 * low + 0.5 * high;
        let of_part = |part: &Part| {
            max_distance_from(part.polytope.points.iter(), center) + part.polytope.radius
        };
        let parts = self.parts.iter().map(of_part).fold(0.0, greater);
        let radius = greater(parts, max_distance_from(self.vertices.iter(), center));
        (center, radius * crate::tolerance::ROUNDING_ENLARGEMENT)
    }

    /// Returns the center if the geometry is a single ball; `None` for other geometries.
    pub(crate) fn center_if_ball(&self) -> Option<DVec3> {
        match &self.parts[..] {
            [part] if self.triangles.is_empty() => match part.polytope.points[..] {
                [point] => Some(point),
                _ => None,
            },
            _ => None,
        }
    }

    fn points(&self) -> impl Iterator<Item = &DVec3> {
        let parts = self.parts.iter().flat_map(|part| &part.polytope.points);
        self.vertices.iter().chain(parts)
    }

    /// Makes the body, and returns it with the sub-shape index of each of its pieces, in the body's order.
    ///
    /// # Errors
    /// [`ShapeError::Piece`] that names the sub-shape, [`ShapeError::Body`].
    pub(crate) fn body(&self) -> Result<(Body, Vec<u32>), ShapeError> {
        let result = match (&self.parts[..], self.triangles.is_empty()) {
            (parts, true) => self.body_of_parts(parts),
            ([], false) => Pieces::from_triangles(
                &self.vertices,
                &self.triangles,
                &self.triangle_sub_shape_indices,
            )
            .and_then(|pieces| Body::new(&pieces, self.volume)),
            (parts, false) => self.body_of_parts(&self.parts_and_triangles(parts)),
        };
        let body = result.map_err(|error| self.shape_error(error))?;
        let sub_shape_indices =
            (0..body.pieces().len()).map(|k| self.sub_shape_index_of_piece(&body, k));
        let sub_shape_indices = sub_shape_indices.collect();
        Ok((body, sub_shape_indices))
    }

    fn body_of_parts(&self, parts: &[Part]) -> Result<Body, InputError> {
        if let [part] = parts {
            let body = Body::polytope(part.polytope.clone())?;
            return match &self.surface {
                Some((faces, numbers)) => {
                    let pieces = Pieces::from_triangles(&part.polytope.points, faces, numbers)?;
                    body.with_surface_triangles(Body::new(&pieces, Solidity::Solid)?)
                }
                None => Ok(body),
            };
        }
        // Corners have the number of their part, which identifies pieces after reordering.
        let numbered = |part: &Part| Polytope {
            vertex_ids: vec![part.sub_shape_index; part.polytope.points.len()],
            ..part.polytope.clone()
        };
        let pieces = Pieces::from_polytopes(&parts.iter().map(numbered).collect::<Vec<_>>())?;
        // Each convex piece is solid, also as a part of a surface.
        Body::new(&pieces, Solidity::Surface)
    }

    /// Returns the given parts, followed by the triangles, each as a part of its own.
    fn parts_and_triangles(&self, parts: &[Part]) -> Vec<Part> {
        // A missing vertex becomes NaN, which the engine refuses.
        let corner = |v: &u32| *self.vertices.get(*v as usize).unwrap_or(&DVec3::NAN);
        let of_face = |(face, number): (&[u32; 3], &u32)| Part {
            polytope: Polytope {
                points: face.iter().map(corner).collect(),
                ..Polytope::default()
            },
            sub_shape_index: *number,
        };
        let faces = self
            .triangles
            .iter()
            .zip(&self.triangle_sub_shape_indices)
            .map(of_face);
        parts.iter().cloned().chain(faces).collect()
    }

    /// Returns the sub-shape index of a piece of the body.
    fn sub_shape_index_of_piece(&self, body: &Body, piece: usize) -> u32 {
        let inside = if body.pieces().are_all_triangles() {
            let mut inside = ConvexCombination::of_two_points([0, 1], 0.5);
            inside.add_weighted_point(2, 0.5);
            inside
        } else if self.parts.len() == 1 && self.triangles.is_empty() {
            return self.parts[0].sub_shape_index;
        } else {
            ConvexCombination::from_single_point(0)
        };
        match body.pieces().feature(piece, &inside) {
            Feature::Face(number) | Feature::Vertex(number) => number,
            Feature::Edge(..) | Feature::Piece(_) => 0,
        }
    }

    /// Converts an error of the engine, which has the index of a piece, to an error with the sub-shape index.
    fn shape_error(&self, error: InputError) -> ShapeError {
        let piece = match error {
            InputError::BadPoint { piece, .. }
            | InputError::BadRadius { piece, .. }
            | InputError::EmptyPiece { piece }
            | InputError::FacetOutOfRange { piece, .. }
            | InputError::BadFace { piece, .. } => Some(piece),
            InputError::VertexOutOfRange { face, .. } => Some(face + self.parts.len()),
            _ => None,
        };
        let number = |piece: usize| match self.parts.get(piece) {
            Some(part) => Some(part.sub_shape_index),
            None => self
                .triangle_sub_shape_indices
                .get(piece - self.parts.len())
                .copied(),
        };
        match piece.and_then(number) {
            Some(number) => ShapeError::Piece {
                element_index: number,
                error,
            },
            None => ShapeError::Body(error),
        }
    }
}

/// Returns a polytope around a cylinder or a cone, which exceeds it by at most `excess`.
fn polytope_around(
    round: &SolidOfRevolution,
    excess: Excess,
) -> Result<EnclosingPolytope, ShapeError> {
    let requested_excess = match excess {
        Excess::DefaultRadiusFraction => round.default_excess(),
        Excess::Length(length) => length,
        Excess::NotAllowed => return Err(ShapeError::SolidOfRevolutionRefused),
    };
    // Written so that NaN is refused.
    if !(requested_excess >= 0.0) {
        return Err(ShapeError::InvalidSize {
            what: "excess",
            value: requested_excess,
        });
    }
    let least_excess = round.least_excess();
    if requested_excess < least_excess {
        Err(ShapeError::ExcessTooSmall {
            requested_excess,
            least_excess,
        })
    } else {
        round
            .enclosing_polytope(requested_excess)
            .map_err(ShapeError::Body)
    }
}

/// The corners of each face of a box: bits 0, 1 and 2 of `k` are set if corner `k` is high in x, y and z.
const BOX_FACES: [[u32; 4]; 6] = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
];

fn max_distance_from<'a>(points: impl Iterator<Item = &'a DVec3>, from: DVec3) -> f64 {
    points.fold(0.0, |most, point| greater(most, length(*point - from)))
}

#[cfg(test)]
mod tests;
