//! The facet planes of a part.

use super::super::part::Part;
use super::super::target::Target;
use crate::bounds::Bounds;
use crate::tolerance::WELL_SHAPED;
use crate::work::Work;
use ccd_core::SupportTree;
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use ccd_core::vector::unit;

/// A part and the planes of its facets.
pub(super) struct PartPlanes<'a> {
    pub(super) part: &'a Part,
    /// The planes of well-shaped facets, which are accurate to within the slack.
    pub(super) planes: Vec<Plane>,
    pub(super) bounds: Bounds,
    slack: f64,
}

/// A plane with a whole part behind it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    /// The normal, of length 1.
    pub(super) normal: DVec3,
    /// The height along the normal.
    pub(super) height: f64,
}

/// The position of a box relative to a part's planes.
pub(super) struct Meeting {
    /// Whether the centre is in the part.
    pub(super) has_centre: bool,
    /// The numbers of the planes that the box is not entirely behind.
    pub(super) planes: Vec<u32>,
}

impl<'a> PartPlanes<'a> {
    pub(super) fn new(part: &'a Part, target: &Target<'_>) -> Self {
        PartPlanes {
            part,
            planes: part
                .facets
                .iter()
                .filter_map(|facet| Plane::of_facet(part, facet))
                .collect(),
            bounds: Bounds::enclosing(part.corners.iter().copied()),
            slack: target.slack(),
        }
    }

    /// Tests a box against the planes `among`. Returns `None` if the box does not meet the part.
    pub(super) fn meets(&self, centre: DVec3, half: DVec3, among: &[u32]) -> Option<Meeting> {
        let mut meeting = Meeting {
            has_centre: !self.planes.is_empty(),
            planes: Vec::new(),
        };
        for &k in among {
            let plane = self.planes[k as usize];
            let above = plane.above(centre);
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

    /// Bounds the excess of a part that the surface hardly enters; `None` if the bound would exceed `most`.
    ///
    /// The part is shrunk towards a point of the solid until each triangle of the surface is in front of one of its
    /// planes. The shrunk part contains no surface, and is therefore in the solid. The shrinkage bounds the excess.
    ///
    /// # Complexity
    /// O(log f) for each triangle near the part, of f facets.
    pub(super) fn excess_by_shrinking(&self, target: &Target<'_>, most: f64) -> Option<f64> {
        let count = self.part.corners.len() as f64;
        let centre = self.part.corners.iter().sum::<DVec3>() / count;
        let depths = self.planes.iter().map(|plane| plane.above(centre));
        let depths: Vec<f64> = depths.map(|above| self.slack - above).collect();
        let is_inside = depths.iter().all(|&depth| depth > 2.0 * self.slack);
        if depths.is_empty() || !is_inside || !target.winds_about(centre, &Work::unbounded()) {
            return None;
        }
        let far = self.part.corners.iter().map(|p| p.distance(centre));
        let reach = far.fold(0.0, greater) + self.slack;
        // Relative to the centre's depth, a point is farthest from the plane whose dual is extremal towards it.
        let duals = self.planes.iter().zip(&depths);
        let duals: Vec<DVec3> = duals.map(|(plane, depth)| plane.normal / *depth).collect();
        let farthest = SupportTree::new(&duals);
        let share_before = |triangle: [DVec3; 3], towards: DVec3| {
            let k = farthest.extremal(towards - centre) as usize;
            let out = triangle.map(|p| self.planes[k].normal.dot(p - centre) - self.slack);
            out.into_iter().fold(f64::INFINITY, lesser) / depths[k]
        };
        let enough = 1.0 - most / reach;
        let mut share = 1.0_f64;
        let near = target
            .triangles()
            .filter(|&t| Bounds::enclosing(t).meets(&self.bounds));
        for triangle in near {
            let [p, q, r] = triangle;
            let towards = [(p + q + r) / 3.0, p, q, r].into_iter();
            let of_this = towards
                .map(|towards| share_before(triangle, towards))
                .find(|&share| share >= enough)?;
            share = lesser(share, of_this);
        }
        Some((1.0 - share) * reach)
    }
}

impl Plane {
    /// Computes the plane of a facet; `None` if the facet is not well shaped.
    fn of_facet(part: &Part, facet: &[u32]) -> Option<Self> {
        let at = |k: usize| part.corners[facet[k] as usize];
        // The triangle of the fan with the largest area.
        let last = facet.len() - 1;
        let sides = (1..last).map(|k| (at(k) - at(0), at(k + 1) - at(0)));
        let area = |(u, v): &(DVec3, DVec3)| u.cross(*v).length_squared();
        let (u, v) = sides.max_by(|one, other| area(one).total_cmp(&area(other)))?;
        let normal = u.cross(v);
        let good = normal.length() > WELL_SHAPED * u.length() * v.length();
        let normal = unit(normal).filter(|_| good)?;
        Some(Plane {
            normal,
            height: normal.dot(at(0)),
        })
    }

    /// Returns the signed distance of a point from the plane, positive in front.
    pub(super) fn above(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.height
    }
}

#[cfg(test)]
mod tests;
