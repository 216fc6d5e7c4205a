//! The convex parts of an approximation.

use crate::hull::{HullError, hull};
use ccd_core::glam::DVec3;
use ccd_core::{Facet, Loops, Origin, Polytope};

/// A convex part: the corners of its hull, and the facets, unless all corners are on a line.
pub(super) struct Part {
    pub(super) corners: Vec<DVec3>,
    pub(super) facets: Loops,
}

impl Part {
    pub(super) fn hull_of(points: &[DVec3]) -> Result<Self, HullError> {
        let at = |v: u32| points[v as usize];
        match hull(points) {
            Ok(hull) => {
                let (corners, facets) = hull.corners_and_facets(points);
                Ok(Part { corners, facets })
            }
            Err(HullError::Single(v)) => Ok(Part::thin(vec![at(v)])),
            Err(HullError::Collinear(v, w)) => Ok(Part::thin(vec![at(v), at(w)])),
            Err(error) => Err(error),
        }
    }

    fn thin(corners: Vec<DVec3>) -> Self {
        Part {
            corners,
            facets: Loops::default(),
        }
    }

    pub(super) fn polytope(self, radius: f64) -> Polytope {
        let facet = |corners: &[u32]| Facet {
            origin: Origin::Virtual,
            corners: corners.to_vec(),
        };
        Polytope {
            points: self.corners,
            facets: self.facets.iter().map(facet).collect(),
            radius,
            ..Polytope::default()
        }
    }
}
