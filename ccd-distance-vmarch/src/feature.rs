//! Features of polytopes: vertices, edges and faces, by number, and pairs of them.

use ccd_core::glam::DVec3;

/// One feature of a polytope.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Feature {
    Vertex(u32),
    Edge(u32),
    Face(u32),
}

/// A feature of each polytope, which is the state of a march.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Pair {
    pub(crate) a: Feature,
    pub(crate) b: Feature,
}

/// The result of testing a pair of features of polytopes X and Y, in that order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Next {
    /// A nearer pair, or one as near and of lower dimension.
    To(Feature, Feature),
    /// Each feature's nearest point is in the Voronoi region of the other, so that no pair is nearer.
    Stop(Certainty),
    /// A feature of one polytope is behind a face of the other: a local minimum, which needs an
    /// [escape](crate::escape) over all faces.
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

/// The certainty of a stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Certainty {
    /// The point is on the inner side of every Voronoi plane, by more than rounding.
    Sure,
    /// The point is on some Voronoi plane up to rounding, or the features touch: the stop needs a
    /// certificate.
    Tied,
}

/// A feature behind a face of the other polytope, in the part within that face's prism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Behind {
    /// A corner or an edge.
    pub(crate) feature: Feature,
    /// Its point that is least deep behind.
    pub(crate) point: DVec3,
    /// The face that it is behind.
    pub(crate) face: u32,
}

/// A common point of the other polytope and an edge or a corner of one, proven by exact signs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crossing {
    /// The edge's two ends; a corner has no other end.
    pub(crate) on_edge: Corners<2>,
    /// Three corners of the face, and a fourth corner if the point is inside.
    pub(crate) on_face: Corners<4>,
    /// The face that is crossed, or one with the point behind it.
    pub(crate) face: u32,
}

/// Corners of a polytope and their weights in a convex combination.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Corners<const N: usize> {
    pub(crate) vertices: [u32; N],
    pub(crate) weights: [f64; N],
}
