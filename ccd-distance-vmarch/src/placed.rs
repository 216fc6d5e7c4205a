//! Two polytopes in A's frame: A as it is stored, B transformed when needed.

use crate::polytope::{Edge, Polytope};
use crate::tolerance::PLACEMENT_ERROR_BOUND;
use ccd_core::Frame;
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};

/// A polytope in A's frame.
///
/// Tests of features are generic, to serve both orders of the polytopes.
pub(crate) trait PlacedPolytope {
    fn shape(&self) -> &Polytope;
    /// Transforms a point from the polytope's frame to A's.
    fn transform_point(&self, local: DVec3) -> DVec3;
    /// Rotates a direction from the polytope's frame to A's.
    fn vector(&self, local: DVec3) -> DVec3;

    /// Returns the position of a vertex in A's frame.
    #[inline(always)]
    fn vertex(&self, v: u32) -> DVec3 {
        self.transform_point(self.shape().vertex(v).point)
    }

    /// Returns the start, direction and length of an edge in A's frame.
    #[inline(always)]
    fn line(&self, e: u32) -> Line {
        let edge = self.shape().edge(e);
        Line {
            start: self.transform_point(edge.start),
            direction: self.vector(edge.direction),
            length: edge.length,
        }
    }

    /// Returns the components of a vector along the two directions that point from an edge into its faces.
    #[inline(always)]
    fn inward_components(&self, edge: &Edge, offset: DVec3) -> [f64; 2] {
        edge.inward_directions
            .map(|inward| self.vector(inward).dot(offset))
    }
}

/// Polytope A, which needs no transform.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedA<'a>(pub(crate) &'a Polytope);

/// Polytope B, with its transform to A's frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedB<'a> {
    shape: &'a Polytope,
    /// The transform from the polytope's frame to A's; its translation is the position of the polytope's origin.
    pub(crate) to_a: Frame,
}

/// Both polytopes in A's frame, and the size to which rounding errors are proportional.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedPair<'a> {
    pub(crate) a: PlacedA<'a>,
    pub(crate) b: PlacedB<'a>,
    pub(crate) scale: RoundingScale,
}

/// The size of a pair of polytopes, to which rounding errors are proportional.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RoundingScale {
    /// The sum of both polytopes' reaches and of the distance of their origins.
    pub(crate) size: f64,
}

/// An edge in A's frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    pub(crate) start: DVec3,
    pub(crate) direction: DVec3,
    pub(crate) length: f64,
}

impl<'a> PlacedPair<'a> {
    pub(crate) fn new(a: &'a Polytope, b: &'a Polytope, b_to_a: &Frame) -> Self {
        let translation = b_to_a.transform_point(b.origin_in_piece) - a.origin_in_piece;
        PlacedPair {
            a: PlacedA(a),
            b: PlacedB {
                shape: b,
                to_a: Frame {
                    translation,
                    ..*b_to_a
                },
            },
            scale: RoundingScale {
                size: a.reach + b.reach + translation.length(),
            },
        }
    }
}

impl RoundingScale {
    /// Returns the largest rounding error of a difference of two transformed points.
    #[inline(always)]
    pub(crate) fn rounding(self) -> f64 {
        PLACEMENT_ERROR_BOUND * self.size
    }
}

impl Line {
    #[inline(always)]
    pub(crate) fn point_at_parameter(&self, parameter: f64) -> DVec3 {
        self.start + self.direction * parameter
    }

    /// Returns the parameter of the edge's point that is nearest to a given point.
    #[inline(always)]
    pub(crate) fn nearest_parameter(&self, point: DVec3) -> f64 {
        clamp_parameter((point - self.start).dot(self.direction), self.length)
    }
}

/// Clamps a parameter to [0, length]; NaN becomes 0.
#[inline(always)]
pub(crate) fn clamp_parameter(parameter: f64, length: f64) -> f64 {
    lesser(greater(0.0, parameter), length)
}

impl PlacedPolytope for PlacedA<'_> {
    #[inline(always)]
    fn shape(&self) -> &Polytope {
        self.0
    }

    #[inline(always)]
    fn transform_point(&self, local: DVec3) -> DVec3 {
        local
    }

    #[inline(always)]
    fn vector(&self, local: DVec3) -> DVec3 {
        local
    }
}

impl PlacedPolytope for PlacedB<'_> {
    #[inline(always)]
    fn shape(&self) -> &Polytope {
        self.shape
    }

    #[inline(always)]
    fn transform_point(&self, local: DVec3) -> DVec3 {
        self.to_a.transform_point(local)
    }

    #[inline(always)]
    fn vector(&self, local: DVec3) -> DVec3 {
        self.to_a.rotation * local
    }
}

#[cfg(test)]
mod tests;
