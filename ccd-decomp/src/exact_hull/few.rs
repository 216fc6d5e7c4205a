//! The hull of few points: each is held against all facets, without lists of who sees what.

use crate::predicates::side_of;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::tolerance::height_rounding;
use std::cmp::Ordering;

/// The facets of the hull of points that span a volume, from a triangle and a point behind it on.
///
/// O(n²), with next to no memory: for few points faster than anything else.
pub(super) fn facets(points: &[DVec3], simplex: [u32; 4]) -> Vec<[u32; 3]> {
    let hull = Growing::all(points, simplex);
    hull.facets.into_iter().map(|facet| facet.corners).collect()
}

struct Growing<'a> {
    points: &'a [DVec3],
    /// The same relative to one of them.
    places: Vec<DVec3>,
    /// The largest coordinate of those.
    reach: f64,
    facets: Vec<Facet>,
}

struct Facet {
    corners: [u32; 3],
    normal: DVec3,
    height: f64,
    /// What a point's height over it may be off by.
    rounding: f64,
}

impl<'a> Growing<'a> {
    fn all(points: &'a [DVec3], simplex: [u32; 4]) -> Self {
        let [a, b, c, d] = simplex;
        let base = points[a as usize];
        let places: Vec<DVec3> = points.iter().map(|&p| p - base).collect();
        let coordinates = places.iter().map(|p| p.abs().max_element());
        let mut hull = Growing {
            points,
            reach: coordinates.fold(0.0, greater),
            places,
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
        let [p, q, r] = corners.map(|v| self.places[v as usize]);
        let sides = [q - p, r - p];
        let normal = sides[0].cross(sides[1]);
        self.facets.push(Facet {
            corners,
            normal,
            height: normal.dot(p),
            rounding: height_rounding(sides, self.reach),
        });
    }

    /// Replaces what a point sees by a fan from its rim; `edges` is there to be used again.
    fn insert(&mut self, v: u32, edges: &mut Vec<(u32, u32)>) {
        edges.clear();
        let (points, place) = (self.points, self.places[v as usize]);
        self.facets.retain(|facet| {
            let seen = facet.is_seen(points, v, place);
            if seen {
                let [a, b, c] = facet.corners;
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

impl Facet {
    /// Exactly; where rounding cannot matter, by the height.
    fn is_seen(&self, points: &[DVec3], v: u32, place: DVec3) -> bool {
        let height = self.normal.dot(place) - self.height;
        // Written so that NaN is told exactly.
        match height.abs() > self.rounding {
            true => height > 0.0,
            false => side_of(points, self.corners, v) == Ordering::Greater,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact_hull::{ExactHull, conflicts};
    use crate::polygons::polygons;
    use proptest::prelude::*;

    proptest! {
        /// Few points have the polygons that many have, on grids and slightly off them.
        #[test]
        fn few_points_have_the_hull_of_many(
            points in prop::collection::vec(prop::array::uniform3(-2_i8..=2), 4..24),
            off in prop::collection::vec(prop::array::uniform3(-1.0..1.0), 24),
            size in prop::sample::select(vec![0.0, 1e-16, 1e-12, 0.5]),
        ) {
            let shaken = |(p, off): (&[i8; 3], &[f64; 3])| {
                DVec3::from_array(p.map(f64::from)) + size * DVec3::from_array(*off)
            };
            let points: Vec<DVec3> = points.iter().zip(&off).map(shaken).collect();
            let Some(simplex) = ExactHull::simplex(&points) else { return Ok(()) };
            let sorted = |triangles: Vec<[u32; 3]>| {
                let mut loops: Vec<Vec<[u64; 3]>> = Vec::new();
                for polygon in polygons(&points, &triangles) {
                    // Of points at one place either hull takes any.
                    let place = |&v: &u32| points[v as usize].to_array().map(|x| (x + 0.0).to_bits());
                    let mut corners: Vec<[u64; 3]> = polygon.corners.iter().map(place).collect();
                    let least = (0..corners.len()).min_by_key(|&k| corners[k]).unwrap();
                    corners.rotate_left(least);
                    loops.push(corners);
                }
                loops.sort();
                loops
            };
            let few = sorted(facets(&points, simplex));
            prop_assert_eq!(few, sorted(conflicts::facets(&points, simplex)));
        }
    }
}
