//! Convex pieces: what bodies are made of and what oracles measure between.

use glam::DVec3;

/// A convex piece: the hull of `points`, grown by `radius`, in its body's frame.
///
/// A ball is one point and a radius, a capsule two points and a radius, a triangle three points.
#[derive(Clone, Copy, Debug)]
pub struct Piece<'a> {
    /// At least one point, all finite; not necessarily all extreme, or distinct.
    pub points: &'a [DVec3],
    /// Rounding radius ≥ 0.
    pub radius: f64,
    /// The facets of the hull, where known: empty for up to three points.
    pub facets: Facets<'a>,
}

impl<'a> Piece<'a> {
    /// A piece without known facets, e.g. to try an oracle on.
    pub fn from_points(points: &'a [DVec3]) -> Self {
        Piece {
            points,
            radius: 0.0,
            facets: Facets::NONE,
        }
    }
}

/// The facets of a piece: convex polygons, each a loop of indices into the piece's points,
/// counter-clockwise seen from outside.
#[derive(Clone, Copy, Debug)]
pub struct Facets<'a> {
    /// `ends[k]` is where the corners of facet `k` end in `corners`, counted from `base`.
    pub(crate) ends: &'a [u32],
    pub(crate) corners: &'a [u32],
    pub(crate) base: u32,
}

impl<'a> Facets<'a> {
    /// No facets.
    pub const NONE: Facets<'static> = Facets {
        ends: &[],
        corners: &[],
        base: 0,
    };

    /// How many facets there are.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether no facet is known.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The corner loops, facet by facet.
    pub fn iter(&self) -> impl Iterator<Item = &'a [u32]> {
        let facets = *self;
        (0..facets.ends.len()).map(move |k| {
            let start = if k == 0 {
                facets.base
            } else {
                facets.ends[k - 1]
            };
            &facets.corners[start as usize..facets.ends[k] as usize]
        })
    }
}

/// A convex polytope as it is handed to [`Pieces::polytopes`](crate::Pieces::polytopes).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polytope {
    /// The points whose hull it is.
    pub points: Vec<DVec3>,
    /// The number each point goes by in the mesh it came from; empty numbers them from 0.
    pub vertex_ids: Vec<u32>,
    /// The hull's facets, where known.
    pub facets: Vec<Facet>,
    /// Rounding radius ≥ 0.
    pub radius: f64,
}

/// One facet of a [`Polytope`].
#[derive(Clone, Debug, PartialEq)]
pub struct Facet {
    /// The number the facet goes by in the mesh it came from.
    pub id: u32,
    /// Indices into the polytope's points, counter-clockwise seen from outside.
    pub corners: Vec<u32>,
}
