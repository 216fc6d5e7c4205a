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
pub(crate) enum Next {
    /// The march continues with a pair that is nearer, or equally near and of lower dimension.
    To(Feature, Feature),
    /// The march stops: each feature's nearest point is in the Voronoi region of the other, so that no pair is nearer.
    Stop(Certainty),
    /// The march is in a local minimum, and needs an [escape](crate::escape): a feature of one polytope is behind a
    /// face of the other.
    Behind(Which, Behind),
    /// An edge of one polytope goes through a face of the other.
    Pierced(Which, Crossing),
}

/// One of the two polytopes X and Y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Which {
    X,
    Y,
}

impl Next {
    /// Returns the result with X and Y swapped.
    #[inline(always)]
    pub(crate) fn swapped(self) -> Next {
        match self {
            Next::To(x, y) => Next::To(y, x),
            Next::Stop(certainty) => Next::Stop(certainty),
            Next::Behind(which, behind) => Next::Behind(which.other(), behind),
            Next::Pierced(which, crossing) => Next::Pierced(which.other(), crossing),
        }
    }
}

impl Which {
    #[inline(always)]
    fn other(self) -> Which {
        match self {
            Which::X => Which::Y,
            Which::Y => Which::X,
        }
    }
}

/// How certain it is that a stop is at the nearest pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Certainty {
    /// The point is on the inner side of every Voronoi plane, by more than rounding.
    Sure,
    /// The point is on some Voronoi plane up to rounding, or the features touch: the stop needs a
    /// certificate.
    Tied,
}

/// A corner or edge behind a face of the other polytope, in the part within that face's prism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Behind {
    /// The corner or edge that is behind the face.
    pub(crate) feature: Feature,
    /// The point of the feature that is least deep behind the face.
    pub(crate) point: DVec3,
    /// The index of the face.
    pub(crate) face: u32,
}

/// A common point of two polytopes, on an edge or a corner of one of them, proven by exact signs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crossing {
    /// The ends of the edge, or twice the corner, with their weights.
    pub(crate) on_edge: Corners<2>,
    /// Three corners of the face with their weights, and a fourth corner if the point is inside.
    pub(crate) on_face: Corners<4>,
    /// The face that is crossed, or a face with the point behind it.
    pub(crate) face: u32,
}

/// Corners of a polytope and their weights in a convex combination.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Corners<const N: usize> {
    pub(crate) vertices: [u32; N],
    pub(crate) weights: [f64; N],
}
