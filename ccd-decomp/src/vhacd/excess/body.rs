//! A part as it is seen by the search: its planes.

use super::super::Part;
use super::super::solid::Solid;
use crate::tolerance::WELL_SHAPED;
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use ccd_core::vector::unit;

/// A part with the planes of its facets.
pub(super) struct Body<'a> {
    pub(super) part: &'a Part,
    /// Unit normals, and heights of the planes along them; only of facets that are well shaped, which
    /// is right to within the solid's slack.
    pub(super) planes: Vec<(DVec3, f64)>,
    pub(super) bounds: [DVec3; 2],
    slack: f64,
}

/// Whether a box has anything of a part.
pub(super) enum Meets {
    No,
    /// It may.
    Perhaps,
    /// Its centre is in the part.
    Centre,
}

impl<'a> Body<'a> {
    pub(super) fn of(part: &'a Part, solid: &Solid<'_>) -> Self {
        let corners = || part.corners.iter().copied();
        let plane = |facet: &Vec<u32>| {
            let at = |k: usize| part.corners[facet[k] as usize];
            // The corner triangle of the largest area.
            let last = facet.len() - 1;
            let normals = (1..last).map(|k| (at(k) - at(0), at(k + 1) - at(0)));
            let (u, v) = normals.max_by(|(u, v), (s, t)| {
                u.cross(*v)
                    .length_squared()
                    .total_cmp(&s.cross(*t).length_squared())
            })?;
            let normal = u.cross(v);
            let good = normal.length() > WELL_SHAPED * u.length() * v.length();
            let normal = unit(normal).filter(|_| good)?;
            Some((normal, normal.dot(at(0))))
        };
        Body {
            part,
            planes: part.facets.iter().filter_map(plane).collect(),
            bounds: [
                corners().fold(DVec3::INFINITY, DVec3::min),
                corners().fold(DVec3::NEG_INFINITY, DVec3::max),
            ],
            slack: solid.slack(),
        }
    }

    pub(super) fn meets(&self, centre: DVec3, half: DVec3) -> Meets {
        let mut highest = f64::NEG_INFINITY;
        for &(normal, height) in &self.planes {
            let above = normal.dot(centre) - height;
            if above > normal.abs().dot(half) + self.slack {
                return Meets::No;
            }
            highest = greater(highest, above);
        }
        match highest <= 0.0 && !self.planes.is_empty() {
            true => Meets::Centre,
            false => Meets::Perhaps,
        }
    }

    /// How deep a point is below the planes.
    fn depth(&self, point: DVec3) -> f64 {
        let depth = |&(normal, height): &(DVec3, f64)| height - normal.dot(point);
        self.planes.iter().map(depth).fold(f64::INFINITY, lesser)
    }

    /// A bound for a part that hardly any of the surface reaches into: what is deeper than that has
    /// no surface in it, so that it is all in the solid if one point is. The part shrunk towards that
    /// point is as deep, and by so much the part may stick out.
    pub(super) fn excess_by_depth(&self, solid: &Solid<'_>) -> Option<f64> {
        let count = self.part.corners.len() as f64;
        let centre = self.part.corners.iter().sum::<DVec3>() / count;
        let [lo, hi] = self.bounds;
        let near = |t: &[DVec3; 3]| {
            let (low, high) = (t[0].min(t[1]).min(t[2]), t[0].max(t[1]).max(t[2]));
            low.cmple(hi).all() && high.cmpge(lo).all()
        };
        // A triangle is no deeper than below the plane that is nearest to its deepest corner.
        let reaches = |t: [DVec3; 3]| {
            let below = |&(normal, height): &(DVec3, f64)| {
                let depths = t.map(|p| height - normal.dot(p));
                depths.into_iter().fold(f64::NEG_INFINITY, greater)
            };
            self.planes.iter().map(below).fold(f64::INFINITY, lesser)
        };
        let deepest = solid
            .triangles()
            .filter(near)
            .map(reaches)
            .fold(0.0, greater);
        let share = (deepest + 2.0 * self.slack) / (self.depth(centre) - self.slack);
        let far = self.part.corners.iter().map(|p| p.distance(centre));
        let reach = far.fold(0.0, greater) + self.slack;
        ((0.0..1.0).contains(&share) && solid.winds_about(centre)).then_some(share * reach)
    }
}
