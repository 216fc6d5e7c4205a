//! The pieces of one body, flat in memory.

use crate::error::InputError;
use crate::feature::Feature;
use crate::piece::{Facets, Piece, Polytope};
use crate::tolerance::MAX_COORDINATE;
use glam::DVec3;

/// The pieces of one body, flat in memory, with the numbers of the mesh they came from.
#[derive(Clone, Debug)]
pub struct Pieces {
    points: Vec<DVec3>,
    vertex_ids: Vec<u32>,
    /// Where each piece's points end.
    point_ends: Vec<u32>,
    radii: Radii,
    shape: Shape,
}

/// Indices are kept in 32 bits, of which a quarter names points and the rest has room for nodes.
const MAX_POINTS: usize = u32::MAX as usize / 4;

#[derive(Clone, Debug)]
enum Radii {
    Zero,
    Each(Vec<f64>),
}

#[derive(Clone, Debug)]
enum Shape {
    /// Every piece is a triangle; the mesh's number of each.
    Triangles { face_ids: Vec<u32> },
    Polytopes {
        /// Where each piece's facets end in `corner_ends` and `facet_ids`.
        facet_ends: Vec<u32>,
        facet_ids: Vec<u32>,
        corner_ends: Vec<u32>,
        corners: Vec<u32>,
    },
}

impl Pieces {
    /// One piece per triangle of a mesh or soup; `face_ids[k]` is the number `faces[k]` goes by.
    ///
    /// # Errors
    /// [`InputError::VertexOutOfRange`], [`InputError::BadPoint`], [`InputError::NoPieces`],
    /// [`InputError::FaceIds`], [`InputError::TooManyPieces`].
    pub fn triangles(
        vertices: &[DVec3],
        faces: &[[u32; 3]],
        face_ids: &[u32],
    ) -> Result<Self, InputError> {
        if faces.len() != face_ids.len() {
            return Err(InputError::FaceIds {
                faces: faces.len(),
                ids: face_ids.len(),
            });
        }
        if faces.len() >= MAX_POINTS / 3 {
            return Err(InputError::TooManyPieces {
                pieces: faces.len(),
            });
        }
        for (face, corners) in faces.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices.len()) {
                return Err(InputError::VertexOutOfRange {
                    face,
                    vertex,
                    vertices: vertices.len(),
                });
            }
        }
        let vertex_ids: Vec<u32> = faces.iter().flatten().copied().collect();
        Pieces {
            points: vertex_ids.iter().map(|&v| vertices[v as usize]).collect(),
            vertex_ids,
            point_ends: (1..=faces.len()).map(|k| 3 * k as u32).collect(),
            radii: Radii::Zero,
            shape: Shape::Triangles {
                face_ids: face_ids.to_vec(),
            },
        }
        .checked()
    }

    /// Convex polytopes, balls and capsules among them.
    ///
    /// # Guarantee
    /// The piece is the hull of the points; facets only serve to name features and to confirm
    /// overlaps, so that a wrong facet list cannot make a query late.
    ///
    /// # Errors
    /// [`InputError::EmptyPiece`], [`InputError::BadPoint`], [`InputError::BadRadius`],
    /// [`InputError::FacetOutOfRange`], [`InputError::NoPieces`], [`InputError::TooManyPieces`].
    pub fn polytopes(polytopes: &[Polytope]) -> Result<Self, InputError> {
        let (mut points, mut vertex_ids, mut point_ends) = (Vec::new(), Vec::new(), Vec::new());
        let (mut facet_ends, mut facet_ids) = (Vec::new(), Vec::new());
        let (mut corner_ends, mut corners) = (Vec::new(), Vec::new());
        for (piece, polytope) in polytopes.iter().enumerate() {
            let count = polytope.points.len();
            points.extend_from_slice(&polytope.points);
            if polytope.vertex_ids.len() == count {
                vertex_ids.extend_from_slice(&polytope.vertex_ids);
            } else {
                vertex_ids.extend(0..count as u32);
            }
            point_ends.push(points.len() as u32);
            for (facet, it) in polytope.facets.iter().enumerate() {
                if it.corners.len() < 3 || it.corners.iter().any(|&c| c as usize >= count) {
                    return Err(InputError::FacetOutOfRange { piece, facet });
                }
                corners.extend_from_slice(&it.corners);
                corner_ends.push(corners.len() as u32);
                facet_ids.push(it.id);
            }
            facet_ends.push(facet_ids.len() as u32);
        }
        Pieces {
            points,
            vertex_ids,
            point_ends,
            radii: Radii::Each(polytopes.iter().map(|p| p.radius).collect()),
            shape: Shape::Polytopes {
                facet_ends,
                facet_ids,
                corner_ends,
                corners,
            },
        }
        .checked()
    }

    fn checked(self) -> Result<Self, InputError> {
        if self.point_ends.is_empty() {
            return Err(InputError::NoPieces);
        }
        if self.points.len() >= MAX_POINTS {
            return Err(InputError::TooManyPieces {
                pieces: self.point_ends.len(),
            });
        }
        for piece in 0..self.len() {
            let points = &self.points[self.point_range(piece)];
            if points.is_empty() {
                return Err(InputError::EmptyPiece { piece });
            }
            // Written so that NaN fails.
            let good = |p: &DVec3| p.abs().max_element() <= MAX_COORDINATE && p.is_finite();
            if let Some(point) = points.iter().position(|p| !good(p)) {
                return Err(InputError::BadPoint { piece, point });
            }
            let radius = self.radius(piece);
            if !(0.0..=MAX_COORDINATE).contains(&radius) {
                return Err(InputError::BadRadius { piece });
            }
        }
        Ok(self)
    }

    /// How many pieces there are: at least one.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.point_ends.len()
    }

    /// Whether every piece is a triangle without rounding.
    pub fn all_triangles(&self) -> bool {
        matches!(self.shape, Shape::Triangles { .. })
    }

    /// One piece.
    ///
    /// # Panics
    /// When `index` is not below [`Pieces::len`].
    #[inline]
    pub fn get(&self, index: usize) -> Piece<'_> {
        Piece {
            points: &self.points[self.point_range(index)],
            radius: self.radius(index),
            facets: self.facets(index),
        }
    }

    /// All pieces in order.
    pub fn iter(&self) -> impl Iterator<Item = Piece<'_>> {
        (0..self.len()).map(|k| self.get(k))
    }

    /// All points of all pieces in order; points that pieces share appear once for each.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// Bytes held, about.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(self.points.as_slice()) + 4 * (self.vertex_ids.len() + 2 * self.len())
    }

    /// The three corners of a piece of which [`Pieces::all_triangles`] holds.
    #[inline]
    pub(crate) fn triangle(&self, index: usize) -> [DVec3; 3] {
        let corners = &self.points[3 * index..3 * index + 3];
        [corners[0], corners[1], corners[2]]
    }

    /// All points of consecutive pieces.
    pub(crate) fn points_of(&self, pieces: std::ops::Range<usize>) -> &[DVec3] {
        let start = self.point_range(pieces.start).start;
        &self.points[start..self.point_ends[pieces.end - 1] as usize]
    }

    /// The same pieces in another order: piece `k` of the result is piece `order[k]` of this.
    pub(crate) fn reordered(&self, order: &[u32]) -> Pieces {
        let mut out = Pieces {
            points: Vec::with_capacity(self.points.len()),
            vertex_ids: Vec::with_capacity(self.points.len()),
            point_ends: Vec::with_capacity(self.len()),
            radii: match &self.radii {
                Radii::Zero => Radii::Zero,
                Radii::Each(radii) => {
                    Radii::Each(order.iter().map(|&k| radii[k as usize]).collect())
                }
            },
            shape: self.shape.reordered(order),
        };
        for &k in order {
            let range = self.point_range(k as usize);
            out.points.extend_from_slice(&self.points[range.clone()]);
            out.vertex_ids.extend_from_slice(&self.vertex_ids[range]);
            out.point_ends.push(out.points.len() as u32);
        }
        out
    }

    /// What the hull of some points of a piece is called in the mesh: the vertex, edge or face that
    /// holds them all.
    ///
    /// `support` are indices into the piece's points, one to three of them distinct.
    pub fn feature(&self, piece: usize, support: &[u32]) -> Feature {
        let id = |corner: u32| self.vertex_ids[self.point_range(piece).start + corner as usize];
        match support {
            [] => Feature::Piece(piece as u32),
            [v] => Feature::Vertex(id(*v)),
            _ => match &self.shape {
                Shape::Triangles { face_ids } => match support {
                    [v, w] => Feature::edge(id(*v), id(*w)),
                    _ => Feature::Face(face_ids[piece]),
                },
                Shape::Polytopes { .. } => self.polytope_feature(piece, support, id),
            },
        }
    }

    fn polytope_feature(&self, piece: usize, support: &[u32], id: impl Fn(u32) -> u32) -> Feature {
        let facets = self.facets(piece);
        if let [v, w] = support {
            let adjacent = |loop_: &[u32]| {
                (0..loop_.len()).any(|k| {
                    let pair = (loop_[k], loop_[(k + 1) % loop_.len()]);
                    pair == (*v, *w) || pair == (*w, *v)
                })
            };
            if facets.is_empty() || facets.iter().any(adjacent) {
                return Feature::edge(id(*v), id(*w));
            }
        }
        let holding = facets
            .iter()
            .position(|loop_| support.iter().all(|v| loop_.contains(v)));
        match holding {
            Some(facet) => Feature::Face(self.facet_id(piece, facet)),
            None => Feature::Piece(piece as u32),
        }
    }

    #[inline]
    pub(crate) fn point_range(&self, piece: usize) -> std::ops::Range<usize> {
        range(&self.point_ends, piece)
    }

    #[inline]
    fn radius(&self, piece: usize) -> f64 {
        match &self.radii {
            Radii::Zero => 0.0,
            Radii::Each(radii) => radii[piece],
        }
    }

    #[inline]
    fn facets(&self, piece: usize) -> Facets<'_> {
        match &self.shape {
            Shape::Triangles { .. } => Facets::NONE,
            Shape::Polytopes {
                facet_ends,
                corner_ends,
                corners,
                ..
            } => {
                let facets = range(facet_ends, piece);
                Facets {
                    base: match facets.start {
                        0 => 0,
                        start => corner_ends[start - 1],
                    },
                    ends: &corner_ends[facets],
                    corners,
                }
            }
        }
    }

    fn facet_id(&self, piece: usize, facet: usize) -> u32 {
        match &self.shape {
            Shape::Triangles { face_ids } => face_ids[piece],
            Shape::Polytopes {
                facet_ends,
                facet_ids,
                ..
            } => facet_ids[range(facet_ends, piece).start + facet],
        }
    }
}

impl Shape {
    fn reordered(&self, order: &[u32]) -> Shape {
        match self {
            Shape::Triangles { face_ids } => Shape::Triangles {
                face_ids: order.iter().map(|&k| face_ids[k as usize]).collect(),
            },
            Shape::Polytopes {
                facet_ends,
                facet_ids,
                corner_ends,
                corners,
            } => {
                let (mut ends, mut ids) = (Vec::new(), Vec::new());
                let (mut out_corner_ends, mut out_corners) = (Vec::new(), Vec::new());
                for &k in order {
                    for facet in range(facet_ends, k as usize) {
                        out_corners.extend_from_slice(&corners[range(corner_ends, facet)]);
                        out_corner_ends.push(out_corners.len() as u32);
                        ids.push(facet_ids[facet]);
                    }
                    ends.push(ids.len() as u32);
                }
                Shape::Polytopes {
                    facet_ends: ends,
                    facet_ids: ids,
                    corner_ends: out_corner_ends,
                    corners: out_corners,
                }
            }
        }
    }
}

/// The `k`-th range of a list given by the ends of its ranges.
#[inline]
fn range(ends: &[u32], k: usize) -> std::ops::Range<usize> {
    let start = if k == 0 { 0 } else { ends[k - 1] };
    start as usize..ends[k] as usize
}

#[cfg(test)]
mod tests;
