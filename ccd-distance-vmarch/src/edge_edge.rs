//! The transition of the march from an edge against an edge `[VCLIP98 §3.2]`.

use crate::clip;
use crate::feature::Certainty::{Sure, Tied};
use crate::feature::{Feature, LocalMinimum, MarchStep, WhichPolytope};
use crate::placed::{Line, PlacedPolytope, RoundingScale, clamp_parameter};
use crate::polytope::Edge;
use crate::tolerance::{DOT_PRODUCT_ERROR_BOUND, MAX_PARALLEL_SINE};
use crate::vertex_edge::face_towards_point;
use ccd_core::glam::DVec3;

/// Computes the march's next step from two edges, by testing the nearest point of each edge against the Voronoi planes
/// of the other edge. Vertex-edge planes are tested first.
///
/// The march goes on to a corner if a nearest point is an end, or to a face if the other edge's
/// point is on its side.
#[inline]
pub(crate) fn next<X: PlacedPolytope, Y: PlacedPolytope>(
    x: &X,
    e: u32,
    y: &Y,
    f: u32,
    scale: RoundingScale,
) -> MarchStep {
    let (one, other) = (x.line(e), y.line(f));
    let (edge_x, edge_y) = (x.shape().edge(e), y.shape().edge(f));
    let near = nearest_parameters(&one, &other);
    let [s, t] = near.parameters;
    let (on_x, on_y) = (vertex_or_edge_at(x, e, s), vertex_or_edge_at(y, f, t));
    if (on_x, on_y) != (Feature::Edge(e), Feature::Edge(f)) {
        return MarchStep::Continue(on_x, on_y);
    }
    let points = [one.point_at_parameter(s), other.point_at_parameter(t)];
    let offset = points[1] - points[0];
    if offset.length() <= scale.rounding() {
        return MarchStep::Stop(Tied);
    }
    let facing = NearestVector::new(&near, offset, scale);
    let slope_x = x.inward_components(edge_x, facing.axis);
    if let Some(step) = facing.step_beyond_edge(x, edge_x, slope_x, (f, points[1])) {
        return step;
    }
    let facing = facing.reversed();
    let slope_y = y.inward_components(edge_y, facing.axis);
    if let Some(step) = facing.step_beyond_edge(y, edge_y, slope_y, (e, points[0])) {
        return step.swapped();
    }
    let clear = edge_x.is_outside_voronoi_planes(slope_x, facing.slack)
        && edge_y.is_outside_voronoi_planes(slope_y, facing.slack);
    MarchStep::Stop(if clear { Sure } else { Tied })
}

/// The nearest points of two segments, and the cross product of the segments' directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearestParameters {
    /// The parameters of the nearest points along both segments.
    pub(crate) parameters: [f64; 2],
    /// The cross product of the segments' unit directions; its length is the sine of the angle between them.
    pub(crate) cross_product: DVec3,
}

impl NearestParameters {
    /// Returns the cross product, oriented along `offset`, if rounding tilts it less than it tilts `offset`; `None`
    /// otherwise. The cross product is tilted by its own rounding over the sine, `offset` by the rounding of the
    /// positions over the distance.
    #[inline(always)]
    pub(crate) fn axis(&self, offset: DVec3, scale: RoundingScale) -> Option<DVec3> {
        // Written so that NaN does not turn it.
        let turned = if self.cross_product.dot(offset) < 0.0 {
            -1.0
        } else {
            1.0
        };
        (self.cross_product.length() * scale.size > offset.length())
            .then_some(self.cross_product * turned)
    }
}

/// Returns the parameters of the nearest points of two segments. If one is an end, its parameter is exact.
///
/// If the segments are nearly parallel, the first parameter is off by rounding over the sine. The
/// second one is computed from it, so the distance of the points is off by rounding only.
#[inline(always)]
pub(crate) fn nearest_parameters(one: &Line, other: &Line) -> NearestParameters {
    let across = one.direction.cross(other.direction);
    let between = other.start - one.start;
    let square = across.length_squared();
    let s = if square > MAX_PARALLEL_SINE * MAX_PARALLEL_SINE {
        clamp_parameter(
            between.cross(other.direction).dot(across) / square,
            one.length,
        )
    } else {
        clip::parameter_of_overlap_middle(one, other)
    };
    let free = (one.point_at_parameter(s) - other.start).dot(other.direction);
    let t = clamp_parameter(free, other.length);
    // If the nearest point of the line is beyond the end of the segment, the foot of that end is nearest.
    let s = if free == t {
        s
    } else {
        one.nearest_parameter(other.point_at_parameter(t))
    };
    NearestParameters {
        parameters: [s, t],
        cross_product: across,
    }
}

/// Returns the end vertex of an edge that is at a parameter, or the edge itself for a parameter between the ends.
#[inline(always)]
pub(crate) fn vertex_or_edge_at<P: PlacedPolytope>(
    polytope: &P,
    e: u32,
    parameter: f64,
) -> Feature {
    let edge = polytope.shape().edge(e);
    if !(parameter > 0.0) {
        Feature::Vertex(edge.ends[0])
    } else if !(parameter < edge.length) {
        Feature::Vertex(edge.ends[1])
    } else {
        Feature::Edge(e)
    }
}

/// The vector between the nearest points of two edges, and the most accurate direction of that vector.
#[derive(Clone, Copy)]
struct NearestVector {
    offset: DVec3,
    /// The vector between the nearest points, or the direction perpendicular to both edges: whichever rounding tilts
    /// less.
    axis: DVec3,
    /// A bound on the rounding error of a scalar product with the axis.
    slack: f64,
}

impl NearestVector {
    #[inline(always)]
    fn new(near: &NearestParameters, offset: DVec3, scale: RoundingScale) -> Self {
        let across = near.axis(offset, scale);
        NearestVector {
            offset,
            axis: across.unwrap_or(offset),
            slack: across.map_or(scale.rounding(), |_| DOT_PRODUCT_ERROR_BOUND),
        }
    }

    #[inline(always)]
    fn reversed(self) -> Self {
        NearestVector {
            offset: -self.offset,
            axis: -self.axis,
            ..self
        }
    }

    /// Returns the march's next step for an edge of X if the nearest point of Y's edge `f` is outside the edge's Voronoi
    /// region: to the face of X towards which that point lies, or from a local minimum if the point is behind both
    /// faces. Of two such faces, it is the face that the point is higher above.
    #[inline(always)]
    fn step_beyond_edge<X: PlacedPolytope>(
        self,
        x: &X,
        edge: &Edge,
        slopes: [f64; 2],
        (f, point): (u32, DVec3),
    ) -> Option<MarchStep> {
        let inward = slopes.map(|slope| slope - self.slack);
        let face = face_towards_point(x, edge.faces, inward, self.offset)?;
        let feature = Feature::Edge(f);
        let is_above = || x.vector(x.shape().face(face).normal).dot(self.offset) > 0.0;
        if inward.iter().any(|&into| !(into > 0.0)) || is_above() {
            return Some(MarchStep::Continue(Feature::Face(face), feature));
        }
        let minimum = LocalMinimum {
            feature,
            point,
            other_polytope_face: face,
        };
        Some(MarchStep::LocalMinimum(WhichPolytope::PolytopeY, minimum))
    }
}

#[cfg(test)]
mod tests;
