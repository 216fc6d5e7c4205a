//! Incremental convex hulls in three dimensions, by exact predicates.

mod conflicts;
mod local_points;

use crate::bounds::BoundingBox;
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
        Some(conflicts::hull_facets(points, simplex))
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

    /// Inserts a point, and returns the bounding box of all facets that this removes or adds; `None` if the point is inside
    /// or on the hull. O(f log f) in the number of facets.
    pub(crate) fn insert(&mut self, points: &[DVec3], point: u32) -> Option<BoundingBox> {
        let is_visible = |&facet: &[u32; 3]| side_of(points, facet, point) == Ordering::Greater;
        let (removed, mut facets): (Vec<[u32; 3]>, Vec<[u32; 3]>) =
            self.facets.iter().partition(|facet| is_visible(facet));
        if removed.is_empty() {
            return None;
        }
        let edges = removed
            .iter()
            .flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
        let mut edges: Vec<(u32, u32)> = edges.collect();
        edges.sort_unstable();
        // The visible part has one rim, and strictly turns away from it: no new facet is flat.
        let is_rim = |&&(a, b): &&(u32, u32)| edges.binary_search(&(b, a)).is_err();
        let kept = facets.len();
        facets.extend(edges.iter().filter(is_rim).map(|&(a, b)| [a, b, point]));
        let changed = removed.iter().chain(&facets[kept..]).flatten();
        let changed = BoundingBox::enclosing(changed.map(|&v| points[v as usize]));
        *self = ExactHull::from_facets(facets);
        Some(changed)
    }
}

#[cfg(test)]
mod tests;
