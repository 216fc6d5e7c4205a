//! Incremental convex hulls in three dimensions, by exact predicates.

mod conflicts;
mod local_points;

use crate::bounds::Bounds;
use crate::exact::predicates::{is_degenerate, side_of};
use ccd_core::glam::DVec3;
use std::cmp::Ordering;

/// The convex hull of some points of a list, as a closed surface of non-degenerate triangles.
///
/// # Guarantee
/// Exact: every point that was inserted is inside or on it, and every corner is one of them. Facets are
/// counter-clockwise seen from outside; several may lie in one plane.
#[derive(Clone, Debug)]
pub(crate) struct ExactHull {
    facets: Vec<[u32; 3]>,
    corners: Vec<u32>,
}

/// The change of a hull when one point is inserted: the facets to remove and to add.
#[derive(Clone, Debug)]
pub(crate) struct HullGrowth {
    /// For each facet, whether the inserted point is in front of it. Such facets are removed.
    is_facet_visible: Vec<bool>,
    /// The new triangles, all of which have the inserted point as a corner.
    fan: Vec<[u32; 3]>,
}

impl ExactHull {
    /// Creates the flat hull of a strictly convex polygon: two triangle fans, back to back. It has no volume, and
    /// only points off its plane may be inserted.
    pub(crate) fn from_polygon(corners: &[u32]) -> Self {
        let fan = |k: usize| [corners[0], corners[k], corners[k + 1]];
        let front = (1..corners.len() - 1).map(fan);
        let back = front.clone().map(|[a, b, c]| [a, c, b]);
        ExactHull {
            facets: front.chain(back).collect(),
            corners: corners.to_vec(),
        }
    }

    pub(crate) fn from_facets(facets: Vec<[u32; 3]>) -> Self {
        let mut corners: Vec<u32> = facets.iter().flatten().copied().collect();
        corners.sort_unstable();
        corners.dedup();
        ExactHull { facets, corners }
    }

    /// Computes the facets of the hull of all points; `None` if all points are coplanar. O(n log n).
    pub(crate) fn facets_of(points: &[DVec3]) -> Option<Vec<[u32; 3]>> {
        let simplex = ExactHull::simplex(points)?;
        Some(conflicts::facets(points, simplex))
    }

    /// Returns four points that span a tetrahedron: a triangle, and a point behind its plane. Returns `None` if all
    /// points are coplanar. O(n).
    fn simplex(points: &[DVec3]) -> Option<[u32; 4]> {
        let at = |k: u32| points[k as usize];
        let rest = 0..points.len() as u32;
        let b = rest.clone().find(|&k| at(k) != at(0))?;
        let area = |&k: &u32| !is_degenerate([at(0), at(b), at(k)]);
        let c = rest.clone().find(area)?;
        let height = |k: u32| side_of(points, [0, b, c], k);
        let d = rest.clone().find(|&k| height(k) != Ordering::Equal)?;
        Some(match height(d) {
            Ordering::Less => [0, b, c, d],
            _ => [0, c, b, d],
        })
    }

    /// Returns the triangles of the hull's surface, by vertex indices.
    pub(crate) fn facets(&self) -> &[[u32; 3]] {
        &self.facets
    }

    /// Returns the indices of the hull's vertices without duplicates, in ascending order unless the hull was made from
    /// a polygon.
    pub(crate) fn corners(&self) -> &[u32] {
        &self.corners
    }

    /// Computes the change of the hull by the insertion of a point; `None` if the point is inside or on the hull. O(f
    /// log f) in the number of facets.
    pub(crate) fn growth(&self, points: &[DVec3], point: u32) -> Option<HullGrowth> {
        let sees = |&facet: &[u32; 3]| side_of(points, facet, point) == Ordering::Greater;
        let seen: Vec<bool> = self.facets.iter().map(sees).collect();
        if !seen.contains(&true) {
            return None;
        }
        let mut edges: Vec<(u32, u32)> = Vec::new();
        for (&[a, b, c], _) in self.facets.iter().zip(&seen).filter(|(_, seen)| **seen) {
            edges.extend([(a, b), (b, c), (c, a)]);
        }
        edges.sort_unstable();
        // The visible part has one rim, and strictly turns away from it: no new facet is flat.
        let rim = edges
            .iter()
            .filter(|(a, b)| edges.binary_search(&(*b, *a)).is_err());
        Some(HullGrowth {
            fan: rim.map(|&(a, b)| [a, b, point]).collect(),
            is_facet_visible: seen,
        })
    }

    /// Returns the bounding box of all facets that an insertion adds or removes.
    pub(crate) fn bounds_of_change(&self, points: &[DVec3], growth: &HullGrowth) -> Bounds {
        let removed = self.facets.iter().zip(&growth.is_facet_visible);
        let removed = removed.filter_map(|(facet, seen)| seen.then_some(facet));
        let corners = removed.chain(&growth.fan).flatten();
        Bounds::enclosing(corners.map(|&v| points[v as usize]))
    }

    /// Changes the hull as [`growth`](Self::growth) computed for the insertion of a point.
    pub(crate) fn grow(&mut self, growth: HullGrowth) {
        let mut seen = growth.is_facet_visible.into_iter();
        self.facets.retain(|_| !seen.next().unwrap_or(false));
        self.facets.extend(growth.fan);
        *self = ExactHull::from_facets(std::mem::take(&mut self.facets));
    }
}

#[cfg(test)]
mod tests;
