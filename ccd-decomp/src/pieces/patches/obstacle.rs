//! Tests exactly whether triangles enter the interior of a hull.

use crate::exact::predicates::side_of;
use crate::half_edges::{EdgeUse, SortedHalfEdges};
use crate::hull::exact_hull::ExactHull;
use ccd_core::glam::DVec3;
use std::cell::OnceCell;
use std::cmp::Ordering;

/// A convex hull with volume, with the tables for testing whether triangles of the same mesh enter its interior.
pub(super) struct HullInteriorTest<'a> {
    points: &'a [DVec3],
    hull: &'a ExactHull,
    edges: OnceCell<Vec<Edge>>,
    /// Pairs of a corner and an adjacent facet, sorted by corner.
    corner_facet_pairs: OnceCell<Vec<(u32, u32)>>,
}

/// An edge of a hull: its ends, and the facets on both sides.
type Edge = ([u32; 2], [u32; 2]);

impl<'a> HullInteriorTest<'a> {
    /// Creates the test of triangles against the interior of a hull, which has a volume.
    pub(super) fn new(points: &'a [DVec3], hull: &'a ExactHull) -> Self {
        HullInteriorTest {
            points,
            hull,
            edges: OnceCell::new(),
            corner_facet_pairs: OnceCell::new(),
        }
    }

    /// Returns whether a triangle is disjoint from the interior of the hull.
    ///
    /// Exact. If so, some plane separates the hull from the triangle. Such planes form a cone. A plane on an extreme
    /// ray of the cone passes through three corners that span it: it is the plane of a facet, the triangle's own, or
    /// one through an edge of either and a corner of the other. Among the latter, only those matter that touch the hull
    /// on its outline, seen from the triangle's corner.
    pub(super) fn is_separated_from(&self, triangle: [u32; 3]) -> bool {
        // The triangle is most likely in front of a facet that shares a corner, or of a new facet.
        let mut facets = self.hull.facets().iter().rev();
        triangle
            .iter()
            .any(|&v| self.is_in_front_at_corner(v, triangle))
            || facets.any(|&facet| self.is_in_front(facet, triangle))
            || self.separates(triangle, triangle)
            || (0..3).any(|k| self.is_separated_at_corner(triangle, k))
    }

    /// Returns whether the triangle is on or in front of a facet of the hull that has the vertex `corner`.
    fn is_in_front_at_corner(&self, corner: u32, triangle: [u32; 3]) -> bool {
        let meeting = self.corner_facet_pairs.get_or_init(|| {
            let facets = (0..).zip(self.hull.facets());
            let corners = facets.flat_map(|(k, facet)| facet.map(|v| (v, k)));
            let mut meeting: Vec<(u32, u32)> = corners.collect();
            meeting.sort_unstable();
            meeting
        });
        let first = meeting.partition_point(|&(v, _)| v < corner);
        let mut there = meeting[first..].iter().take_while(|(v, _)| *v == corner);
        there.any(|&(_, k)| self.is_in_front(self.hull.facets()[k as usize], triangle))
    }

    fn is_in_front(&self, facet: [u32; 3], triangle: [u32; 3]) -> bool {
        let behind = |&p: &u32| side_of(self.points, facet, p) == Ordering::Less;
        !triangle.iter().any(behind)
    }

    /// Returns whether a plane through corner `k` of the triangle separates it from the hull.
    fn is_separated_at_corner(&self, triangle: [u32; 3], k: usize) -> bool {
        let p = triangle[k];
        let facets = self.hull.facets().iter();
        let sides: Vec<Ordering> = facets.map(|&f| side_of(self.points, f, p)).collect();
        let is_outline = |(_, facets): &&Edge| {
            let [s, t] = facets.map(|f| sides[f as usize]);
            s != t || s == Ordering::Equal
        };
        let next = triangle[(k + 1) % 3];
        let mut outline = self.edges().iter().filter(is_outline);
        outline.any(|&([a, b], _)| {
            self.separates([a, b, p], triangle)
                || self.separates([p, next, a], triangle)
                || self.separates([p, next, b], triangle)
        })
    }

    /// Returns whether the plane through three points separates the hull from a triangle. The hull is strictly on one
    /// side, and the triangle on the other or in the plane. Collinear points separate nothing.
    fn separates(&self, plane: [u32; 3], triangle: [u32; 3]) -> bool {
        let mut hull_side = Ordering::Equal;
        for &v in self.hull.corners() {
            match side_of(self.points, plane, v) {
                Ordering::Equal => {}
                s if hull_side == Ordering::Equal => hull_side = s,
                s if s == hull_side => {}
                _ => return false,
            }
        }
        let beyond = |&p: &u32| side_of(self.points, plane, p) != hull_side;
        hull_side != Ordering::Equal && triangle.iter().all(beyond)
    }

    fn edges(&self) -> &[Edge] {
        self.edges.get_or_init(|| {
            let edges = SortedHalfEdges::new(self.hull.facets());
            let edge = |(ends, uses): ([u32; 2], &[EdgeUse])| match *uses {
                [one, other] => Some((ends, [one.face(), other.face()])),
                _ => None,
            };
            edges.iter().filter_map(edge).collect()
        })
    }
}

#[cfg(test)]
mod tests;
