//! The convex parts of an approximation.

use crate::hull::{HullError, Method, hull};
use ccd_core::glam::DVec3;
use ccd_core::{Facet, Loops, Origin, Polytope};

/// A convex part: the corners of its hull, and the facets, unless all corners are on a line.
pub(super) struct Part {
    pub(super) corners: Vec<DVec3>,
    pub(super) facets: Loops,
    pub(super) method: Method,
}

impl Part {
    pub(super) fn of(points: &[DVec3]) -> Result<Self, HullError> {
        let at = |v: &u32| points[*v as usize];
        let hull = match hull(points) {
            Ok(hull) => hull,
            Err(HullError::Single(v)) => return Ok(Part::thin(vec![at(&v)])),
            Err(HullError::Collinear(v, w)) => return Ok(Part::thin(vec![at(&v), at(&w)])),
            Err(error) => return Err(error),
        };
        let place = |v: &u32| hull.vertices.partition_point(|w| w < v) as u32;
        let mut facets = hull.facets;
        facets.corners_mut().iter_mut().for_each(|v| *v = place(v));
        Ok(Part {
            corners: hull.vertices.iter().map(at).collect(),
            facets,
            method: hull.method,
        })
    }

    fn thin(corners: Vec<DVec3>) -> Self {
        Part {
            corners,
            facets: Loops::default(),
            method: Method::Flat,
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
