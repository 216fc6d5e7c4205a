//! Incremental hulls of few points: each point is tested with all facets, without a conflict graph.

use super::local_points::{LocalPoints, Plane};
use ccd_core::glam::DVec3;

/// Computes the hull's triangles for points that span a volume, starting from the tetrahedron `simplex`.
///
/// O(n²), with hardly any memory: the fastest method for few points.
pub(super) fn facets(points: &[DVec3], simplex: [u32; 4]) -> Vec<[u32; 3]> {
    let hull = Growing::all(points, simplex);
    hull.facets.into_iter().map(|facet| facet.corners).collect()
}

struct Growing<'a> {
    points: LocalPoints<'a>,
    facets: Vec<Facet>,
}

struct Facet {
    corners: [u32; 3],
    plane: Plane,
}

impl<'a> Growing<'a> {
    fn all(points: &'a [DVec3], simplex: [u32; 4]) -> Self {
        let [a, b, c, d] = simplex;
        let mut hull = Growing {
            points: LocalPoints::new(points),
            facets: Vec::with_capacity(2 * points.len()),
        };
        for corners in [[a, b, c], [b, a, d], [c, b, d], [a, c, d]] {
            hull.push(corners);
        }
        let mut edges = Vec::with_capacity(4 * points.len());
        for v in (0..points.len() as u32).filter(|v| !simplex.contains(v)) {
            hull.insert(v, &mut edges);
        }
        hull
    }

    fn push(&mut self, corners: [u32; 3]) {
        let plane = self.points.plane(corners);
        self.facets.push(Facet { corners, plane });
    }

    /// Replaces the facets that the point `v` sees by a fan from their horizon; `edges` is a buffer.
    fn insert(&mut self, v: u32, edges: &mut Vec<(u32, u32)>) {
        edges.clear();
        let points = &self.points;
        self.facets.retain(|&Facet { corners, ref plane }| {
            let seen = points.is_in_front(plane, corners, v);
            if seen {
                let [a, b, c] = corners;
                edges.extend([(a, b), (b, c), (c, a)]);
            }
            !seen
        });
        for &(a, b) in edges.iter() {
            if !edges.contains(&(b, a)) {
                self.push([a, b, v]);
            }
        }
    }
}

#[cfg(test)]
mod tests;
