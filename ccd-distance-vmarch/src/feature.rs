//! Corners, edges and faces of a polytope, by their numbers, and pairs of them.

use ccd_core::glam::DVec3;

/// One feature of a polytope.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Feature {
    Vertex(u32),
    Edge(u32),
    Face(u32),
}

/// A feature of each polytope: the state of a march.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Pair {
    pub(crate) a: Feature,
    pub(crate) b: Feature,
}

/// The outcome of a test of one pair: of features of polytopes X and Y, in that order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Next {
    /// A pair that is nearer, or as near and made of less.
    To(Feature, Feature),
    /// Each feature's nearest point is in the Voronoi region of the other: no others are nearer.
    Stop(Certainty),
    /// A feature of one polytope lies behind a face of the other: a local minimum, from which an
    /// [escape](crate::escape) over all faces has to be found.
    Behind(Whose, Behind),
    /// An edge of one polytope goes through a face of the other.
    Pierced(Whose, Crossing),
}

/// One of the two polytopes X and Y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Whose {
    X,
    Y,
}

impl Next {
    /// The same outcome for Y and X.
    #[inline(always)]
    pub(crate) fn swapped(self) -> Next {
        match self {
            Next::To(x, y) => Next::To(y, x),
            Next::Stop(certainty) => Next::Stop(certainty),
            Next::Behind(whose, behind) => Next::Behind(whose.other(), behind),
            Next::Pierced(whose, crossing) => Next::Pierced(whose.other(), crossing),
        }
    }
}

impl Whose {
    #[inline(always)]
    fn other(self) -> Whose {
        match self {
            Whose::X => Whose::Y,
            Whose::Y => Whose::X,
        }
    }
}

/// The certainty of a stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Certainty {
    /// Every Voronoi plane was passed on its inner side, clear of rounding.
    Sure,
    /// Some Voronoi plane was met within rounding, or the features touch: the stop is to be
    /// certified.
    Tied,
}

/// A feature that lies behind a face of the other polytope, where it is within that face's prism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Behind {
    /// A corner or an edge.
    pub(crate) feature: Feature,
    /// The point of it that is least far behind.
    pub(crate) point: DVec3,
    /// The face it was found to be behind of.
    pub(crate) face: u32,
}

/// A common point of an edge of one polytope, or of a corner, and the other polytope, proven by exact
/// signs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crossing {
    /// The edge's two ends; a corner has no other end.
    pub(crate) on_edge: Corners<2>,
    /// Three of the face's corners; and one more, if the point is inside.
    pub(crate) on_face: Corners<4>,
    /// The face that is gone through, or one that the point is behind of.
    pub(crate) face: u32,
}

/// Corners of a polytope and their weights in a convex combination.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Corners<const N: usize> {
    pub(crate) vertices: [u32; N],
    pub(crate) weights: [f64; N],
}
