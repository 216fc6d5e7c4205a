//! The facet planes of a hull, against which boxes are tested.

use super::enclosed_mesh::EnclosedMesh;
use crate::tolerance::MIN_CORNER_SINE;
use ccd_core::Hull;
use ccd_core::glam::DVec3;
use ccd_core::vector::unit;

/// The planes of a hull's facets, and the rounding of distances to them.
pub(super) struct FacetPlanes {
    /// The planes of the well-shaped facets, whose distances are accurate to within `slack`.
    pub(super) planes: Vec<Plane>,
    slack: f64,
}

/// A plane that has the whole hull behind it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    /// The unit normal, which points away from the hull.
    pub(super) normal: DVec3,
    /// The dot product of the normal with any point of the plane.
    pub(super) height: f64,
}

/// The position of a box relative to the facet planes of a hull.
pub(super) struct BoxPosition {
    /// Whether the box's center is in the hull.
    pub(super) is_center_inside: bool,
    /// The numbers of the planes that do not have the whole box behind them.
    pub(super) planes: Vec<u32>,
}

impl FacetPlanes {
    pub(super) fn new(hull: &Hull, target: &EnclosedMesh<'_>) -> Self {
        let plane = |facet: &[u32]| Plane::from_facet(hull, facet);
        FacetPlanes {
            planes: hull.facets.iter().filter_map(plane).collect(),
            slack: target.distance_rounding,
        }
    }

    /// Returns the position of a box relative to the planes with the numbers `among`; `None` if the box does not meet
    /// the hull.
    pub(super) fn box_position(
        &self,
        center: DVec3,
        half: DVec3,
        among: &[u32],
    ) -> Option<BoxPosition> {
        let mut meeting = BoxPosition {
            is_center_inside: !self.planes.is_empty(),
            planes: Vec::new(),
        };
        for &k in among {
            let plane = self.planes[k as usize];
            let above = plane.signed_distance(center);
            let reach = plane.normal.abs().dot(half) + self.slack;
            if above > reach {
                return None;
            }
            // Written so that NaN is no bound.
            if !(above <= 0.0) {
                meeting.is_center_inside = false;
            }
            if !(above < -reach) {
                meeting.planes.push(k);
            }
        }
        Some(meeting)
    }
}

impl Plane {
    /// Computes the plane of a facet; `None` if the facet is not well shaped.
    fn from_facet(hull: &Hull, facet: &[u32]) -> Option<Self> {
        let at = |k: usize| hull.points[facet[k] as usize];
        // The triangle of the fan with the largest area.
        let last = facet.len() - 1;
        let sides = (1..last).map(|k| (at(k) - at(0), at(k + 1) - at(0)));
        let area = |(u, v): &(DVec3, DVec3)| u.cross(*v).length_squared();
        let (u, v) = sides.max_by(|one, other| area(one).total_cmp(&area(other)))?;
        Plane::from_corner_and_sides(at(0), u, v)
    }

    /// Computes the plane of a triangle from a corner and two sides, with `u × v` outward; `None` if the triangle is
    /// not well shaped.
    pub(super) fn from_corner_and_sides(corner: DVec3, u: DVec3, v: DVec3) -> Option<Self> {
        let normal = u.cross(v);
        let good = normal.length() > MIN_CORNER_SINE * u.length() * v.length();
        let normal = unit(normal).filter(|_| good)?;
        Some(Plane {
            normal,
            height: normal.dot(corner),
        })
    }

    /// Returns the signed distance of a point from the plane, positive in front.
    pub(super) fn signed_distance(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.height
    }
}

#[cfg(test)]
mod tests;
