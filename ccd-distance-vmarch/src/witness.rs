//! The nearest points of a pair of features, clamped to the features, and the axis between them.

use crate::edge_edge;
use crate::feature::{CommonPoint, Feature, Pair, WeightedCorners, WhichPolytope};
use crate::placed::{Line, PlacedPair, PlacedPolytope, RoundingScale, clamp_parameter};
use crate::polytope::Polytope;
use ccd_core::glam::DVec3;
use ccd_core::{Claim, ConvexCombination};

/// The nearest points of two features, and the axis between the features.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Witness {
    pub(crate) points: [DVec3; 2],
    /// The same points as combinations of the pieces' points, and an axis of any length from A to B.
    pub(crate) claim: Claim,
}

impl Witness {
    /// Computes the nearest points of a pair of features at which a march may stop. A march never stops at a face with
    /// an edge or a face; for these, two vertices are used.
    #[inline]
    pub(crate) fn new(placed: &PlacedPair<'_>, pair: Pair) -> Self {
        let PlacedPair { a, b, scale } = placed;
        match (pair.a, pair.b) {
            (Feature::Vertex(v), Feature::Vertex(w)) => vertex_vertex_witness(a, v, b, w),
            (Feature::Vertex(v), Feature::Edge(e)) => vertex_edge_witness(a, v, b, e),
            (Feature::Edge(e), Feature::Vertex(v)) => vertex_edge_witness(b, v, a, e).swapped(),
            (Feature::Edge(e), Feature::Edge(f)) => edge_edge_witness(a, e, b, f, *scale),
            (Feature::Vertex(v), Feature::Face(f)) => vertex_face_witness(a, v, b, f),
            (Feature::Face(f), Feature::Vertex(v)) => vertex_face_witness(b, v, a, f).swapped(),
            (x, y) => {
                vertex_vertex_witness(a, first_corner(a.shape(), x), b, first_corner(b.shape(), y))
            }
        }
    }

    pub(crate) fn separation_vector(&self) -> DVec3 {
        self.points[1] - self.points[0]
    }

    pub(crate) fn distance(&self) -> f64 {
        self.separation_vector().length()
    }

    #[inline]
    fn swapped(self) -> Self {
        let ([x, y], Claim { axis, a, b }) = (self.points, self.claim);
        Witness {
            points: [y, x],
            claim: Claim {
                axis: -axis,
                a: b,
                b: a,
            },
        }
    }
}

/// Returns the claim about a proven common point, along the normal of the crossed face.
pub(crate) fn common_point_claim(
    placed: &PlacedPair<'_>,
    which: WhichPolytope,
    crossing: &CommonPoint,
) -> Claim {
    let (a, b) = (&placed.a, &placed.b);
    let (edge_ends, face_corners) = (&crossing.edge_ends, &crossing.face_corners);
    match which {
        WhichPolytope::PolytopeX => Claim {
            axis: -b.vector(b.shape().face(crossing.face).normal),
            a: combination(a.shape(), edge_ends),
            b: combination(b.shape(), face_corners),
        },
        WhichPolytope::PolytopeY => Claim {
            axis: a.shape().face(crossing.face).normal,
            a: combination(a.shape(), face_corners),
            b: combination(b.shape(), edge_ends),
        },
    }
}

#[inline]
fn vertex_vertex_witness<X: PlacedPolytope, Y: PlacedPolytope>(
    x: &X,
    v: u32,
    y: &Y,
    w: u32,
) -> Witness {
    let points = [x.vertex(v), y.vertex(w)];
    Witness {
        points,
        claim: Claim {
            axis: points[1] - points[0],
            a: combination_at_corner(x, v),
            b: combination_at_corner(y, w),
        },
    }
}

#[inline]
fn vertex_edge_witness<X: PlacedPolytope, Y: PlacedPolytope>(
    x: &X,
    v: u32,
    y: &Y,
    e: u32,
) -> Witness {
    let (point, line) = (x.vertex(v), y.line(e));
    let parameter = line.nearest_parameter(point);
    let foot = line.point_at_parameter(parameter);
    let offset = foot - point;
    Witness {
        points: [point, foot],
        claim: Claim {
            axis: perpendicular_part(offset, line.direction),
            a: combination_at_corner(x, v),
            b: combination_on_edge(y, e, parameter),
        },
    }
}

#[inline]
fn edge_edge_witness<X: PlacedPolytope, Y: PlacedPolytope>(
    x: &X,
    e: u32,
    y: &Y,
    f: u32,
    scale: RoundingScale,
) -> Witness {
    let (one, other) = (x.line(e), y.line(f));
    let near = edge_edge::nearest_parameters(&one, &other);
    let [s, t] = near.parameters;
    let points = [one.point_at_parameter(s), other.point_at_parameter(t)];
    let offset = points[1] - points[0];
    let axis = near.axis(offset, scale).unwrap_or(offset);
    Witness {
        points,
        claim: Claim {
            // The part along the edges, which would cost their length, is removed.
            axis: perpendicular_part(perpendicular_part(axis, one.direction), other.direction),
            a: combination_on_edge(x, e, s),
            b: combination_on_edge(y, f, t),
        },
    }
}

#[inline]
fn vertex_face_witness<X: PlacedPolytope, Y: PlacedPolytope>(
    x: &X,
    v: u32,
    y: &Y,
    f: u32,
) -> Witness {
    let point = x.vertex(v);
    let normal = y.vector(y.shape().face(f).normal);
    let (foot, spot) = project_onto_face(point, y, f, normal);
    Witness {
        points: [point, foot],
        claim: Claim {
            axis: -normal,
            a: combination_at_corner(x, v),
            b: spot,
        },
    }
}

/// Returns the component of a vector perpendicular to a direction.
#[inline]
pub(crate) fn perpendicular_part(offset: DVec3, along: DVec3) -> DVec3 {
    offset - along * offset.dot(along)
}

#[inline]
fn first_corner(shape: &Polytope, feature: Feature) -> u32 {
    match feature {
        Feature::Vertex(v) => v,
        Feature::Edge(e) => shape.edge(e).ends[0],
        Feature::Face(f) => shape.sides_of(f).first().map_or(0, |side| side.vertex),
    }
}

/// Converts weighted vertices of a polytope to a combination of the piece's points.
#[inline]
fn combination<const N: usize>(
    shape: &Polytope,
    corners: &WeightedCorners<N>,
) -> ConvexCombination {
    let mut out = ConvexCombination::EMPTY;
    for (v, weight) in corners.vertices.into_iter().zip(corners.weights) {
        out.add_weighted_point(shape.vertex(v).point_index, weight);
    }
    out
}

#[inline]
fn combination_at_corner<P: PlacedPolytope>(polytope: &P, v: u32) -> ConvexCombination {
    ConvexCombination::from_single_point(polytope.shape().vertex(v).point_index)
}

#[inline]
fn combination_on_edge<P: PlacedPolytope>(
    polytope: &P,
    e: u32,
    parameter: f64,
) -> ConvexCombination {
    let shape = polytope.shape();
    let edge = shape.edge(e);
    let numbers = edge.ends.map(|v| shape.vertex(v).point_index);
    ConvexCombination::of_two_points(numbers, parameter / edge.length)
}

/// Projects a point onto a face, and returns the projection, clamped to a triangle of the face, with its weights.
#[inline]
fn project_onto_face<Y: PlacedPolytope>(
    point: DVec3,
    y: &Y,
    f: u32,
    normal: DVec3,
) -> (DVec3, ConvexCombination) {
    let sides = y.shape().sides_of(f);
    let at = |k: usize| y.vertex(sides[k].vertex);
    let first = at(0);
    let to_point = point - first;
    // Finds the triangle of the fan by the diagonals that the point is to the left of.
    let left_of = |k: usize| normal.cross(at(k) - first).dot(to_point) >= 0.0;
    let past = (2..sides.len().saturating_sub(1)).take_while(|&k| left_of(k));
    let k = 1 + past.count();
    let triangle = [first, at(k), at(k + 1)];
    let corners = WeightedCorners {
        vertices: [0, k, k + 1].map(|k| sides[k].vertex),
        weights: clamped_projection_weights(point, triangle, normal),
    };
    let ([_, p, q], [_, u, v]) = (triangle, corners.weights);
    let foot = first + u * (p - first) + v * (q - first);
    (foot, combination(y.shape(), &corners))
}

/// Returns the barycentric coordinates of a point's projection onto a triangle, clamped into the triangle.
///
/// The weights are computed across the longest side first, then along it with the residual
/// corrected. For a needle, the first is as accurate as rounding permits, and the second as the
/// needle's width.
fn clamped_projection_weights(point: DVec3, triangle: [DVec3; 3], normal: DVec3) -> [f64; 3] {
    let square = |k: usize| triangle[(k + 1) % 3].distance_squared(triangle[k]);
    let start = (1..3).fold(0, |best, k| if square(k) > square(best) { k } else { best });
    let (end, apex) = ((start + 1) % 3, (start + 2) % 3);
    let base = Line {
        start: triangle[start],
        direction: triangle[end] - triangle[start],
        length: square(start),
    };
    let upward = normal.cross(base.direction);
    let [to_point, to_apex] = [point, triangle[apex]].map(|p| p - base.start);
    let of_apex = clamp_parameter(to_point.dot(upward) / to_apex.dot(upward), 1.0);
    let along = (to_point - of_apex * to_apex).dot(base.direction) / base.length;
    let of_end = clamp_parameter(along, 1.0 - of_apex);
    let mut weights = [0.0; 3];
    weights[apex] = of_apex;
    weights[end] = of_end;
    weights[start] = 1.0 - of_apex - of_end;
    weights
}

#[cfg(test)]
mod tests;
