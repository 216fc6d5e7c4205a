//! The facet planes of a convex part.

use super::super::target::Target;
use crate::bounds::Bounds;
use crate::tolerance::MIN_CORNER_SINE;
use ccd_core::Hull;
use ccd_core::glam::DVec3;
use ccd_core::vector::unit;

/// A convex part and the planes of its facets.
pub(super) struct PartPlanes<'a> {
    pub(super) part: &'a Hull,
    /// The planes of well-shaped facets, which are accurate to within the slack of distances.
    pub(super) planes: Vec<Plane>,
    pub(super) bounds: Bounds,
    slack: f64,
}

/// A plane that has a whole convex part behind it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    /// The unit normal, which points away from the part.
    pub(super) normal: DVec3,
    /// The dot product of the normal with any point of the plane.
    pub(super) height: f64,
}

/// The position of a box relative to the facet planes of a part.
pub(super) struct BoxOverlap {
    /// Whether the box's centre is in the part.
    pub(super) has_centre: bool,
    /// The numbers of the planes that do not have the whole box behind them.
    pub(super) planes: Vec<u32>,
}

impl<'a> PartPlanes<'a> {
    pub(super) fn new(part: &'a Hull, target: &Target<'_>) -> Self {
        PartPlanes {
            part,
            planes: part
                .facets
                .iter()
                .filter_map(|facet| Plane::of_facet(part, facet))
                .collect(),
            bounds: Bounds::enclosing(part.points.iter().copied()),
            slack: target.slack(),
        }
    }

    /// Tests a box against the planes numbered `among`. Returns `None` if the box does not meet the part.
    pub(super) fn overlap(&self, centre: DVec3, half: DVec3, among: &[u32]) -> Option<BoxOverlap> {
        let mut meeting = BoxOverlap {
            has_centre: !self.planes.is_empty(),
            planes: Vec::new(),
        };
        for &k in among {
            let plane = self.planes[k as usize];
            let above = plane.signed_distance(centre);
            let reach = plane.normal.abs().dot(half) + self.slack;
            if above > reach {
                return None;
            }
            // Written so that NaN is no bound.
            if !(above <= 0.0) {
                meeting.has_centre = false;
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
    fn of_facet(part: &Hull, facet: &[u32]) -> Option<Self> {
        let at = |k: usize| part.points[facet[k] as usize];
        // The triangle of the fan with the largest area.
        let last = facet.len() - 1;
        let sides = (1..last).map(|k| (at(k) - at(0), at(k + 1) - at(0)));
        let area = |(u, v): &(DVec3, DVec3)| u.cross(*v).length_squared();
        let (u, v) = sides.max_by(|one, other| area(one).total_cmp(&area(other)))?;
        let normal = u.cross(v);
        let good = normal.length() > MIN_CORNER_SINE * u.length() * v.length();
        let normal = unit(normal).filter(|_| good)?;
        Some(Plane {
            normal,
            height: normal.dot(at(0)),
        })
    }

    /// Returns the signed distance of a point from the plane, positive in front.
    pub(super) fn signed_distance(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.height
    }
}

#[cfg(test)]
mod tests;
