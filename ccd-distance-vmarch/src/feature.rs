//! Vertices, edges and faces of polytopes, by number, and pairs of them.

use ccd_core::glam::DVec3;

/// A vertex, edge or face of a polytope, by its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Feature {
    Vertex(u32),
    Edge(u32),
    Face(u32),
}

/// A feature of A and a feature of B, which are the state of a march.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Pair {
    pub(crate) a: Feature,
    pub(crate) b: Feature,
}

/// The result of testing a pair of features of polytopes X and Y, in that order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum MarchStep {
    /// The march continues with a pair that is nearer, or equally near and of lower dimension.
    Continue(Feature, Feature),
    /// The march stops: each feature's nearest point is in the Voronoi region of the other feature, so no pair is
    /// nearer.
    Stop(Certainty),
    /// A feature of one polytope is behind a face of the other. The march is in a local minimum, and needs an
    /// [escape](crate::escape).
    LocalMinimum(WhichPolytope, LocalMinimum),
    /// An edge of one polytope goes through a face of the other.
    CommonPoint(WhichPolytope, CommonPoint),
}

/// The first or the second polytope of a tested pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WhichPolytope {
    PolytopeX,
    PolytopeY,
}

impl MarchStep {
    /// Returns the result of the same test with polytopes X and Y swapped.
    #[inline(always)]
    pub(crate) fn swapped(self) -> MarchStep {
        match self {
            MarchStep::Continue(x, y) => MarchStep::Continue(y, x),
            MarchStep::LocalMinimum(which, minimum) => {
                MarchStep::LocalMinimum(which.other(), minimum)
            }
            MarchStep::CommonPoint(which, crossing) => {
                MarchStep::CommonPoint(which.other(), crossing)
            }
            MarchStep::Stop(_) => self,
        }
    }
}

impl WhichPolytope {
    #[inline(always)]
    fn other(self) -> WhichPolytope {
        match self {
            WhichPolytope::PolytopeX => WhichPolytope::PolytopeY,
            WhichPolytope::PolytopeY => WhichPolytope::PolytopeX,
        }
    }
}

/// Whether rounding can have stopped the march at a pair that is not the nearest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Certainty {
    /// Rounding cannot have hidden a nearer pair: the stop needs no certificate.
    Sure,
    /// Rounding may have hidden a nearer pair, or the features touch: the stop needs a certificate.
    Tied,
}

/// A corner or edge of one polytope that is behind a face of the other, wherever it projects onto that face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LocalMinimum {
    /// The corner or edge that is behind the face.
    pub(crate) feature: Feature,
    /// The point of the feature that projects onto the face, and is the least deep behind it.
    pub(crate) point: DVec3,
    /// The index of the other polytope's face that the feature is behind.
    pub(crate) other_polytope_face: u32,
}

/// A common point of two polytopes, on an edge or a corner of one of them, proven by exact signs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CommonPoint {
    /// The ends of the edge with their weights; if the common point is a corner, that corner twice.
    pub(crate) edge_ends: WeightedCorners<2>,
    /// Three corners of the face with their weights, and a fourth corner if the common point is inside the polytope.
    pub(crate) face_corners: WeightedCorners<4>,
    /// The index of the face that the edge crosses; for a corner inside the polytope, the index of a face that the
    /// corner is behind.
    pub(crate) face: u32,
}

/// Corners of a polytope and their weights in a convex combination.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WeightedCorners<const N: usize> {
    pub(crate) vertices: [u32; N],
    pub(crate) weights: [f64; N],
}
