//! Shapes near which triangles are looked for.

use crate::bounds::Bounds;
use ccd_core::glam::DVec3;

/// A shape, and the box about it, near which triangles are looked for.
#[derive(Clone, Debug)]
pub(crate) struct Region {
    bounds: Bounds,
    shape: Shape,
}

#[derive(Clone, Debug)]
pub(super) enum Shape {
    Segment([DVec3; 2]),
    Triangle([DVec3; 3]),
    /// The open inside of a hull, within the box.
    Inside(Hull),
}

/// The most facets of a hull that are kept to prove that triangles are in front of it.
const FACETS: usize = 64;

#[derive(Clone, Debug)]
pub(super) struct Hull {
    pub(super) corners: Vec<DVec3>,
    /// The largest facets, the larger first.
    pub(super) facets: Vec<[DVec3; 3]>,
}

impl Region {
    pub(crate) fn segment(ends: [DVec3; 2]) -> Self {
        Region {
            bounds: Bounds::of(ends),
            shape: Shape::Segment(ends),
        }
    }

    pub(crate) fn triangle(corners: [DVec3; 3]) -> Self {
        Region {
            bounds: Bounds::of(corners),
            shape: Shape::Triangle(corners),
        }
    }

    /// The box about the shape.
    pub(crate) fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// The points that are in a box and inside a hull, which is given by its corners and facets.
    pub(crate) fn inside(corners: Vec<DVec3>, mut facets: Vec<[DVec3; 3]>, bounds: Bounds) -> Self {
        // A triangle near a hull, but not in it, is most likely in front of a large facet.
        let area = |[a, b, c]: &[DVec3; 3]| (*b - *a).cross(*c - *a).length_squared();
        let larger = |f: &[DVec3; 3], g: &[DVec3; 3]| area(g).total_cmp(&area(f));
        if facets.len() > FACETS {
            facets.select_nth_unstable_by(FACETS, larger);
            facets.truncate(FACETS);
        }
        facets.sort_by(larger);
        let shape = Shape::Inside(Hull { corners, facets });
        Region { bounds, shape }
    }

    pub(super) fn shape(&self) -> &Shape {
        &self.shape
    }
}
