//! Regions in which triangles are searched for.

use crate::bounds::BoundingBox;
use ccd_core::glam::DVec3;

/// A region to search: a shape, and its bounding box.
#[derive(Clone, Debug)]
pub(crate) struct Region {
    pub(crate) bounds: BoundingBox,
    pub(super) shape: Shape,
}

#[derive(Clone, Debug)]
pub(super) enum Shape {
    Segment([DVec3; 2]),
    Triangle([DVec3; 3]),
    /// The part of a hull's interior that is in the region's bounding box.
    HullInBox(Hull),
}

/// The maximum number of facets of a hull that a region stores for separation tests.
const MAX_SEPARATION_FACETS: usize = 64;

#[derive(Clone, Debug)]
pub(super) struct Hull {
    pub(super) corners: Vec<DVec3>,
    /// The largest facets of the hull, in descending order of area.
    pub(super) largest_facets: Vec<[DVec3; 3]>,
}

impl Region {
    pub(crate) fn segment(ends: [DVec3; 2]) -> Self {
        Region {
            bounds: BoundingBox::enclosing(ends),
            shape: Shape::Segment(ends),
        }
    }

    pub(crate) fn from_triangle(corners: [DVec3; 3]) -> Self {
        Region {
            bounds: BoundingBox::enclosing(corners),
            shape: Shape::Triangle(corners),
        }
    }

    /// Creates the region inside both a box and a hull; the hull is given by its corners and facets.
    pub(crate) fn from_box_and_hull(
        corners: Vec<DVec3>,
        mut facets: Vec<[DVec3; 3]>,
        bounds: BoundingBox,
    ) -> Self {
        // A triangle near a hull but outside is most likely in front of a large facet.
        let area = |[a, b, c]: &[DVec3; 3]| (*b - *a).cross(*c - *a).length_squared();
        let larger = |f: &[DVec3; 3], g: &[DVec3; 3]| area(g).total_cmp(&area(f));
        if facets.len() > MAX_SEPARATION_FACETS {
            facets.select_nth_unstable_by(MAX_SEPARATION_FACETS, larger);
            facets.truncate(MAX_SEPARATION_FACETS);
        }
        facets.sort_by(larger);
        let shape = Shape::HullInBox(Hull {
            corners,
            largest_facets: facets,
        });
        Region { bounds, shape }
    }
}
